// SPDX-License-Identifier: MIT
//
// A plate of make-part that is small enough to render often. Host tests only.
#pragma once

#include <fovea/image/geometry.hpp>
#include <make_part/part_scene.hpp>

namespace fovea::test {

/// 180 x 70 px with a cut corner and two holes, 30 and 18 px wide, in the middle of an image.
inline apps::PartScene small_plate(Size image) {
    apps::PartScene scene;
    scene.size = image;
    scene.length = FinePixel::from_int(180);
    scene.height = FinePixel::from_int(70);
    scene.cut_x = FinePixel::from_int(30);
    scene.cut_y = FinePixel::from_int(20);
    scene.holes = {{FinePixel::from_int(50), FinePixel::from_int(-2), FinePixel::from_int(15)},
                   {FinePixel::from_int(-48), FinePixel::from_int(4), FinePixel::from_int(9)}};
    scene.middle = {FinePixel::from_ratio(image.width, 2), FinePixel::from_ratio(image.height, 2)};
    return scene;
}

}  // namespace fovea::test
