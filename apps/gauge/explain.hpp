// SPDX-License-Identifier: MIT
//
// The annotated picture: every part with its frame, its probes, what they found, and the verdicts; and what
// was not measured.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <fovea/draw/arrow.hpp>
#include <fovea/draw/cross.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/rectangle.hpp>

#include <common/picture_file.hpp>
#include <gauge/labels.hpp>
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

inline constexpr Rgb888 colour_ok{70, 230, 100};
inline constexpr Rgb888 colour_bad{255, 80, 70};
inline constexpr Rgb888 colour_unmeasured{255, 160, 30};
inline constexpr Rgb888 colour_probe{90, 170, 255};
inline constexpr Rgb888 colour_frame{255, 240, 120};
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
        zoom_ = clamp(960 / maximum(image.size.width, 1), 1, 4);
        picture_ = Picture<Rgb888>({image.size.width * zoom_, image.size.height * zoom_});
        // Lines and letters grow with the picture, which is looked at on one screen.
        constexpr int screen = 1280;
        pen_ = clamp((maximum(picture_.size.width, picture_.size.height) + screen / 2) / screen, 1,
                     max_text_scale);
        const auto from = image.view();
        const auto to = picture_.view();
        for (int y = 0; y < to.height(); ++y)
            for (int x = 0; x < to.width(); ++x) {
                // A little darker, so that the colours stand out on bright ground too.
                const auto level = static_cast<Gray8>(from(x / zoom_, y / zoom_) * 13 / 16);
                to(x, y) = {level, level, level};
            }
    }

    void add_part(int index, const PartResult& part) {
        const Rgb888 colour = colour_of(part.verdict);
        frame_region(part.box, colour);
        const PartFrame& frame = part.pose.frame;
        const bool directed = part.pose.orientation == Status::ok;
        const std::int64_t reach = maximum(part.box.width, part.box.height) * recipe_.scale.x_per_pixel / 4;
        if (directed && recipe_.locate.orientation != OrientationRule::none)
            arrow(frame.to_image({0, 0}), frame.to_image({reach, 0}));
        draw(draw_cross(picture_.view(), place(frame.origin()), 5 * pen_, colour_frame, pen_));
        std::vector<LabelLine> lines = {
            {"part " + std::to_string(index) + " " + human_verdict(part.verdict), colour}};
        if (!directed) lines.push_back({short_orientation_problem(part.pose.orientation), colour});
        for (int i = 0; directed && i < part.feature_count; ++i) {
            const FeatureResult& result = part.features[i];
            const Feature& feature = recipe_.features[i];
            const std::string text = human_feature(result, feature, recipe_.scale);
            if (feature.kind == FeatureKind::hole_count)
                lines.push_back({text, colour_of(result.verdict)});
            else
                notes_.push_back({add_feature(frame, result, feature), text, result.verdict});
        }
        titles_.push_back({part.box, lines});
    }

    void add_left_out(const std::vector<Region>& regions, const std::string& why) {
        for (const Region& region : regions) {
            frame_region(region.box, colour_unmeasured);
            titles_.push_back({region.box, {{why, colour_unmeasured}}});
        }
    }

    /// Labels come last, what matters most before the others. A reason is shown up to its first semicolon. In
    /// a crowded picture the values that are OK have their lines alone.
    Picture<Rgb888> finish(const std::string& reason) {
        Labels labels(picture_, pen_, colour_paper);
        const std::size_t columns =
            static_cast<std::size_t>(maximum(picture_.size.width / (6 * pen_) - 2, 1));
        if (!reason.empty())
            labels.put_above({3 * pen_, 0},
                             {{wrapped(reason.substr(0, reason.find(';')), columns), colour_unmeasured}});
        for (const Title& title : titles_)
            labels.put_above({title.box.x * zoom_, title.box.y * zoom_ - pen_}, title.lines);
        std::int64_t area = 0;
        for (const Note& note : notes_) area += label_size(span_of(note.text), pen_).area();
        const bool crowded = area > picture_.size.area() / 4;
        for (const bool ok : {false, true})
            for (const Note& note : notes_)
                if ((note.verdict == Verdict::ok) == ok && !(ok && crowded))
                    labels.put_beside(note.anchor, {note.text, colour_of(note.verdict)});
        labels.draw(picture_);
        return picture_;
    }

private:
    /// Lines above a box.
    struct Title {
        Rectangle box;
        std::vector<LabelLine> lines;
    };
    struct Note {
        Point anchor;
        std::string text;
        Verdict verdict;
    };

    static void draw(Status) {}

    void frame_region(const Rectangle& box, Rgb888 colour) {
        draw(draw_rectangle(picture_.view(),
                            {box.x * zoom_, box.y * zoom_, box.width * zoom_, box.height * zoom_}, colour,
                            pen_));
    }
    Point place(FinePoint point) const {
        const auto scaled = [&](FinePixel value) {
            // Pixel centres stay centres: (v + 1/2) zoom - 1/2.
            const std::int64_t raw = std::int64_t{value.raw()} * zoom_ + (zoom_ - 1) * (FinePixel::one / 2);
            return static_cast<int>(round_shift(raw, FinePixel::fraction_bits));
        };
        return {scaled(point.x), scaled(point.y)};
    }
    void line(const Result<FinePoint>& from, const Result<FinePoint>& to, Rgb888 colour) {
        // What was found is drawn thicker than where it was looked for.
        const int thickness = colour == colour_ok || colour == colour_bad ? pen_ + 1 : pen_;
        if (from && to) draw(draw_line(picture_.view(), place(*from), place(*to), colour, thickness));
    }
    void arrow(const Result<FinePoint>& from, const Result<FinePoint>& to) {
        if (from && to)
            draw(draw_arrow(picture_.view(), place(*from), place(*to), colour_frame, 9 * pen_, pen_));
    }
    void mark(FinePoint where, Rgb888 colour) {
        draw(draw_cross(picture_.view(), place(where), 5 * pen_, colour, pen_));
    }
    void expected_mark(FinePoint where, Rgb888 colour) {
        draw(draw_diagonal_cross(picture_.view(), place(where), 3 * pen_, colour, pen_));
    }

    /// Draws a feature, and answers the place its label belongs to.
    Point add_feature(const PartFrame& frame, const FeatureResult& result, const Feature& feature) {
        const bool measured = result.status == Status::ok;
        const Rgb888 probes = measured ? colour_probe : colour_unmeasured;
        const Rgb888 colour = colour_of(result.verdict);
        Result<FinePoint> where = Status::not_found;
        switch (feature.kind) {
            case FeatureKind::distance:
            case FeatureKind::width:
                line(frame.to_image(feature.from), frame.to_image(feature.to), probes);
                where = measured ? Result<FinePoint>(result.measurement.marks[1])
                                 : frame.to_image(point_between(feature.from, feature.to, 1, 2));
                if (measured) line(result.measurement.marks[0], result.measurement.marks[1], colour);
                break;
            case FeatureKind::angle: where = add_angle(frame, result, feature); break;
            default: where = add_round(frame, result, feature);
        }
        for (int i = 0; measured && i < result.measurement.mark_count; ++i)
            if (feature.kind == FeatureKind::position && i == 1)
                expected_mark(result.measurement.marks[i], colour_probe);
            else
                mark(result.measurement.marks[i], colour);
        return place(where ? *where : frame.origin());
    }

    /// Both edges of an angle; its label belongs to the corner, where the ends of the two are nearest.
    Result<FinePoint> add_angle(const PartFrame& frame, const FeatureResult& result, const Feature& feature) {
        const bool measured = result.status == Status::ok;
        const FinePoint* marks = result.measurement.marks;
        const Result<FinePoint> ends[] = {frame.to_image(feature.from), frame.to_image(feature.to),
                                          frame.to_image(feature.second_from),
                                          frame.to_image(feature.second_to)};
        for (const int i : {0, 2}) {
            line(ends[i], ends[i + 1], measured ? colour_probe : colour_unmeasured);
            if (measured) line(marks[i], marks[i + 1], colour_of(result.verdict));
        }
        const PartPoint places[] = {feature.from, feature.to, feature.second_from, feature.second_to};
        int nearest[] = {0, 2};
        for (const int first : {0, 1})
            for (const int second : {2, 3})
                if (length_of(places[first] - places[second]) <
                    length_of(places[nearest[0]] - places[nearest[1]])) {
                    nearest[0] = first;
                    nearest[1] = second;
                }
        return frame.to_image(point_between(places[nearest[0]], places[nearest[1]], 1, 2));
    }

    /// A circle or the place of a hole: what was found, or where it was looked for.
    Result<FinePoint> add_round(const PartFrame& frame, const FeatureResult& result, const Feature& feature) {
        const Measurement& found = result.measurement;
        if (result.status == Status::ok) {
            if (feature.kind == FeatureKind::position) return found.marks[0];
            return circle(frame, frame.to_part(found.marks[0]), found.value.millionths / 2,
                          colour_of(result.verdict));
        }
        const Result<FinePoint> centre = frame.to_image(feature.centre);
        if (centre) expected_mark(*centre, colour_unmeasured);
        if (feature.kind == FeatureKind::diameter && feature.radius > feature.search)
            static_cast<void>(
                circle(frame, feature.centre, feature.radius - feature.search, colour_unmeasured));
        const std::int64_t expected = feature.kind == FeatureKind::diameter ? feature.radius : 0;
        const Result<FinePoint> rim =
            circle(frame, feature.centre, expected + feature.search, colour_unmeasured);
        return rim ? rim : centre;
    }

    /// Draws a circle and answers its lower right.
    Result<FinePoint> circle(const PartFrame& frame, PartPoint centre, std::int64_t radius, Rgb888 colour) {
        constexpr int corners = 72;
        Result<FinePoint> last = Status::not_found;
        Result<FinePoint> lower_right = Status::not_found;
        const auto down_right = [](FinePoint point) { return std::int64_t{point.x.raw()} + point.y.raw(); };
        for (int i = 0; i <= corners; ++i) {
            const UnitVector way = unit_vector(
                FineAngle(Angle::from_raw(static_cast<std::uint16_t>(65536 * (i % corners) / corners))));
            const Result<FinePoint> next =
                frame.to_image(centre + PartPoint{multiply_divide(radius, way.x.raw(), Unit::one),
                                                  multiply_divide(radius, way.y.raw(), Unit::one)});
            line(last, next, colour);
            last = next;
            if (next && (!lower_right || down_right(*next) > down_right(*lower_right))) lower_right = next;
        }
        return lower_right;
    }

    const Recipe& recipe_;
    int zoom_ = 1;
    int pen_ = 1;
    Picture<Rgb888> picture_;
    std::vector<Title> titles_;
    std::vector<Note> notes_;
};

}  // namespace detail

inline Picture<Rgb888> explain(const Picture<Gray8>& image, const Recipe& recipe,
                               const std::vector<PartResult>& parts, const LeftOut& left_out,
                               const std::string& reason) {
    detail::Explanation explanation(image, recipe);
    for (std::size_t i = 0; i < parts.size(); ++i) explanation.add_part(static_cast<int>(i), parts[i]);
    explanation.add_left_out(left_out.at_border, "at the border");
    explanation.add_left_out(left_out.too_small, "too small");
    explanation.add_left_out(left_out.too_large, "too large");
    return explanation.finish(reason);
}

}  // namespace fovea::apps
