// SPDX-License-Identifier: MIT
//
// The annotated picture: every part with its frame, its probes, what they found, and the verdicts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <fovea/draw/arrow.hpp>
#include <fovea/draw/cross.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/draw/text.hpp>

#include <common/picture_file.hpp>
#include <gauge/left_out.hpp>
#include <gauge/report.hpp>

namespace fovea::apps {

/// Draws results over the image they were measured in, and what was left out. Small images are magnified.
/// reason says why there is no part, "" if there is one.
Picture<Rgb888> explain(const Picture<Gray8>& image, const Recipe& recipe,
                        const std::vector<PartResult>& parts, const LeftOut& left_out = {},
                        const std::string& reason = "");

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr Rgb888 colour_ok{60, 220, 90};
inline constexpr Rgb888 colour_bad{255, 70, 60};
inline constexpr Rgb888 colour_unmeasured{255, 180, 40};
inline constexpr Rgb888 colour_probe{90, 170, 255};
inline constexpr Rgb888 colour_frame{255, 220, 70};
inline constexpr Rgb888 colour_paper{16, 20, 28};

inline Rgb888 colour_of(Verdict verdict) {
    return verdict == Verdict::ok           ? colour_ok
           : verdict == Verdict::unmeasured ? colour_unmeasured
                                            : colour_bad;
}

/// One picture in the making. Drawing outside is clipped, so nothing here can fail.
class Explanation {
public:
    Explanation(const Picture<Gray8>& image, const Recipe& recipe) : recipe_(recipe) {
        zoom_ = clamp(640 / maximum(image.size.width, 1), 1, 4);
        picture_ = Picture<Rgb888>({image.size.width * zoom_, image.size.height * zoom_});
        const auto from = image.view();
        const auto to = picture_.view();
        for (int y = 0; y < to.height(); ++y)
            for (int x = 0; x < to.width(); ++x) {
                const Gray8 level = from(x / zoom_, y / zoom_);
                to(x, y) = {level, level, level};
            }
    }

    void add(int index, const PartResult& part) {
        const Rgb888 colour = colour_of(part.verdict);
        const Rectangle& box = part.box;
        frame_box(box, colour);
        const PartFrame& frame = part.pose.frame;
        const std::int64_t reach = maximum(box.width, box.height) * recipe_.scale.x_per_pixel / 4;
        if (part.pose.orientation == Status::ok && recipe_.locate.orientation != OrientationRule::none)
            arrow(frame.to_image({0, 0}), frame.to_image({reach, 0}));
        draw(draw_cross(picture_.view(), place(frame.origin()), 3 * zoom_, colour_frame));
        const Point corner{box.x * zoom_, box.y * zoom_ - 16};
        label(corner,
              "part " + std::to_string(index) + " " +
                  (part.verdict == Verdict::ok       ? "OK"
                   : part.verdict == Verdict::not_ok ? "NOT OK"
                                                     : "NOT JUDGED"),
              colour);
        if (part.pose.orientation != Status::ok) return;
        // Where the parts' labels stand, a count has no place of its own.
        for (int i = 0; i < part.feature_count; ++i)
            if (recipe_.features[i].kind == FeatureKind::hole_count)
                label(corner, human_feature(part.features[i], recipe_.features[i], recipe_.scale),
                      colour_of(part.features[i].verdict));
        for (int i = 0; i < part.feature_count; ++i)
            if (recipe_.features[i].kind != FeatureKind::hole_count)
                add_feature(frame, part.features[i], recipe_.features[i]);
    }

    void add_left_out(const Region& region, const std::string& why) {
        frame_box(region.box, colour_unmeasured);
        label({region.box.x * zoom_, region.box.y * zoom_ - 16}, why, colour_unmeasured);
    }

    void add_reason(const std::string& reason) {
        if (!reason.empty()) label({0, 0}, reason, colour_unmeasured);
    }

    /// Labels come last, so that no line crosses a number.
    Picture<Rgb888> finish() {
        for (const Label& each : labels_)
            draw(draw_label(picture_.view(),
                            each.box.x >= 0 ? Point{each.box.x, each.box.y} : Point{0, each.box.y},
                            span_of(each.text), each.colour, colour_paper));
        return picture_;
    }

private:
    struct Label {
        Rectangle box;
        std::string text;
        Rgb888 colour;
    };

    static void draw(Status) {}

    Point place(FinePoint point) const {
        const auto scaled = [&](FinePixel value) {
            // Pixel centres stay centres: (v + 1/2) zoom - 1/2.
            const std::int64_t raw = std::int64_t{value.raw()} * zoom_ + (zoom_ - 1) * (FinePixel::one / 2);
            return static_cast<int>(round_shift(raw, FinePixel::fraction_bits));
        };
        return {scaled(point.x), scaled(point.y)};
    }
    void line(const Result<FinePoint>& from, const Result<FinePoint>& to, Rgb888 colour) {
        if (from && to) draw(draw_line(picture_.view(), place(*from), place(*to), colour));
    }
    void arrow(const Result<FinePoint>& from, const Result<FinePoint>& to) {
        if (from && to) draw(draw_arrow(picture_.view(), place(*from), place(*to), colour_frame, 6 * zoom_));
    }

    void frame_box(const Rectangle& box, Rgb888 colour) {
        draw(draw_rectangle(picture_.view(),
                            {box.x * zoom_, box.y * zoom_, box.width * zoom_, box.height * zoom_}, colour));
    }

    void add_feature(const PartFrame& frame, const FeatureResult& result, const Feature& feature) {
        const bool measured = result.status == Status::ok;
        const Rgb888 colour = measured ? colour_probe : colour_unmeasured;
        const bool along = feature.kind == FeatureKind::distance || feature.kind == FeatureKind::width;
        const bool angle = feature.kind == FeatureKind::angle;
        if (along || angle) line(frame.to_image(feature.from), frame.to_image(feature.to), colour);
        if (angle) line(frame.to_image(feature.second_from), frame.to_image(feature.second_to), colour);
        const Result<FinePoint> where =
            measured ? add_found(frame, result, feature)
            : along || angle
                ? frame.to_image(point_between(feature.from, feature.to, 1, 2))
                : circle(frame, feature.centre,
                         feature.kind == FeatureKind::diameter ? feature.radius : feature.search, colour);
        if (!where) return;
        const Point corner = place(*where);
        const std::string text =
            measured ? human_feature(result, feature, recipe_.scale) : text_of(feature.name) + " ?";
        label({corner.x + 4, corner.y + 4}, text, colour_of(result.verdict));
    }

    /// Draws what was measured and answers the place of its label.
    Result<FinePoint> add_found(const PartFrame& frame, const FeatureResult& result, const Feature& feature) {
        const Measurement& found = result.measurement;
        const Rgb888 colour = colour_of(result.verdict);
        const bool angle = feature.kind == FeatureKind::angle;
        const bool along = feature.kind == FeatureKind::distance || feature.kind == FeatureKind::width;
        if (along || angle) line(found.marks[0], found.marks[1], colour);
        if (angle) line(found.marks[2], found.marks[3], colour);
        for (int i = 0; i < found.mark_count; ++i) {
            const Point mark = place(found.marks[i]);
            if (feature.kind == FeatureKind::position && i == 1)
                draw(draw_diagonal_cross(picture_.view(), mark, 2 * zoom_, colour_probe));
            else
                draw(draw_cross(picture_.view(), mark, 3 * zoom_, colour));
        }
        if (angle) return found.marks[2];
        if (along) return found.marks[1];
        if (feature.kind == FeatureKind::position) return frame.to_image(feature.centre);
        return circle(frame, frame.to_part(found.marks[0]), found.value.millionths / 2, colour);
    }

    /// Draws a circle of the part and answers its lower right, nothing if all of it is outside.
    Result<FinePoint> circle(const PartFrame& frame, PartPoint centre, std::int64_t radius, Rgb888 colour) {
        constexpr int corners = 72;
        const auto sum_of = [](FinePoint point) { return std::int64_t{point.x.raw()} + point.y.raw(); };
        Result<FinePoint> last = Status::not_found;
        Result<FinePoint> lower_right = Status::not_found;
        for (int i = 0; i <= corners; ++i) {
            const UnitVector way = unit_vector(
                FineAngle(Angle::from_raw(static_cast<std::uint16_t>(65536 * (i % corners) / corners))));
            const Result<FinePoint> next =
                frame.to_image(centre + PartPoint{multiply_divide(radius, way.x.raw(), Unit::one),
                                                  multiply_divide(radius, way.y.raw(), Unit::one)});
            line(last, next, colour);
            last = next;
            if (next && (!lower_right || sum_of(*next) > sum_of(*lower_right))) lower_right = next;
        }
        return lower_right;
    }

    /// Finds a free place near the wanted one, downwards.
    void label(Point corner, const std::string& text, Rgb888 colour) {
        const Size size = label_size(span_of(text));
        Rectangle box{clamp(corner.x, 0, maximum(picture_.size.width - size.width, 0)),
                      clamp(corner.y, 0, maximum(picture_.size.height - size.height, 0)), size.width,
                      size.height};
        const auto taken = [&] {
            for (const Label& other : labels_)
                if (box.x <= other.box.right() && other.box.x <= box.right() && box.y <= other.box.bottom() &&
                    other.box.y <= box.bottom())
                    return true;
            return false;
        };
        for (int tries = 0; tries < 40 && taken(); ++tries) box.y += size.height + 1;
        labels_.push_back({box, text, colour});
    }

    const Recipe& recipe_;
    int zoom_ = 1;
    Picture<Rgb888> picture_;
    std::vector<Label> labels_;
};

}  // namespace detail

inline Picture<Rgb888> explain(const Picture<Gray8>& image, const Recipe& recipe,
                               const std::vector<PartResult>& parts, const LeftOut& left_out,
                               const std::string& reason) {
    detail::Explanation explanation(image, recipe);
    explanation.add_reason(reason);
    for (std::size_t i = 0; i < parts.size(); ++i) explanation.add(static_cast<int>(i), parts[i]);
    for (const Region& region : left_out.at_border) explanation.add_left_out(region, "at the border");
    for (const Region& region : left_out.too_small) explanation.add_left_out(region, "too small");
    for (const Region& region : left_out.too_large) explanation.add_left_out(region, "too large");
    return explanation.finish();
}

}  // namespace fovea::apps
