// SPDX-License-Identifier: MIT
//
// Where the modules of a matrix code lie in an image: the plane it is printed on, seen in perspective.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// A place in 1/256 px, or in 1/16 module.
struct ModulePoint {
    std::int64_t x = 0;
    std::int64_t y = 0;

    friend constexpr ModulePoint operator+(ModulePoint a, ModulePoint b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr ModulePoint operator-(ModulePoint a, ModulePoint b) { return {a.x - b.x, a.y - b.y}; }
    friend constexpr ModulePoint operator*(ModulePoint a, std::int64_t k) { return {a.x * k, a.y * k}; }
    friend constexpr ModulePoint operator/(ModulePoint a, std::int64_t k) { return {a.x / k, a.y / k}; }
};
constexpr std::int64_t dot(ModulePoint a, ModulePoint b) { return a.x * b.x + a.y * b.y; }
constexpr std::int64_t cross_product(ModulePoint a, ModulePoint b) { return a.x * b.y - a.y * b.x; }
constexpr std::int64_t length(ModulePoint a) { return hypotenuse(a.x, a.y); }
constexpr ModulePoint pixel_place(int x, int y) { return {std::int64_t{x} * 256, std::int64_t{y} * 256}; }
constexpr std::int64_t module_units = 16;

/// From modules, in 1/16, to the image, in 1/256 px: (a u + b v + c) / (g u + h v + i) and so on.
class ModulePlane {
public:
    constexpr ModulePlane() = default;

    /// Through four pairs, in their order around: modules below 2^12 and places below 2^24.
    ///
    /// Errors  degenerate where three of a side are on a line, or the horizon passes between them
    /// Source  Heckbert, Fundamentals of Texture Mapping, 1989: the unit square to each side
    static Result<ModulePlane> through(const ModulePoint (&modules)[4], const ModulePoint (&places)[4]) {
        constexpr std::uint64_t most_place = std::uint64_t{1} << 24;
        constexpr std::uint64_t most_module = 1U << 12;
        for (const ModulePoint& place : places)
            if (magnitude(place.x) >= most_place || magnitude(place.y) >= most_place)
                return Status::degenerate;
        for (const ModulePoint& place : modules)
            if (magnitude(place.x) >= most_module || magnitude(place.y) >= most_module)
                return Status::degenerate;
        Entries from;
        Entries to;
        if (!square_to(modules, from) || !square_to(places, to)) return Status::degenerate;
        // Places of 24 bits make entries of 78, of which 46 are kept; modules those of 42, and their
        // cofactors of 40 after rounding.
        keep_bits(to, 46);
        keep_bits(from, 38);
        Entries back;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                const auto at = [&](int row, int column) {
                    return from.e[row % 3 * 3 + column % 3].low_word();
                };
                // The adjugate: cofactor of (j, i), whose signs come from the cyclic order.
                back.e[i * 3 + j] = Int128::product(at(j + 1, i + 1), at(j + 2, i + 2)) -
                                    Int128::product(at(j + 1, i + 2), at(j + 2, i + 1));
            }
        }
        keep_bits(back, 40);
        Entries both;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                Int128 sum = 0;
                for (int k = 0; k < 3; ++k)
                    sum += Int128::product(to.e[i * 3 + k].low_word(), back.e[k * 3 + j].low_word());
                both.e[i * 3 + j] = sum;
            }
        }
        keep_bits(both, 48);
        ModulePlane plane;
        for (int i = 0; i < 9; ++i) plane.e_[i] = both.e[i].low_word();
        if (plane.depth(modules[0]) < 0)
            for (std::int64_t& entry : plane.e_) entry = -entry;
        for (const ModulePoint& place : modules)
            if (plane.depth(place) <= 0) return Status::degenerate;
        return plane;
    }

    /// Beyond the horizon a place that is in no image. Modules within -4095..8191: sums stay below 2^62.
    constexpr ModulePoint operator()(ModulePoint module) const { return quotient(sums(module)); }

    /// A row of places in equal steps.
    class Walk {
    public:
        constexpr Walk(const ModulePlane& plane, ModulePoint module, std::int64_t step)
            : at_(plane.sums(module)), step_{plane.e_[0] * step, plane.e_[3] * step, plane.e_[6] * step} {}
        constexpr ModulePoint next() {
            const ModulePoint place = quotient(at_);
            for (int i = 0; i < 3; ++i) at_.s[i] += step_.s[i];
            return place;
        }

    private:
        struct Three {
            std::int64_t s[3];
        } at_, step_;
        friend class ModulePlane;
    };

private:
    struct Entries {
        Int128 e[9];
    };
    using Three = Walk::Three;

    static bool square_to(const ModulePoint (&p)[4], Entries& out) {
        const ModulePoint one = p[1] - p[2];
        const ModulePoint three = p[3] - p[2];
        const ModulePoint skew = p[0] - p[1] + p[2] - p[3];
        const std::int64_t w = cross_product(one, three);
        if (w == 0) return false;
        const std::int64_t g = cross_product(skew, three);
        const std::int64_t h = cross_product(one, skew);
        const auto set = [&](int row, std::int64_t zero, std::int64_t first, std::int64_t third) {
            out.e[row * 3] = Int128::product(first - zero, w) + Int128::product(first, g);
            out.e[row * 3 + 1] = Int128::product(third - zero, w) + Int128::product(third, h);
            out.e[row * 3 + 2] = Int128::product(zero, w);
        };
        set(0, p[0].x, p[1].x, p[3].x);
        set(1, p[0].y, p[1].y, p[3].y);
        out.e[6] = g;
        out.e[7] = h;
        out.e[8] = w;
        return true;
    }
    /// All entries shifted alike, so that none has more bits.
    static void keep_bits(Entries& entries, int bits) {
        int most = 0;
        for (const Int128& entry : entries.e) most = maximum(most, entry.bit_length());
        if (most <= bits) return;
        for (Int128& entry : entries.e) entry = entry >> (most - bits);
    }
    constexpr std::int64_t depth(ModulePoint m) const { return e_[6] * m.x + e_[7] * m.y + e_[8]; }
    constexpr Three sums(ModulePoint m) const {
        return {{e_[0] * m.x + e_[1] * m.y + e_[2], e_[3] * m.x + e_[4] * m.y + e_[5], depth(m)}};
    }
    static constexpr ModulePoint quotient(const Three& sums) {
        constexpr std::int64_t nowhere = std::int64_t{1} << 30;
        if (sums.s[2] <= 0) return {nowhere, nowhere};
        return {clamp(sums.s[0] / sums.s[2], -nowhere, nowhere),
                clamp(sums.s[1] / sums.s[2], -nowhere, nowhere)};
    }

    std::int64_t e_[9] = {};
};

}  // namespace fovea::detail
