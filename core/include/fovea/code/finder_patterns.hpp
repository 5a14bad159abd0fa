// SPDX-License-Identifier: MIT
//
// The finder patterns of QR codes in a binary image: any line through their middle crosses dark and light as
// 1:1:3:1:1. ISO/IEC 18004, 6.3.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <fovea/base/list.hpp>
#include <fovea/code/module_plane.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

struct FinderPattern {
    ModulePoint centre;       ///< 1/256 px
    std::int64_t module = 0;  ///< 1/256 px, about
    bool inverted = false;    ///< light where others are dark
    int lines = 1;            ///< rows that crossed it
    int rings = 0;            ///< places around its centre that are as they must be, 0 to most_finder_rings
};
inline constexpr int max_finder_patterns = 96;
inline constexpr int most_finder_rings = 24;

/// Pixels of one colour through a pixel and around, outside of the image another colour.
struct FinderImage {
    BitView<const BitWord> bits;
    bool inverted = false;

    bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < bits.width() && y < bits.height(); }
    bool dark(int x, int y) const { return inside(x, y) && bits(x, y) != inverted; }
    /// At a place, to the nearest pixel.
    bool dark(ModulePoint place) const {
        return dark(static_cast<int>((place.x + 128) >> 8), static_cast<int>((place.y + 128) >> 8));
    }
};

constexpr bool stronger(const FinderPattern& a, const FinderPattern& b) {
    return a.rings != b.rings ? a.rings > b.rings : a.lines > b.lines;
}

/// Five runs of a line in turn.
struct FiveRuns {
    int run[5] = {};

    constexpr int total() const { return run[0] + run[1] + run[2] + run[3] + run[4]; }
    /// Shortens one of the outer runs to what the three inside are to each other, if it is longer: where a
    /// shadow or other print touches the pattern, its edge is not seen on that side.
    constexpr void clip() {
        const int most = (2 * (run[1] + run[2] + run[3]) + 4) / 5;
        int& outer = run[0] > run[4] ? run[0] : run[4];
        if (outer > most) outer = (run[1] + run[2] + run[3] + 4) / 5;
    }
    /// Whether they are as 1:1:3:1:1. Ink that spreads or shrinks moves all edges of dark runs alike, so that
    /// what is compared is the way from an edge to the next of its kind: 2, 4, 4, 2 modules, each within
    /// slack/16 of a module and a pixel; single runs may be much thinner or broader.
    constexpr bool fits(int slack) const {
        const int sum = total();
        if (sum < 7) return false;
        const int middle = run[2];
        if (middle * 7 < sum + sum / 2 || middle * 7 > sum * 5) return false;
        const int most = slack * sum / 16 + 7;
        for (int i = 0; i < 4; ++i) {
            const int expected = i == 0 || i == 3 ? 2 : 4;
            const int off = 7 * (run[i] + run[i + 1]) - expected * sum;
            if (off > most || off < -most) return false;
        }
        for (int i = 0; i < 5; ++i) {
            if (i != 2 && (run[i] * 7 * 4 < sum || run[i] * 7 * 2 > sum * 5)) return false;
        }
        return true;
    }
};

/// Collects the five runs through a pixel along a step, and answers where their middle one lies: twice its
/// centre, counted in steps from the pixel, or nothing where there are not five, or none longer than most.
struct CrossRuns {
    FiveRuns runs;
    int twice_centre = 0;
    bool complete = false;
    bool goes_on = false;  ///< not complete, as the middle one is longer than most after the pixel
};
/// Goes on by steps while the pixels there have the wanted colour, and answers their count, limit at most.
inline int run_along(const BitWord*& row, int& x, int across, std::ptrdiff_t down, BitWord wanted,
                     int limit) {
    int count = 0;
    if (across == 0) {
        const int place = x % bits_a_word;
        const BitWord* words = row + x / bits_a_word;
        std::ptrdiff_t next = down;
        for (; count < limit && (words[next] >> place & 1) == wanted; ++count) next += down;
        row += count * down;
        return count;
    }
    for (; count < limit; ++count) {
        const BitWord* next = row + down;
        const auto place = static_cast<unsigned>(x + across);
        if ((next[place / bits_a_word] >> place % bits_a_word & 1) != wanted) break;
        row = next;
        x += across;
    }
    return count;
}
inline CrossRuns cross_runs(const FinderImage& image, int x, int y, int dx, int dy, int most) {
    CrossRuns cross;
    int ends[2] = {};
    const BitWord colour = image.inverted ? 0 : 1;
    for (int side = 0; side < 2; ++side) {
        const int sx = side == 0 ? -dx : dx;
        const int sy = side == 0 ? -dy : dy;
        // Steps that stay in the image.
        const int across = sx == 0 ? max_image_side : sx > 0 ? image.bits.width() - 1 - x : x;
        const int along = sy == 0 ? max_image_side : sy > 0 ? image.bits.height() - 1 - y : y;
        int room = minimum(across, along);
        const std::ptrdiff_t down = sy * image.bits.stride_words();
        const BitWord* row = image.bits.row(y);
        int px = x;
        for (int part = 0; part < 3; ++part) {
            const BitWord wanted = part == 1 ? 1 - colour : colour;
            const int count = run_along(row, px, sx, down, wanted, minimum(room, most + 1));
            room -= count;
            // The outer run may go on into a shadow.
            if ((count > most && part < 2) || (part > 0 && count == 0)) {
                cross.goes_on = side == 1 && part == 0;
                return cross;
            }
            if (part == 0) ends[side] = count;
            cross.runs.run[side == 0 ? 2 - part : 2 + part] += count;
        }
    }
    cross.runs.run[2] += 1;
    cross.twice_centre = ends[1] - ends[0];
    cross.runs.clip();
    cross.complete = true;
    return cross;
}

/// Finds the patterns of both colours with one look at the rows.
class FinderSearch {
public:
    FinderSearch(BitView<const BitWord> bits, ListView<FinderPattern> patterns)
        : bits_(bits), patterns_(patterns) {}

    /// Rows first, first + step and so on.
    void rows(int first, int step) {
        step_ = step;
        for (Rejected& rejected : rejected_) rejected = {};
        for (int y = first; y < bits_.height(); y += step) row(y);
    }

private:
    void row(int y) {
        const BitWord* words = bits_.row(y);
        const int width = bits_.width();
        int edge[6] = {};  // the last six edges, the newest last; the image's own ends are edges
        int edges = 1;
        bool colour = (words[0] & 1) != 0;  // of the run that begins at the newest edge
        BitWord before = words[0] & 1;
        const auto add = [&](int x) {
            for (int i = 0; i < 5; ++i) edge[i] = edge[i + 1];
            edge[5] = x;
            if (++edges >= 6) look(edge, y, colour);
            colour = !colour;
        };
        for (int i = 0; i < bit_words(width); ++i) {
            BitWord changes = words[i] ^ (words[i] << 1 | before);
            before = words[i] >> (bits_a_word - 1);
            if (i == bit_words(width) - 1) changes &= last_bits(width);
            for (; changes != 0; changes &= changes - 1) add(i * bits_a_word + trailing_zeros(changes));
        }
        add(width);
    }
    /// The run that ends at the newest edge has the colour told, and so has the first of the five.
    void look(const int (&edge)[6], int y, bool dark) {
        const int middle = edge[3] - edge[2];
        if (middle <= edge[2] - edge[1] || middle <= edge[4] - edge[3]) return;
        FiveRuns runs;
        for (int i = 0; i < 5; ++i) runs.run[i] = edge[i + 1] - edge[i];
        runs.clip();
        if (!runs.fits(row_slack)) return;
        const int x = (edge[2] + edge[3] - 1) / 2;
        const bool inverted = !dark;
        const std::int64_t module = std::int64_t{runs.total()} * 256 / 7;
        for (FinderPattern& known : patterns_) {
            if (known.rings < sure_rings || !close(known, pixel_place(x, y), module, inverted)) continue;
            ++known.lines;
            return;
        }
        const int across = runs.total();
        if (known_not(x, y, across, dark)) return;
        if (check({bits_, inverted}, x, y, across)) rejected_[x % kept_rejected] = {x, y, across, dark};
    }
    /// What was found not to be a pattern in a row before, of which the same pixels of the column would tell.
    struct Rejected {
        int x = -1;
        int y = 0;
        int across = 0;
        bool dark = false;
    };
    /// Whether the middle run of the column goes on from a row where the same was rejected.
    bool known_not(int x, int y, int across, bool dark) {
        Rejected& known = rejected_[x % kept_rejected];
        if (known.x != x || known.across != across || known.dark != dark || known.y != y - step_)
            return false;
        for (int between = known.y + 1; between < y; ++between)
            if (bits_(x, between) != dark) return false;
        known.y = y;
        return true;
    }
    /// Adds the pattern that has its middle run there, or answers that there is none, which then holds for
    /// all rows below in the same run of the column.
    bool check(const FinderImage& image, int x, int y, int across) {
        const CrossRuns down = cross_runs(image, x, y, 0, 1, across);
        if (!down.complete || !down.runs.fits(cross_slack)) return !down.goes_on;
        const int height = down.runs.total();
        if (height * 3 < across || across * 3 < height) return true;
        const int centre_y = y + floor_divide(down.twice_centre + 1, 2);
        if (!image.dark(x, centre_y)) return true;
        const CrossRuns again = cross_runs(image, x, centre_y, 1, 0, across);
        if (!again.complete || !again.runs.fits(cross_slack)) return true;
        const int centre_x = x + floor_divide(again.twice_centre + 1, 2);
        int diagonals = 0;
        int steps = 0;
        for (const int turn : {-1, 1}) {
            const CrossRuns diagonal =
                cross_runs(image, centre_x, centre_y, turn, 1, maximum(across, height));
            if (!diagonal.complete || !diagonal.runs.fits(diagonal_slack)) continue;
            ++diagonals;
            steps += diagonal.runs.total();
        }
        if (diagonals == 0) return true;
        // Rows and columns cross a pattern that is turned by an eighth from corner to corner; then the
        // diagonals, whose steps are 1.414 px, tell its sides. In 1/256, 362 for that root.
        const int width = again.runs.total();
        const std::int64_t turned = minimum<std::int64_t>(
            256, std::int64_t{362} * 2 * steps / (std::int64_t{width} + height) / diagonals);
        FinderPattern found;
        found.centre = {std::int64_t{2 * x + again.twice_centre} * 128,
                        std::int64_t{2 * y + down.twice_centre} * 128};
        found.rings = rings(image, found.centre, width * turned / 256, height * turned / 256);
        if (found.rings < least_rings) return true;
        found.module = (std::int64_t{width} + height) * turned / 14;
        found.inverted = image.inverted;
        add(found);
        return false;
    }
    /// Whether a row that crosses a pattern there is likely to cross the known one.
    static bool close(const FinderPattern& known, ModulePoint centre, std::int64_t module, bool inverted) {
        const ModulePoint away = known.centre - centre;
        const std::uint64_t near = magnitude(minimum(known.module, module) * 5 / 2);
        return known.inverted == inverted && magnitude(away.x) < near && magnitude(away.y) < near;
    }
    void add(const FinderPattern& found) {
        for (FinderPattern& known : patterns_) {
            if (!close(known, found.centre, found.module, found.inverted)) continue;
            const int lines = known.lines + 1;
            if (found.rings > known.rings) known = found;
            known.lines = lines;
            return;
        }
        if (patterns_.push(found) != Status::ok) replace_weakest(found);
    }
    /// A circle of 2.3 modules is in the light ring in every direction of the sides, one of 1.2 in the dark
    /// middle. Sines of sixteenths of a turn, in 1/256.
    static int rings(const FinderImage& image, ModulePoint centre, std::int64_t width, std::int64_t height) {
        constexpr int sine[20] = {0,    98,   181,  237,  256,  237, 181, 98, 0,   -98,
                                  -181, -237, -256, -237, -181, -98, 0,   98, 181, 237};
        int right = 0;
        // Until they are too few even if all that follow are right.
        for (int i = 0; i < 16 && right + most_finder_rings - (3 * i + 1) / 2 >= least_rings; ++i) {
            const ModulePoint way{sine[i + 4] * width, sine[i] * height};
            right += image.dark(centre + way * 23 / 70) ? 0 : 1;
            if (i % 2 == 0) right += image.dark(centre + way * 12 / 70) ? 1 : 0;
        }
        return right;
    }
    /// A full list gives up the weakest pattern, if the new one is better.
    void replace_weakest(const FinderPattern& found) {
        FinderPattern* weakest = patterns_.begin();
        for (FinderPattern& known : patterns_)
            if (stronger(*weakest, known)) weakest = &known;
        if (stronger(found, *weakest)) *weakest = found;
    }

    static constexpr int row_slack = 14;
    static constexpr int cross_slack = 18;
    static constexpr int diagonal_slack = 26;
    static constexpr int least_rings = 18;
    static constexpr int sure_rings = 22;

    static constexpr int kept_rejected = 8;

    BitView<const BitWord> bits_;
    ListView<FinderPattern> patterns_;
    int step_ = 1;
    Rejected rejected_[kept_rejected];
};

}  // namespace fovea::detail
