// SPDX-License-Identifier: MIT
//
// Where an image looks like the corner of four squares: candidates, their edges, and the way from one to the
// next.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/board_lattice.hpp>
#include <fovea/feature/strongest.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A direction, of length 64.
struct SaddleWay {
    std::int8_t x = 0;
    std::int8_t y = 0;
};
inline SaddleWay saddle_way(BoardVector v) {
    const std::int64_t length = maximum<std::int64_t>(hypotenuse(v.x, v.y), 1);
    return {static_cast<std::int8_t>(v.x * std::int64_t{64} / length),
            static_cast<std::int8_t>(v.y * std::int64_t{64} / length)};
}

/// A pixel around which four fields alternate. Between edges a and b, and opposite, it is bright; b is
/// turned from a as y is from x, by less than half a turn.
struct SaddleCandidate {
    std::int32_t response = 0;
    std::int16_t x = 0;
    std::int16_t y = 0;
    SaddleWay a;
    SaddleWay b;
    bool used = false;  ///< as a seed, or as a member of a lattice

    BoardVector place() const { return {x * 256, y * 256}; }
};
struct WeakerSaddle {
    constexpr bool operator()(const SaddleCandidate& a, const SaddleCandidate& b) const {
        if (a.response != b.response) return a.response < b.response;
        if (a.y != b.y) return a.y > b.y;
        return a.x > b.x;
    }
};

/// A smoothed image, and what its second derivatives say.
class SaddleField {
public:
    SaddleField() = default;
    SaddleField(ImageView<const Gray8> image, int least_contrast)
        : image_(image), least_contrast_(least_contrast) {}

    static constexpr int margin = 3;
    Size size() const { return image_.size(); }

    /// Twice the smaller derivative product less the larger: above 0 at saddles. Second derivatives of a
    /// distance of two pixels, times 4; at most 2 * 510^2.
    static int response(int xx, int yy, int xy) { return xy * xy - xx * yy; }

    /// Collects the maxima of the response around which four fields alternate, the strongest first.
    void gather(Span<std::int32_t> rows, ListView<SaddleCandidate> list) const {
        const int width = image_.width();
        const int height = image_.height();
        Strongest<SaddleCandidate, WeakerSaddle> strongest(list, {});
        if (width <= 2 * margin || height <= 2 * margin) return;
        const int least = maximum(least_contrast_ * least_contrast_ / 32, 1);
        const auto row = [&](int y) { return rows.data() + std::ptrdiff_t{y % 3} * width; };
        for (int y = 2; y < height - 2; ++y) {
            respond(y, row(y));
            if (y < 4) continue;
            const std::int32_t* above = row(y - 2);
            const std::int32_t* here = row(y - 1);
            const std::int32_t* below = row(y);
            for (int x = margin; x < width - margin; ++x) {
                const std::int32_t r = here[x];
                if (r < least || r < here[x + 1] || r <= here[x - 1]) continue;
                if (r <= above[x - 1] || r <= above[x] || r <= above[x + 1] || r < below[x - 1] ||
                    r < below[x] || r < below[x + 1])
                    continue;
                SaddleCandidate candidate;
                candidate.response = r;
                candidate.x = static_cast<std::int16_t>(x);
                candidate.y = static_cast<std::int16_t>(y - 1);
                if (alternates(candidate)) strongest.add(candidate);
            }
        }
        sort(list.span(),
             [](const SaddleCandidate& a, const SaddleCandidate& b) { return WeakerSaddle()(b, a); });
    }

    /// The derivative along u and v, of length 64, times 2^14: above 0 where it is bright between them.
    int along(Point p, SaddleWay u, SaddleWay v) const {
        const Gray8* up2 = image_.row(p.y - 2) + p.x;
        const Gray8* up = image_.row(p.y - 1) + p.x;
        const Gray8* here = image_.row(p.y) + p.x;
        const Gray8* down = image_.row(p.y + 1) + p.x;
        const Gray8* down2 = image_.row(p.y + 2) + p.x;
        const int xx = here[-2] - 2 * here[0] + here[2];
        const int yy = up2[0] - 2 * here[0] + down2[0];
        const int xy = up[-1] - up[1] - down[-1] + down[1];
        return u.x * v.x * xx + (u.x * v.y + u.y * v.x) * xy + u.y * v.y * yy;
    }

    /// The saddle with the given sign of along() that is strongest around a place.
    ///
    /// Errors  not_found if there is none of at least the contrast, or none away from the image's border
    Result<BoardVector> saddle_near(BoardVector expected, int radius, SaddleWay u, SaddleWay v,
                                    int sign) const {
        const Point middle{round_shift(expected.x, 8), round_shift(expected.y, 8)};
        const int left = maximum(middle.x - radius, margin);
        const int top = maximum(middle.y - radius, margin);
        const int right = minimum(middle.x + radius, image_.width() - 1 - margin);
        const int bottom = minimum(middle.y + radius, image_.height() - 1 - margin);
        int best = 0;
        Point at;
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) {
                const int value = sign * along({x, y}, u, v);
                if (value <= best) continue;
                best = value;
                at = {x, y};
            }
        // A quarter of what a sharp corner of the least contrast has, 2^14 / 2 of it.
        if (best < least_contrast_ << 10) return Status::not_found;
        if (at.x == margin || at.y == margin || at.x == image_.width() - 1 - margin ||
            at.y == image_.height() - 1 - margin)
            return BoardVector{at.x * 256, at.y * 256};
        const auto fraction = [&](int before, int after) {
            const int bend = 2 * best - before - after;
            if (before > best || after > best || bend <= 0) return 0;
            return static_cast<int>(
                clamp<std::int64_t>(std::int64_t{after - before} * 128 / bend, -128, 128));
        };
        const int dx = fraction(sign * along({at.x - 1, at.y}, u, v), sign * along({at.x + 1, at.y}, u, v));
        const int dy = fraction(sign * along({at.x, at.y - 1}, u, v), sign * along({at.x, at.y + 1}, u, v));
        return BoardVector{at.x * 256 + dx, at.y * 256 + dy};
    }

    /// The grey level at a place, in 1/256; outside of the image the outermost pixels repeat.
    int level(BoardVector p) const {
        const int x = clamp<std::int32_t>(p.x, 0, (image_.width() - 1) * 256);
        const int y = clamp<std::int32_t>(p.y, 0, (image_.height() - 1) * 256);
        const int left = x >> 8;
        const int top = y >> 8;
        const int right = x & 255;
        const int down = y & 255;
        const Gray8* above = image_.row(top) + left;
        const Gray8* below = down == 0 ? above : image_.row(top + 1) + left;
        const int next = right == 0 ? 0 : 1;
        const int upper = above[0] * (256 - right) + above[next] * right;
        const int lower = below[0] * (256 - right) + below[next] * right;
        return (upper * (256 - down) + lower * down) >> 8;
    }

    /// The least of three steps of brightness across a line, a quarter, half and three quarters from `from`
    /// to `to`: how much brighter it is on the side. In 1/256 of a level.
    int edge(BoardVector from, BoardVector to, BoardVector side) const {
        int least = 1 << 16;
        const BoardVector way = to - from;
        for (int k = 1; k <= 3; ++k) {
            const BoardVector p = from + BoardVector{way.x * k / 4, way.y * k / 4};
            least = minimum(least, level(p + side) - level(p - side));
        }
        return least;
    }
    int least_step() const { return least_contrast_ << 6; }

    /// Whether edges leave a place on all four sides, along u and v and back, with colours that alternate:
    /// it is bright between u and v for sign 1.
    bool crosses(BoardVector place, BoardVector u, BoardVector v, int sign) const {
        const BoardVector side_u = side_of(v);
        const BoardVector side_v = side_of(u);
        const auto arm = [&](BoardVector way, BoardVector side) {
            const BoardVector p = place + BoardVector{way.x * 3 / 8, way.y * 3 / 8};
            return sign * (level(p + side) - level(p - side));
        };
        const int arms[4] = {arm(u, side_u), arm(-u, -side_u), arm(v, side_v), arm(-v, -side_v)};
        int low = arms[0];
        int high = arms[0];
        for (const int step : arms) {
            low = minimum(low, step);
            high = maximum(high, step);
        }
        return low >= least_step() && low * 5 >= high;
    }
    /// A quarter of a step to a side, and not less than 1.25 px.
    static BoardVector side_of(BoardVector step) {
        const int length = maximum(step.length(), 1);
        const int width = maximum(length / 4, 320);
        return {static_cast<std::int32_t>(std::int64_t{step.x} * width / length),
                static_cast<std::int32_t>(std::int64_t{step.y} * width / length)};
    }

private:
    void respond(int y, std::int32_t* to) const {
        const Gray8* up2 = image_.row(y - 2);
        const Gray8* up = image_.row(y - 1);
        const Gray8* here = image_.row(y);
        const Gray8* down = image_.row(y + 1);
        const Gray8* down2 = image_.row(y + 2);
        for (int x = 2; x < image_.width() - 2; ++x) {
            const int xx = here[x - 2] - 2 * here[x] + here[x + 2];
            const int yy = up2[x] - 2 * here[x] + down2[x];
            const int xy = up[x - 1] - up[x + 1] - down[x - 1] + down[x + 1];
            to[x] = response(xx, yy, xy);
        }
    }

    /// Whether a ring of radius 3 has two bright and two dark parts; finds the edges between them.
    bool alternates(SaddleCandidate& c) const {
        constexpr std::int8_t ring[16][2] = {{3, 0},  {3, 1},  {2, 2},  {1, 3},   {0, 3},   {-1, 3},
                                             {-2, 2}, {-3, 1}, {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3},
                                             {0, -3}, {1, -3}, {2, -2}, {3, -1}};
        // The directions of the first five, in 1/65536 turn; the others follow by quarters.
        constexpr int angles[4] = {0, 3356, 8192, 13028};
        int values[16];
        int low = 255;
        int high = 0;
        for (int k = 0; k < 16; ++k) {
            values[k] = image_(c.x + ring[k][0], c.y + ring[k][1]);
            low = minimum(low, values[k]);
            high = maximum(high, values[k]);
        }
        const int contrast = high - low;
        if (2 * contrast < least_contrast_) return false;
        const int middle2 = low + high;
        int angle[4];
        int place[4];
        int count = 0;
        int first_rise = -1;
        const auto angle_at = [&](int k) { return angles[k & 3] + (k >> 2) * 16384; };
        for (int k = 0; k < 16; ++k) {
            const int now = 2 * values[k] - middle2;
            const int next = 2 * values[(k + 1) & 15] - middle2;
            if ((now < 0) == (next < 0)) continue;
            if (count == 4) return false;
            if (now < 0 && first_rise < 0) first_rise = count;
            const int gap = (angle_at(k + 1) - angle_at(k));
            angle[count] = angle_at(k) + gap * now / (now - next);
            place[count++] = k;
        }
        if (count != 4) return false;
        for (int k = 0; k < 4; ++k)
            if (((place[(k + 1) & 3] - place[k]) & 15) < 2) return false;
        // Bright from a on, dark from b on.
        const auto mean = [&](int k, int opposite) {
            const std::int16_t turn =
                Angle::from_raw(static_cast<std::uint16_t>(angle[opposite] + 32768 - angle[k])).signed_raw();
            return Angle::from_raw(static_cast<std::uint16_t>(angle[k] + turn / 2));
        };
        const auto skew = [&](int k, int opposite) {
            return Angle::from_raw(static_cast<std::uint16_t>(angle[opposite] + 32768 - angle[k]))
                .signed_raw();
        };
        const int a = first_rise;
        const int b = (a + 1) & 3;
        constexpr int most_skew = 7282;  // 40 degrees
        const int skew_a = skew(a, (a + 2) & 3);
        const int skew_b = skew(b, (b + 2) & 3);
        if (skew_a > most_skew || skew_a < -most_skew || skew_b > most_skew || skew_b < -most_skew)
            return false;
        c.a = way_of(mean(a, (a + 2) & 3));
        c.b = way_of(mean(b, (b + 2) & 3));
        return c.a.x * c.b.y - c.a.y * c.b.x > 0;
    }
    static SaddleWay way_of(Angle angle) {
        const UnitVector unit = unit_vector(FineAngle(angle));
        return {static_cast<std::int8_t>(round_shift(unit.x.raw(), 24)),
                static_cast<std::int8_t>(round_shift(unit.y.raw(), 24))};
    }

    ImageView<const Gray8> image_;
    int least_contrast_ = 0;
};

}  // namespace detail

}  // namespace fovea
