// SPDX-License-Identifier: MIT
//
// Any points as those of a line and of a circle: every fit ends, and one that is given rests on points that
// there are.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/measure/fit_circle.hpp>
#include <fovea/measure/fit_line.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

constexpr std::size_t most_points = 48;

/// Four bytes a coordinate; or one, for points that lie close together; or one apart from a common line, for
/// those that hardly bend.
std::vector<FinePoint> points_from(const std::uint8_t* data, std::size_t size) {
    std::vector<FinePoint> points;
    if (size == 0) return points;
    const int kind = *data % 3;
    const std::uint8_t* next = data + 1;
    const std::uint8_t* end = data + size;
    const std::ptrdiff_t width = kind == 0 ? 4 : 1;
    const auto coordinate = [&] {
        std::uint32_t value = 0;
        for (std::ptrdiff_t i = 0; i < width; ++i) value = value << 8 | *next++;
        return kind == 0 ? static_cast<std::int32_t>(value) : static_cast<std::int8_t>(value);
    };
    while (end - next >= 2 * width && points.size() < most_points) {
        const std::int32_t x = coordinate();
        const std::int32_t y = coordinate();
        points.push_back(
            kind == 2 ? FinePoint{FinePixel::from_raw(x * (1 << 22)), FinePixel::from_raw(x * (1 << 21) + y)}
                      : FinePoint{FinePixel::from_raw(x), FinePixel::from_raw(y)});
    }
    return points;
}

template <class Fit>
void check(const Result<Fit>& fit, std::size_t points, int least) {
    if (!fit) {
        require(fit.status() == Status::degenerate);
        return;
    }
    require(fit->used >= least && fit->used <= static_cast<int>(points));
    require(fit->rms.raw() >= 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::vector<FinePoint> points = points_from(data, size);
    const Span<const FinePoint> span(points.data(), static_cast<std::ptrdiff_t>(points.size()));
    std::vector<FinePixel> residuals(points.size());
    const Span<FinePixel> scratch(residuals.data(), span.size());
    check(fit_line(span), points.size(), 2);
    check(fit_line_robust(span, scratch), points.size(), 2);
    const Result<CircleFit> circle = fit_circle(span);
    check(circle, points.size(), 3);
    check(fit_circle_robust(span, scratch), points.size(), 3);
    if (circle) require(circle->circle.radius.raw() > 0);
    return 0;
}
