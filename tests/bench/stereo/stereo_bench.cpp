// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/stereo/eight_point.hpp>
#include <fovea/stereo/ransac_epipolar.hpp>
#include <fovea/stereo/rectify.hpp>
#include <fovea/stereo/triangulate.hpp>

#include <bench/harness.hpp>

namespace fovea::bench {
namespace {

StereoCamera<> cameras() {
    StereoCamera<> pair;
    pair.left = {Real::from_int(580),
                 Real::from_int(581),
                 Real::from_int(320),
                 Real::from_int(240),
                 Real::from_ratio(-1, 4),
                 Real::from_ratio(1, 11),
                 Real(),
                 Real::from_ratio(1, 900),
                 Real::from_ratio(-1, 700)};
    pair.right = pair.left;
    pair.right.cx = Real::from_int(311);
    const Real zero;
    pair.right_from_left.rotation =
        rotation_about(Vector<3>(Real::from_ratio(1, 50), Real::from_ratio(-1, 30), Real::from_ratio(1, 90)));
    pair.right_from_left.translation = Vector<3>(Real::from_int(-110), Real::from_int(2), zero);
    return pair;
}

/// Pixels of places that both cameras see, without their lens; every third pair is wrong if wanted.
struct Pairs {
    std::vector<SubPixelPoint> left, right;
    std::vector<std::uint8_t> agrees;

    explicit Pairs(bool wrong) {
        StereoCamera<> pair = cameras();
        for (Camera<>* camera : {&pair.left, &pair.right}) {
            camera->k1 = camera->k2 = Real();
            camera->p1 = camera->p2 = Real();
        }
        Random random(1);
        for (int i = 0; i < 100; ++i) {
            const Real x = Real::from_int(random.between(-300, 300));
            const Real y = Real::from_int(random.between(-250, 250));
            const Real z = Real::from_int(random.between(700, 1800));
            const Vector<3> place(x, y, z);
            const auto add = [](std::vector<SubPixelPoint>& to, const Vector<2>& pixel) {
                to.push_back({pixel[0].to_fixed<SubPixel>(), pixel[1].to_fixed<SubPixel>()});
            };
            add(left, *project(pair.left, place));
            add(right, *project(pair.right, pair.right_from_left, place));
            const int row = random.between(0, 479);
            if (wrong && i % 3 == 0) right.back().y = SubPixel::from_int(row);
        }
        agrees.resize(left.size());
    }
    Span<const SubPixelPoint> from() const { return {left.data(), static_cast<std::ptrdiff_t>(left.size())}; }
    Span<const SubPixelPoint> to() const { return {right.data(), static_cast<std::ptrdiff_t>(right.size())}; }
    Span<std::uint8_t> flags() { return {agrees.data(), static_cast<std::ptrdiff_t>(agrees.size())}; }
};

const bool fit_added = add(90, "fundamental matrix, 100 pairs", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& pairs = row.keep(Pairs(false));
    row.ours([&] { consume(fit_fundamental(pairs.from(), pairs.to())); });
});
const bool ransac_added = add(90, "fundamental matrix, RANSAC, a third wrong", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& pairs = row.keep(Pairs(true));
    row.ours([&] {
        consume(fit_fundamental_ransac(pairs.from(), pairs.to(), SubPixel::from_int(1), RansacOptions(),
                                       pairs.flags()));
    });
});
const bool rectify_added = add(91, "rectify, all valid", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    RectifyOptions options;
    options.zoom = RectifyOptions::Zoom::valid;
    row.ours([=, pair = cameras(), size = row.size()] { consume(rectify(pair, size, options)); });
});
const bool midpoint_added = add(92, "triangulate, middle of the rays", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& eyes = row.keep(Triangulator<>(cameras()));
    const Vector<2> left(Real::from_int(400), Real::from_int(300));
    const Vector<2> right(Real::from_int(330), Real::from_int(290));
    row.ours([&eyes, left, right] { consume(eyes.midpoint(left, right)); });
});
const bool optimal_added = add(92, "triangulate, optimal", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& eyes = row.keep(Triangulator<>(cameras()));
    const Vector<2> left(Real::from_int(400), Real::from_int(300));
    const Vector<2> right(Real::from_int(330), Real::from_int(290));
    row.ours([&eyes, left, right] { consume(eyes.optimal(left, right)); });
});

}  // namespace
}  // namespace fovea::bench
