// SPDX-License-Identifier: MIT
//
// From three finder patterns to the plane of a QR code's modules.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <fovea/code/finder_frame.hpp>
#include <fovea/code/module_plane.hpp>
#include <fovea/code/qr_matrix.hpp>
#include <fovea/code/qr_tables.hpp>
#include <fovea/code/work_budget.hpp>

namespace fovea::detail {

/// Half a module, in the units of ModulePlane.
inline constexpr std::int64_t half_module = module_units / 2;
constexpr ModulePoint module_centre(int x, int y) {
    return {x * module_units + half_module, y * module_units + half_module};
}
constexpr ModulePoint module_corner(int x, int y) { return {x * module_units, y * module_units}; }

/// The place of every module: the plane, and what a curved surface departs from it at the alignment patterns.
struct QrGrid {
    ModulePlane plane;
    int lines = 0;  ///< of alignment patterns, 0 for none or a plane alone
    int line[max_qr_alignment_lines] = {};
    ModulePoint departure[max_qr_alignment_lines][max_qr_alignment_lines];

    /// What to add to the plane at a module: between the patterns in proportion, outside of them as at the
    /// nearest.
    ModulePoint departure_at(int x, int y) const {
        if (lines == 0) return {};
        const int column = cell(x);
        const int row = cell(y);
        const std::int64_t width = line[column + 1] - line[column];
        const std::int64_t height = line[row + 1] - line[row];
        const std::int64_t right = clamp<std::int64_t>(x - line[column], 0, width);
        const std::int64_t down = clamp<std::int64_t>(y - line[row], 0, height);
        const ModulePoint above =
            departure[row][column] * (width - right) + departure[row][column + 1] * right;
        const ModulePoint below =
            departure[row + 1][column] * (width - right) + departure[row + 1][column + 1] * right;
        return (above * (height - down) + below * down) / (width * height);
    }

private:
    int cell(int x) const {
        int index = 0;
        while (index < lines - 2 && x >= line[index + 1]) ++index;
        return index;
    }
};

class QrLocator {
public:
    explicit QrLocator(const FinderImage& image) : image_(image) {}

    /// Takes three finders for those of a symbol: the one at its corner, to the right of that, and below.
    bool begin(const FinderPattern& corner, const FinderPattern& right, const FinderPattern& below) {
        const ModulePoint u = right.centre - corner.centre;
        const ModulePoint v = below.centre - corner.centre;
        if (!frame_[0].measure(image_, corner.centre, corner.module, u, v)) return false;
        if (!frame_[1].measure(image_, right.centre, right.module, u, v)) return false;
        if (!frame_[2].measure(image_, below.centre, below.module, u, v)) return false;
        estimate_sizes();
        return sizes_ > 0;
    }
    /// Sizes that the symbol may have, the likelier first.
    int sizes() const { return sizes_; }
    int size(int index) const { return size_[index]; }

    /// The planes for a size, the best first.
    int find_planes(int size) {
        planes_ = 0;
        ModulePoint far;
        if (far_corner(far)) add_plane(size, module_corner(size, size), far);
        // As if it were seen without perspective.
        add_plane(size, module_centre(size - 4, size - 4),
                  frame_[1].centre() + frame_[2].centre() - frame_[0].centre());
        const int version = (size - 17) / 4;
        if (version >= 2 && planes_ > 0) {
            const ModulePoint place = module_centre(size - 7, size - 7);
            ModulePoint found;
            const bool seen = find_alignment(plane_[0], place, plane_[0](place), 4, found) ||
                              (planes_ > 1 && find_alignment(plane_[1], place, plane_[1](place), 4, found));
            if (seen) add_plane(size, place, found);
        }
        for (int i = 0; i < planes_; ++i) fit_[i] = fit(plane_[i], size);
        for (int i = 1; i < planes_; ++i) {
            for (int j = i; j > 0 && fit_[j] > fit_[j - 1]; --j) {
                const ModulePlane plane = plane_[j];
                plane_[j] = plane_[j - 1];
                plane_[j - 1] = plane;
                const int value = fit_[j];
                fit_[j] = fit_[j - 1];
                fit_[j - 1] = value;
            }
        }
        return planes_;
    }
    const ModulePlane& plane(int index) const { return plane_[index]; }
    /// How many of a thousand pattern modules are as they must be.
    int fit(int index) const { return fit_[index]; }

    /// Moves the corners of a plane while that makes the patterns fit better.
    int refine(int size, ModulePlane& plane) const {
        ModulePoint modules[4] = {module_corner(0, 0), module_corner(size, 0), module_corner(size, size),
                                  module_corner(0, size)};
        ModulePoint places[4];
        for (int i = 0; i < 4; ++i) places[i] = plane(modules[i]);
        int best = fit(plane, size);
        std::int64_t step = maximum(length(frame_[0].u()), length(frame_[0].v())) / 2;
        for (int round = 0; round < 5; ++round, step = step * 5 / 8) {
            for (int i = 0; i < 8; ++i) {
                for (const int sign : {-1, 1}) {
                    const ModulePoint before = places[i / 2];
                    (i % 2 == 0 ? places[i / 2].x : places[i / 2].y) += sign * step;
                    const Result<ModulePlane> moved = ModulePlane::through(modules, places);
                    const int points = moved ? fit(*moved, size) : 0;
                    if (points > best) {
                        best = points;
                        plane = *moved;
                    } else {
                        places[i / 2] = before;
                    }
                }
            }
        }
        return best;
    }
    /// Moves the corner that has no finder while that makes the modules near it more even: the patterns
    /// hardly tell where it is.
    ///
    /// Time  at most 145 times even_work(size) units of work; it ends with the budget
    void settle(int size, ModulePlane& plane, WorkBudget& budget) const {
        const ModulePoint modules[4] = {module_corner(0, 0), module_corner(size, 0),
                                        module_corner(size, size), module_corner(0, size)};
        ModulePoint places[4];
        for (int i = 0; i < 4; ++i) places[i] = plane(modules[i]);
        const int work = even_work(size);
        budget.spend(work);
        int best = evenness(plane, size);
        const std::int64_t module = maximum(length(frame_[0].u()), length(frame_[0].v()));
        for (std::int64_t step = module; step >= module / 4; step /= 2) {
            bool moved = true;
            for (int round = 0; round < 6 && moved; ++round) {
                moved = false;
                for (int i = 0; i < 8; ++i) {
                    constexpr int way[8][2] = {{1, 0}, {-1, 0},  {0, 1},  {0, -1},
                                               {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
                    if (budget.spent()) return;
                    budget.spend(work);
                    const ModulePoint before = places[2];
                    places[2] = before + ModulePoint{way[i][0] * step, way[i][1] * step};
                    const Result<ModulePlane> other = ModulePlane::through(modules, places);
                    const int points = other ? evenness(*other, size) : 0;
                    if (points > best) {
                        best = points;
                        plane = *other;
                        moved = true;
                    } else {
                        places[2] = before;
                    }
                }
            }
        }
    }
    /// The plane with the departures of all alignment patterns that are found.
    void find_grid(int size, const ModulePlane& plane, QrGrid& grid) const {
        grid.plane = plane;
        const int version = (size - 17) / 4;
        grid.lines = 0;
        const int lines = qr_alignment_lines(version);
        if (lines < 3) return;
        for (int i = 0; i < lines; ++i) grid.line[i] = qr_alignment_line(version, i);
        for (int row = 0; row < lines; ++row) {
            for (int column = 0; column < lines; ++column) {
                ModulePoint near;
                if (row > 0 && column > 0)
                    near = (grid.departure[row - 1][column] + grid.departure[row][column - 1]) / 2;
                else if (row > 0)
                    near = grid.departure[row - 1][column];
                else if (column > 0)
                    near = grid.departure[row][column - 1];
                const bool at_finder =
                    (row == 0 && (column == 0 || column == lines - 1)) || (column == 0 && row == lines - 1);
                const ModulePoint module = module_centre(grid.line[column], grid.line[row]);
                ModulePoint found;
                if (at_finder)
                    near = {};
                else if (find_alignment(plane, module, plane(module) + near, 2, found))
                    near = found - plane(module);
                grid.departure[row][column] = near;
            }
        }
        grid.lines = lines;
    }
    /// The share of pattern modules that fit, in thousandths.
    int fit(const ModulePlane& plane, int size) const {
        int right = 0;
        int all = 0;
        for (int corner = 0; corner < 3; ++corner) {
            const int left = corner == 1 ? size - 7 : 0;
            const int top = corner == 2 ? size - 7 : 0;
            for (int y = 0; y < 7; ++y) {
                ModulePlane::Walk walk(plane, module_centre(left, top + y), module_units);
                for (int x = 0; x < 7; ++x, ++all) {
                    const int away = maximum(x < 3 ? 3 - x : x - 3, y < 3 ? 3 - y : y - 3);
                    right += image_.dark(walk.next()) == (away != 2) ? 1 : 0;
                }
            }
        }
        for (int i = 8; i < size - 8; ++i, all += 2) {
            right += image_.dark(plane(module_centre(i, QrPatterns::timing))) == (i % 2 == 0) ? 1 : 0;
            right += image_.dark(plane(module_centre(QrPatterns::timing, i))) == (i % 2 == 0) ? 1 : 0;
        }
        if (size > qr_size(1)) {
            for (int y = -2; y <= 2; ++y) {
                ModulePlane::Walk walk(plane, module_centre(size - 9, size - 7 + y), module_units);
                for (int x = -2; x <= 2; ++x, ++all) {
                    right += image_.dark(walk.next()) == ring_dark(x, y) ? 1 : 0;
                }
            }
        }
        return right * 1000 / all;
    }

    /// Looks of begin(): 2 by 2 ways of 56 and 4 by 7 lines of 14 for each finder.
    static constexpr int begin_work = 3 * (4 * 56 + 28 * 14);

private:
    static constexpr int even_stride(int size) { return size / 40 + 1; }
    /// Looks of evenness(): at a half of its modules 2, at the others 4, across and down.
    static constexpr int even_work(int size) {
        const int side = (size - size / 2 + even_stride(size) - 1) / even_stride(size);
        return 6 * side * side;
    }
    static constexpr bool ring_dark(int x, int y) { return maximum(x < 0 ? -x : x, y < 0 ? -y : y) != 1; }
    /// How well modules that differ from the next one change half way to it, in the quarter opposite of the
    /// corner finder. Where nothing differs, as beside the symbol, nothing is gained.
    int evenness(const ModulePlane& plane, int size) const {
        const int stride = even_stride(size);
        int even = 0;
        for (int y = size / 2; y < size; y += stride) {
            for (int x = size / 2; x < size; x += stride) {
                even += change(plane, module_centre(x, y), {module_units, 0});
                even += change(plane, module_centre(x, y), {0, module_units});
            }
        }
        return even;
    }
    int change(const ModulePlane& plane, ModulePoint middle, ModulePoint way) const {
        const bool dark = image_.dark(plane(middle));
        if (image_.dark(plane(middle - way)) == dark) return 0;
        const bool own = image_.dark(plane(middle - way * 3 / 8)) == dark;
        const bool other = image_.dark(plane(middle - way * 5 / 8)) != dark;
        return own && other ? 1 : -1;
    }
    /// From the lengths between finders, and from the modules counted along the timing patterns.
    void estimate_sizes() {
        const std::int64_t across = length(frame_[1].centre() - frame_[0].centre());
        const std::int64_t along = length(frame_[2].centre() - frame_[0].centre());
        const std::int64_t twice_u = length(frame_[0].u()) + length(frame_[1].u());
        const std::int64_t twice_v = length(frame_[0].v()) + length(frame_[2].v());
        sizes_ = 0;
        if (twice_u == 0 || twice_v == 0) return;
        // Sixteenths of a module between the centres, the mean of both.
        const std::int64_t between = (across * 32 / twice_u + along * 32 / twice_v) / 2;
        const int estimate = static_cast<int>(clamp<std::int64_t>(between / 16 + 7, 0, 400));
        const int nearest = 17 + (estimate - 17 + 2) / 4 * 4;
        const int counted[2] = {counted_size(frame_[0].at(6, 6), frame_[1].at(-6, 6), twice_u / 2),
                                counted_size(frame_[0].at(6, 6), frame_[2].at(6, -6), twice_v / 2)};
        for (const int size : counted)
            if (size % 4 == 1 && size * 4 > estimate * 3 && size * 3 < estimate * 4) add_size(size);
        add_size(nearest);
        if (const int told = told_size(); told != 0 && told * 3 > estimate * 2 && told * 2 < estimate * 3)
            add_size(told);
        // The next best of those that are four apart.
        add_size(estimate >= nearest ? nearest + 4 : nearest - 4);
    }
    void add_size(int size) {
        if (size < qr_size(min_qr_version) || size > max_qr_size || sizes_ == 5) return;
        for (int i = 0; i < sizes_; ++i)
            if (size_[i] == size) return;
        size_[sizes_++] = size;
    }
    /// Changes of colour along a timing pattern, 14 less than the size.
    int counted_size(ModulePoint from, ModulePoint to, std::int64_t module) const {
        const ModulePoint way = to - from;
        const std::int64_t far = length(way);
        const std::int64_t step = maximum<std::int64_t>(module / 8, 32);
        const std::int64_t steps = far / step;
        if (steps < 8 || steps > 16384) return 0;
        bool dark = true;
        std::int64_t run = 0;
        int changes = 0;
        for (std::int64_t i = 0; i <= steps; ++i) {
            if (image_.dark(from + way * i / steps) == dark) {
                run = 0;
                continue;
            }
            // Less than a quarter of a module is noise.
            if (++run * step * 4 < module) continue;
            dark = !dark;
            run = 0;
            ++changes;
        }
        return changes + 14;
    }
    /// The version that is told at the finder to the right, or below, as a size; 0 if none is.
    int told_size() const {
        for (int copy = 0; copy < 2; ++copy) {
            unsigned word = 0;
            for (int bit = 0; bit < 18; ++bit) {
                // From the finder's centre it begins seven modules back.
                const int across = 2 * (bit % 3) - 14;
                const int along = 2 * (bit / 3) - 6;
                const ModulePoint place =
                    copy == 0 ? frame_[1].at(across, along) : frame_[2].at(along, across);
                if (image_.dark(place)) word |= 1U << bit;
            }
            if (const int version = nearest_qr_version(word); version != 0) return qr_size(version);
        }
        return 0;
    }
    /// Where the outer edges of the two other finders meet.
    bool far_corner(ModulePoint& corner) const {
        PlaceLine right, below;
        return frame_[1].edge(frame_[1].u(), frame_[1].v(), right) &&
               frame_[2].edge(frame_[2].v(), frame_[2].u(), below) && meet(right, below, corner);
    }
    /// The plane through the centres of the finders and a fourth pair.
    void add_plane(int size, ModulePoint module, ModulePoint place) {
        const ModulePoint modules[4] = {module_centre(3, 3), module_centre(size - 4, 3), module,
                                        module_centre(3, size - 4)};
        const ModulePoint places[4] = {frame_[0].centre(), frame_[1].centre(), place, frame_[2].centre()};
        const Result<ModulePlane> plane = ModulePlane::through(modules, places);
        if (plane && planes_ < max_planes) plane_[planes_++] = *plane;
    }
    /// Looks for an alignment pattern around a place, within so many modules each way, and answers the middle
    /// of the places where it fits best.
    bool find_alignment(const ModulePlane& plane, ModulePoint module, ModulePoint near, int reach,
                        ModulePoint& found) const {
        // The plane is flat enough over five modules.
        const ModulePoint u = (plane(module + ModulePoint{2 * module_units, 0}) -
                               plane(module - ModulePoint{2 * module_units, 0})) /
                              4;
        const ModulePoint v = (plane(module + ModulePoint{0, 2 * module_units}) -
                               plane(module - ModulePoint{0, 2 * module_units})) /
                              4;
        if (length(u) > 256 * 256 || length(v) > 256 * 256) return false;
        const auto dark = [&](ModulePoint centre, int x, int y) {
            return image_.dark(centre + u * x + v * y);
        };
        int best = 20;
        ModulePoint sum;
        int count = 0;
        for (int dy = -4 * reach; dy <= 4 * reach; ++dy) {
            for (int dx = -4 * reach; dx <= 4 * reach; ++dx) {
                const ModulePoint centre = near + (u * dx + v * dy) / 4;
                if (!image_.dark(centre) ||
                    dark(centre, -1, 0) + dark(centre, 1, 0) + dark(centre, 0, -1) + dark(centre, 0, 1) > 1)
                    continue;
                int right = 0;
                for (int y = -2; y <= 2; ++y)
                    for (int x = -2; x <= 2; ++x) right += dark(centre, x, y) == ring_dark(x, y) ? 1 : 0;
                if (right < best) continue;
                if (right > best) {
                    sum = {};
                    count = 0;
                    best = right;
                }
                sum = sum + centre;
                ++count;
            }
        }
        if (count == 0) return false;
        found = sum / count;
        return true;
    }

    static constexpr int max_planes = 4;

    FinderImage image_;
    FinderFrame frame_[3];
    int sizes_ = 0;
    int size_[5] = {};
    int planes_ = 0;
    ModulePlane plane_[max_planes];
    int fit_[max_planes] = {};
};

}  // namespace fovea::detail
