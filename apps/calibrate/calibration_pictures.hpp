// SPDX-License-Identifier: MIT
//
// Pictures of a calibration: the corners that were found in an image, and where in the pictures of a camera
// the board was, with how far off each corner is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/draw/circle.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/draw/text.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

#include <calibrate/camera_estimate.hpp>
#include <calibrate/coverage.hpp>
#include <calibrate/figures.hpp>
#include <calibrate/seen_board.hpp>
#include <common/picture_file.hpp>

namespace fovea::apps {

/// An image with the corners of its board, joined in their order, rows in six colours, a ring at the first;
/// or with the reason why there is none. Small images are magnified.
Picture<Rgb888> explain_board(const Picture<Gray8>& image, const SeenBoard& seen, const Board& board);

/// What the picture of a camera's coverage shows.
struct CoveragePanel {
    std::string title;
    const std::vector<SeenBoard>* boards = nullptr;
    const CameraEstimate* estimate = nullptr;
};

/// Every corner at its place, coloured by how far off it is, with a line to where the camera sees it, many
/// times as long; cells of the picture without a corner are hatched. Cameras side by side.
Picture<Rgb888> coverage_picture(const std::vector<CoveragePanel>& panels);

// ---- Implementation ---------------------------------------------------------------

inline Picture<Rgb888> explain_board(const Picture<Gray8>& image, const SeenBoard& seen, const Board& board) {
    const int zoom = clamp(800 / maximum(image.size.width, 1), 1, 4);
    Picture<Rgb888> picture({image.size.width * zoom, image.size.height * zoom});
    const auto view = picture.view();
    for (int y = 0; y < view.height(); ++y)
        for (int x = 0; x < view.width(); ++x) {
            // A little darker, so that the colours stand out.
            const auto level = static_cast<Gray8>(image.view()(x / zoom, y / zoom) * 13 / 16);
            view(x, y) = {level, level, level};
        }
    const int pen = clamp(maximum(view.width(), view.height()) / 1000, 1, max_text_scale);
    const auto place = [&](const SubPixelPoint& corner) {
        const auto scaled = [&](SubPixel at) {
            return static_cast<int>(
                round_shift((std::int64_t{at.raw()} * 2 + 256) * zoom - 256, SubPixel::fraction_bits + 1));
        };
        return Point{scaled(corner.x), scaled(corner.y)};
    };
    const auto draw = [](Status) {};  // what lies outside is not drawn
    constexpr Rgb888 rows[] = {{255, 80, 70},  {255, 165, 40}, {250, 235, 80},
                               {90, 225, 100}, {70, 200, 255}, {190, 140, 255}};
    const int count = static_cast<int>(seen.corners.size());
    Point last;
    for (int i = 0; i < count; ++i) {
        const Point at = place(seen.corners[static_cast<std::size_t>(i)]);
        const Rgb888 colour = rows[i / board.size.width % 6];
        if (i > 0) draw(draw_line(view, last, at, colour, pen));
        draw(draw_circle(view, at, 4 * pen, colour, pen));
        last = at;
    }
    if (count > 0) draw(draw_circle(view, place(seen.corners[0]), 9 * pen, {255, 240, 120}, 2 * pen));
    const std::string words =
        count > 0 ? std::to_string(count) + " " + what_is_seen(board.pattern) : seen.reason;
    draw(draw_label(view, {2 * pen, 2 * pen}, span_of(words),
                    count > 0 ? Rgb888{70, 230, 100} : Rgb888{255, 160, 30}, {16, 20, 28}, pen + 1));
    return picture;
}

namespace detail {

/// A camera's corners on paper.
class CoverageDrawing {
public:
    static constexpr int plot_width = 640;
    static constexpr int margin_left = 44;
    static constexpr int margin_right = 36;
    static constexpr int top = 54;
    static constexpr int below = 104;

    static Size size_of(Size picture) {
        return {margin_left + plot_width + margin_right, top + plot_height(picture) + below};
    }
    CoverageDrawing(ImageView<Rgb888> paper, int left, const CoveragePanel& panel)
        : paper_(paper),
          panel_(panel),
          picture_(panel.estimate->picture),
          corner_{left + margin_left, top},
          size_{plot_width, plot_height(picture_)},
          times_(times_for(panel.estimate->calibration.rms, picture_.width)) {}

    void draw() {
        const CameraEstimate& estimate = *panel_.estimate;
        std::size_t points = 0;
        for (const ViewFit& view : estimate.views) points += view.residuals.size();
        text({corner_.x, 10}, panel_.title, ink, 2);
        text({corner_.x, 34}, std::to_string(estimate.views.size()) + " views, " + std::to_string(points) +
                                  " corners, rms " + number(estimate.calibration.rms, 3) + " px");
        put(fill_rectangle(paper_, {corner_.x, corner_.y, size_.width, size_.height}, white));
        hatch_empty_cells();
        grid();
        // Lines first, so that they hide no dot.
        for (const bool dots : {false, true})
            for (const ViewFit& view : estimate.views) corners(view, dots);
        put(draw_rectangle(paper_, {corner_.x - 1, corner_.y - 1, size_.width + 2, size_.height + 2}, ink));
        legend();
    }

private:
    static constexpr Rgb888 ink{40, 44, 52};
    static constexpr Rgb888 white{255, 255, 255};
    static constexpr Rgb888 faint{206, 208, 212};
    static constexpr Rgb888 hatching{240, 150, 110};
    static constexpr Rgb888 empty_ground{255, 240, 232};
    /// Upper ends of the classes of a residual in multiples of the rms, and their colours.
    struct Class {
        int halves;
        Rgb888 colour;
    };
    static constexpr Class classes[] = {
        {2, {24, 120, 190}}, {4, {30, 150, 80}}, {6, {225, 140, 0}}, {0, {205, 30, 40}}};

    static int plot_height(Size picture) {
        return clamp(static_cast<int>(std::int64_t{plot_width} * picture.height / maximum(picture.width, 1)),
                     40, 4 * plot_width);
    }
    /// How many times as long as they are residuals are drawn: 1, 2, 5, 10 ... 1000, so that on average they
    /// are 12 px on paper at most.
    static int times_for(const Real& rms, int width) {
        const Real on_paper = rms * Real::from_ratio(plot_width, maximum(width, 1));
        int times = 1;
        for (const int next : {2, 5, 10, 20, 50, 100, 200, 500, 1000})
            if (on_paper * Real::from_int(next) <= Real::from_int(12)) times = next;
        return times;
    }
    static void put(Status) {}  // what lies outside is not drawn
    void text(Point at, const std::string& words, Rgb888 colour = ink, int scale = 1) {
        put(draw_text(paper_, at, span_of(words), colour, scale));
    }
    /// Where a place of the picture is on paper.
    Point at(const Real& x, const Real& y) const {
        const auto along = [](const Real& place, int plot, int length) {
            return static_cast<int>(
                ((place + Real::from_int(1, -1)) * Real::from_ratio(plot, length)).rounded(0));
        };
        return {corner_.x + along(x, size_.width, picture_.width),
                corner_.y + along(y, size_.height, picture_.height)};
    }
    Rectangle cell(int column, int row) const {
        const int left = size_.width * column / Coverage::side;
        const int up = size_.height * row / Coverage::side;
        return {corner_.x + left, corner_.y + up, size_.width * (column + 1) / Coverage::side - left,
                size_.height * (row + 1) / Coverage::side - up};
    }
    void hatch_empty_cells() {
        Coverage coverage(picture_);
        for (const ViewFit& view : panel_.estimate->views) coverage.add((*panel_.boards)[view.seen].span());
        for (int row = 0; row < Coverage::side; ++row)
            for (int column = 0; column < Coverage::side; ++column)
                if (coverage.count(column, row) == 0) hatch(cell(column, row));
    }
    void hatch(const Rectangle& box) {
        hatched_ = true;
        for (int y = box.y; y < box.y + box.height; ++y)
            for (int x = box.x; x < box.x + box.width; ++x)
                paper_(x, y) = floor_modulo(x + y, 10) < 2 ? hatching : empty_ground;
    }
    void grid() {
        for (int i = 0; i <= Coverage::side; ++i) {
            const int x = corner_.x + size_.width * i / Coverage::side;
            const int y = corner_.y + size_.height * i / Coverage::side;
            if (i > 0 && i < Coverage::side) {
                put(draw_line(paper_, {x, corner_.y}, {x, corner_.y + size_.height - 1}, faint));
                put(draw_line(paper_, {corner_.x, y}, {corner_.x + size_.width - 1, y}, faint));
            }
            const std::string across = std::to_string(picture_.width * i / Coverage::side);
            const std::string down = std::to_string(picture_.height * i / Coverage::side);
            text({x - 3 * static_cast<int>(across.size()), corner_.y + size_.height + 5},
                 across + (i == Coverage::side ? " px" : ""));
            text({corner_.x - 6 - 6 * static_cast<int>(down.size()), y - 3}, down);
        }
    }
    Rgb888 colour_of(const Real& residual) const {
        for (const Class& one : classes)
            if (one.halves == 0 ||
                residual <= panel_.estimate->calibration.rms * Real::from_ratio(one.halves, 2))
                return one.colour;
        return ink;
    }
    void corners(const ViewFit& view, bool dots) {
        const SeenBoard& board = (*panel_.boards)[view.seen];
        const Real factor = Real::from_int(times_);
        for (std::size_t i = 0; i < board.corners.size(); ++i) {
            const Real x = Real::from_fixed(board.corners[i].x);
            const Real y = Real::from_fixed(board.corners[i].y);
            const Vector<2>& off = view.residuals[i];
            const Rgb888 colour = colour_of(length_of(off));
            if (dots)
                put(fill_circle(paper_, at(x, y), 2, colour));
            else
                put(draw_line(paper_, at(x, y), at(x + off[0] * factor, y + off[1] * factor), colour));
        }
    }
    void legend() {
        int y = corner_.y + size_.height + 24;
        int x = corner_.x;
        text({x, y},
             "a dot is a corner of the board; its line leads to where the calibrated camera sees it, " +
                 std::to_string(times_) + " times as long");
        y += 20;
        std::string least = "0";
        for (const Class& one : classes) {
            const std::string most =
                number(panel_.estimate->calibration.rms * Real::from_ratio(one.halves, 2), 2);
            const std::string words = one.halves == 0 ? "above " + least : least + " to " + most + " px off";
            put(fill_circle(paper_, {x + 5, y + 3}, 4, one.colour));
            text({x + 15, y}, words + (one.halves == 0 ? " px off" : ""));
            x += 160;
            least = most;
        }
        y += 20;
        if (!hatched_) return;
        hatch({corner_.x, y - 3, 24, 14});
        text({corner_.x + 32, y}, "no corner was seen here: the lens is not known there");
    }

    ImageView<Rgb888> paper_;
    const CoveragePanel& panel_;
    Size picture_;
    Point corner_;
    Size size_;
    int times_;
    bool hatched_ = false;
};

}  // namespace detail

inline Picture<Rgb888> coverage_picture(const std::vector<CoveragePanel>& panels) {
    Size size;
    for (const CoveragePanel& panel : panels) {
        const Size one = detail::CoverageDrawing::size_of(panel.estimate->picture);
        size = {size.width + one.width, std::max(size.height, one.height)};
    }
    Picture<Rgb888> picture(size);
    std::fill(picture.pixels.begin(), picture.pixels.end(), Rgb888{250, 250, 248});
    int left = 0;
    for (const CoveragePanel& panel : panels) {
        detail::CoverageDrawing(picture.view(), left, panel).draw();
        left += detail::CoverageDrawing::size_of(panel.estimate->picture).width;
    }
    return picture;
}

}  // namespace fovea::apps
