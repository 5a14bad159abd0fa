// SPDX-License-Identifier: MIT
//
// Golden vectors of light_section/.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/random.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/light_section/line_peak.hpp>
#include <fovea/stream/stream.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const LinePeak& peak) {
    digest.add(peak.x, peak.strength, peak.width, peak.runs, peak.empty());
}

inline void light_section_line_peaks(Workspace& work, Digest& digest) {
    auto* peaks = reinterpret_cast<LinePeak*>(work.image[2]);
    Random random(71);
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8>) {
        const Span<LinePeak> found(peaks, src.height());
        LinePeakOptions options;
        options.level = random.between(1, 255);
        options.width_min = random.between(1, 3);
        options.width_max = random.between(2, 40);
        options.strength_min = random.between(0, 300);
        digest.add(line_peaks(src, options, found));
        digest.add(found);
        auto program = stream(LinePeakAccumulator({}, found));
        digest.add(program.run(src, Border::zero, work.scratch_span()));
        digest.add(found, line_peak(src.row(0), src.width(), options));
    });
    digest.add(line_peaks({}, {}, {}));
}

}  // namespace fovea::golden
