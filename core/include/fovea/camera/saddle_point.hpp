// SPDX-License-Identifier: MIT
//
// Saddle points to a fraction of a pixel: where four squares of a checkerboard meet. Book sec. 2.10, the
// toolkit's CornerSubpixel.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/real.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Radii that refine_saddle_point() takes.
inline constexpr SubPixel min_saddle_radius = SubPixel::from_int(2);
inline constexpr SubPixel max_saddle_radius = SubPixel::from_int(64);

/// The ellipse that a circle becomes on a board that is seen askew: all au + bv with a^2 + b^2 up to 1.
struct SaddleWindow {
    SubPixelPoint u;  ///< along one edge, as long as the window reaches
    SubPixelPoint v;  ///< along the other
};

/// The saddle of brightness near a place: where two edges cross, and fields between them alternate.
///
/// First the place around which edges run, since each gradient stands across the way from the place to its
/// pixel: least squares over a disc that moves with the place. Where blur is about as wide as the disc there
/// are no edges in it, and this comes to no rest; then the place around which the mean gradient is 0.
///
/// Shapes    src 1x1 or larger; radius should end before the next parallel edges, which would pull
/// Units     1/256 px
/// Rounding  nearest; the last step is at most 1/1024 px
/// Border    gradients are of 5x3 pixels; where they do not fit, pixels do not count
/// Time      the pixels of the disc, about 40 instructions each, for every step: two to four for edges, and
///           up to 20 more
/// Errors    empty_image; bad_argument for a radius out of range; out_of_range for a start outside of the
///           image; degenerate where the surface is no saddle; not_found if the place is farther than half
///           the radius from start, or does not come to rest
/// Source    edges: Foerstner and Guelch, "A fast operator for detection and precise location of distinct
///           points, corners and centres of circular features", 1987. The toolkit's Refine and OpenCV's
///           cornerSubPix sample a square at fractions of pixels, with weights that do not end at 0. Here
///           pixels count as they are, smoothed so that the ends of edges do not pull to their centres, and
///           the weight (1 - (distance / radius)^2)^2 moves with the place. Both places are the corner
///           itself wherever the image is symmetric about it, whatever the blur
inline Result<SubPixelPoint> refine_saddle_point(ImageView<const Gray8> src, SubPixelPoint start,
                                                 SubPixel radius);

/// The same in a window that follows the board: more pixels where squares are seen askew.
///
/// Shapes    u and v as long as radii may be; by the way to the other, 1 px or more wide
/// Errors    also bad_argument for ways that are too long, short, or almost parallel. Half the shorter one
///           is how far the place may be from start
inline Result<SubPixelPoint> refine_saddle_point(ImageView<const Gray8> src, SubPixelPoint start,
                                                 const SaddleWindow& window);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Sums of gradients in a disc, weighed; with distances in 1/2048 px. Largest: gradients of 12 * 255,
/// weights that are 2^10 in the middle and a third of it in the mean, distances of 2^17, 2^13.7 pixels make
/// 2^62.3.
struct SaddleSums {
    std::int64_t xx = 0, xy = 0, yy = 0;
    std::int64_t x = 0, y = 0;

    /// Two grey levels from pixel to pixel, of which gradients are 12 times as much: what is less is noise
    /// beside the edges, which takes time.
    static bool counts(int gx, int gy) { return (gx < 0 ? -gx : gx) + (gy < 0 ? -gy : gy) >= 24; }
    void add(std::int64_t weight, int gx, int gy, std::int64_t dx, std::int64_t dy) {
        const std::int64_t across = gx * dx + gy * dy;
        xx += weight * (gx * gx);
        xy += weight * (gx * gy);
        yy += weight * (gy * gy);
        x += weight * gx * across;
        y += weight * gy * across;
    }
    /// The way to the place around which edges run, in 1/65536 px.
    Status step(std::int64_t& step_x, std::int64_t& step_y) const;
};

/// Sums for the surface itself: gradients, their products with distances, and those of distances. Largest as
/// above 2^56.
struct SurfaceSums {
    std::int64_t weights = 0;
    std::int64_t gx = 0, gy = 0;
    std::int64_t gx_x = 0, gx_y = 0, gy_x = 0, gy_y = 0;
    std::int64_t xx = 0, xy = 0, yy = 0;

    static bool counts(int, int) { return true; }
    void add(std::int64_t weight, int at_x, int at_y, std::int64_t dx, std::int64_t dy) {
        weights += weight;
        gx += weight * at_x;
        gy += weight * at_y;
        gx_x += weight * at_x * dx;
        gx_y += weight * at_x * dy;
        gy_x += weight * at_y * dx;
        gy_y += weight * at_y * dy;
        xx += weight * dx * dx;
        xy += weight * dx * dy;
        yy += weight * dy * dy;
    }
    /// The way to where the mean gradient is 0 if the surface is of second order, in 1/65536 px.
    Status step(std::int64_t& step_x, std::int64_t& step_y) const;
};

/// Gradients along a row, each of 5 by 3 pixels: a difference of two pixels after a mean of 1 2 1 by 1 2 1.
/// The mean keeps what is sharper than pixels can show from pulling to their centres.
class SaddleGradients {
public:
    /// From pixel x - 1 on, for next() to give that of x.
    SaddleGradients(ImageView<const Gray8> src, int y, int x)
        : rows_{src.row(y - 2), src.row(y - 1), src.row(y), src.row(y + 1), src.row(y + 2)}, x_(x + 2) {
        mean_1_ = mean(x - 2);
        mean_2_ = mean(x - 1);
        mean_3_ = mean(x);
        mean_4_ = mean(x + 1);
        step_3_ = step(x);
        step_2_ = step(x - 1);
        step_4_ = step(x + 1);
    }
    void next(int& gx, int& gy) {
        const int mean_0 = mean_1_;
        mean_1_ = mean_2_;
        mean_2_ = mean_3_;
        mean_3_ = mean_4_;
        mean_4_ = mean(x_);
        gx = mean_4_ + 2 * (mean_3_ - mean_1_) - mean_0;
        gy = step_2_ + 2 * step_3_ + step_4_;
        step_2_ = step_3_;
        step_3_ = step_4_;
        step_4_ = step(x_);
        ++x_;
    }

private:
    int mean(int x) const { return rows_[1][x] + 2 * rows_[2][x] + rows_[3][x]; }
    int step(int x) const { return rows_[4][x] + 2 * (rows_[3][x] - rows_[1][x]) - rows_[0][x]; }

    const Gray8* rows_[5];
    int x_;
    int mean_1_, mean_2_, mean_3_, mean_4_;
    int step_2_, step_3_, step_4_;
};

/// A SaddleWindow as it is asked for each pixel.
class SaddleWeights {
public:
    explicit SaddleWeights(const SaddleWindow& w)
        : half_width_(static_cast<std::int32_t>(hypotenuse(w.u.x.raw(), w.v.x.raw()))),
          half_height_(static_cast<std::int32_t>(hypotenuse(w.u.y.raw(), w.v.y.raw()))) {
        const std::int64_t ux = w.u.x.raw(), uy = w.u.y.raw(), vx = w.v.x.raw(), vy = w.v.y.raw();
        const Real area = Real::from_int(ux * vy - uy * vx);
        const Real share = Real::from_int(1, 46) / (area * area);
        xx_ = (Real::from_int(uy * uy + vy * vy) * share).rounded(0);
        xy_ = (Real::from_int(-2 * (ux * uy + vx * vy)) * share).rounded(0);
        yy_ = (Real::from_int(ux * ux + vx * vx) * share).rounded(0);
    }
    /// In 1/256 px.
    std::int32_t half_width() const { return half_width_; }
    std::int32_t half_height() const { return half_height_; }
    /// 2^10 (1 - a^2 - b^2) at a distance in 1/2048 px from the middle, below 0 outside of the window.
    /// Distances are below 2^18 and factors at most 2^30.
    std::int64_t part(std::int64_t dx, std::int64_t dy) const {
        const std::int64_t sum = ((dx * dx) >> 7) * xx_ + ((dx * dy) >> 7) * xy_ + ((dy * dy) >> 7) * yy_;
        return 1024 - (sum >> 35);
    }

private:
    std::int32_t half_width_;
    std::int32_t half_height_;
    std::int64_t xx_ = 0, xy_ = 0, yy_ = 0;
};

template <class Sums>
Sums saddle_sums(ImageView<const Gray8> src, FinePoint centre, const SaddleWeights& weights) {
    Sums sums;
    const auto first = [](FinePixel c, std::int32_t half) {
        return static_cast<int>(maximum<std::int64_t>((std::int64_t{c.raw()} - half * 256) >> 16, 2));
    };
    const auto last = [](FinePixel c, std::int32_t half, int side) {
        return static_cast<int>(
            minimum<std::int64_t>(((std::int64_t{c.raw()} + half * 256) >> 16) + 1, side - 3));
    };
    const int left = first(centre.x, weights.half_width());
    const int right = last(centre.x, weights.half_width(), src.width());
    const int bottom = last(centre.y, weights.half_height(), src.height());
    for (int y = first(centre.y, weights.half_height()); y <= bottom && left <= right; ++y) {
        SaddleGradients gradients(src, y, left);
        const std::int64_t dy = round_shift((std::int64_t{y} << 16) - centre.y.raw(), 5);
        for (int x = left; x <= right; ++x) {
            int gx = 0;
            int gy = 0;
            gradients.next(gx, gy);
            if (!Sums::counts(gx, gy)) continue;
            const std::int64_t dx = round_shift((std::int64_t{x} << 16) - centre.x.raw(), 5);
            const std::int64_t part = weights.part(dx, dy);
            if (part <= 0) continue;
            sums.add((part * part) >> 10, gx, gy, dx, dy);
        }
    }
    return sums;
}

inline Status SaddleSums::step(std::int64_t& step_x, std::int64_t& step_y) const {
    const Real a = Real::from_int(xx);
    const Real b = Real::from_int(xy);
    const Real c = Real::from_int(yy);
    const Real size = a * c - b * b;
    const Real half = (a + c).scaled(-1);
    // The ratio of the eigenvalues of two edges that cross at an angle t is tan^2(t / 2).
    if (half.zero() || size < (half * half).scaled(-6)) return Status::degenerate;
    const Real to_x = Real::from_int(x);
    const Real to_y = Real::from_int(y);
    step_x = ((c * to_x - b * to_y) / size).rounded(5);
    step_y = ((a * to_y - b * to_x) / size).rounded(5);
    return Status::ok;
}

inline Status SurfaceSums::step(std::int64_t& step_x, std::int64_t& step_y) const {
    // Second derivatives are M S^-1 with M = sum g d' and S = sum d d'; the step is -S M^-1 of the mean
    // gradient.
    const Real a = Real::from_int(gx_x);
    const Real b = Real::from_int(gx_y);
    const Real c = Real::from_int(gy_x);
    const Real d = Real::from_int(gy_y);
    const Real size = a * d - b * c;
    if (!size.negative()) return Status::degenerate;
    const Real x = Real::from_int(gx);
    const Real y = Real::from_int(gy);
    const Real u = (b * y - d * x) / size;
    const Real v = (c * x - a * y) / size;
    const Real share = Real::from_int(1) / Real::from_int(weights);
    step_x = ((Real::from_int(xx) * u + Real::from_int(xy) * v) * share).rounded(5);
    step_y = ((Real::from_int(xy) * u + Real::from_int(yy) * v) * share).rounded(5);
    return Status::ok;
}

/// Moves a place by the steps that sums ask for until one is below 1/1024 px; 20 at most.
/// @param shrink  a step must be shorter than the one before by this factor, or it is no way to rest
///
/// Errors  as refine_saddle_point()
template <class Sums>
Result<FinePoint> follow_steps(ImageView<const Gray8> src, FinePoint first, const SaddleWeights& weights,
                               std::int64_t reach, int shrink) {
    FinePoint place = first;
    std::int64_t before = shrink * reach;
    for (int i = 0; i < 20; ++i) {
        std::int64_t dx = 0;
        std::int64_t dy = 0;
        const Status status = saddle_sums<Sums>(src, place, weights).step(dx, dy);
        if (status != Status::ok) return status;
        dx = clamp<std::int64_t>(dx, -reach, reach);
        dy = clamp<std::int64_t>(dy, -reach, reach);
        const std::int64_t x = place.x.raw() + dx;
        const std::int64_t y = place.y.raw() + dy;
        const std::int64_t length = hypotenuse(dx, dy);
        if (hypotenuse(x - first.x.raw(), y - first.y.raw()) > reach) return Status::not_found;
        place = {FinePixel::from_raw(static_cast<std::int32_t>(x)),
                 FinePixel::from_raw(static_cast<std::int32_t>(y))};
        if (length <= 64) return place;
        if (shrink > 1 && length * shrink > before) return Status::not_found;
        before = length;
    }
    return Status::not_found;
}

/// Whether radii are in range, and the window is not too thin.
constexpr bool is_valid(const SaddleWindow& w) {
    const auto length = [](SubPixelPoint p) { return hypotenuse(p.x.raw(), p.y.raw()); };
    const std::int64_t u = length(w.u);
    const std::int64_t v = length(w.v);
    if (minimum(u, v) < min_saddle_radius.raw() || maximum(u, v) > max_saddle_radius.raw()) return false;
    const std::int64_t area =
        std::int64_t{w.u.x.raw()} * w.v.y.raw() - std::int64_t{w.u.y.raw()} * w.v.x.raw();
    return (area < 0 ? -area : area) >= 256 * maximum(u, v);
}

}  // namespace detail

inline Result<SubPixelPoint> refine_saddle_point(ImageView<const Gray8> src, SubPixelPoint start,
                                                 SubPixel radius) {
    if (src.empty()) return Status::empty_image;
    if (radius < min_saddle_radius) return Status::bad_argument;
    return refine_saddle_point(src, start, {{radius, {}}, {{}, radius}});
}

inline Result<SubPixelPoint> refine_saddle_point(ImageView<const Gray8> src, SubPixelPoint start,
                                                 const SaddleWindow& window) {
    if (src.empty()) return Status::empty_image;
    if (!detail::is_valid(window)) return Status::bad_argument;
    const auto outside = [](SubPixel c, int side) { return c.raw() < 0 || c.raw() > (side - 1) * 256; };
    if (outside(start.x, src.width()) || outside(start.y, src.height())) return Status::out_of_range;

    const FinePoint first{start.x.convert<FinePixel>(), start.y.convert<FinePixel>()};
    const detail::SaddleWeights weights(window);
    // Half of the shorter way, in 1/65536 px.
    const std::int64_t reach = minimum(hypotenuse(window.u.x.raw(), window.u.y.raw()),
                                       hypotenuse(window.v.x.raw(), window.v.y.raw()))
                               << 7;
    Result<FinePoint> place = detail::follow_steps<detail::SaddleSums>(src, first, weights, reach, 3);
    if (!place) place = detail::follow_steps<detail::SurfaceSums>(src, first, weights, reach, 1);
    if (!place) return place.status();
    const SubPixelPoint answer{place->x.convert<SubPixel>(), place->y.convert<SubPixel>()};
    if (outside(answer.x, src.width()) || outside(answer.y, src.height())) return Status::not_found;
    return answer;
}

}  // namespace fovea
