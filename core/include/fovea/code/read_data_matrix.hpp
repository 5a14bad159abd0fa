// SPDX-License-Identifier: MIT
//
// Data Matrix symbols in an image, at any angle, tilted, mirrored, dark on light or light on dark.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/code_area.hpp>
#include <fovea/code/data_matrix_clarity.hpp>
#include <fovea/code/data_matrix_corners.hpp>
#include <fovea/code/data_matrix_dashes.hpp>
#include <fovea/code/data_matrix_decode.hpp>
#include <fovea/code/data_matrix_frame.hpp>
#include <fovea/code/data_matrix_grade.hpp>
#include <fovea/code/data_matrix_grid.hpp>
#include <fovea/code/data_matrix_lines.hpp>
#include <fovea/code/work_budget.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Which modules are dark.
enum class CodePolarity : std::uint8_t { dark_on_light, light_on_dark, both };

struct ReadDataMatrixOptions {
    /// What is tried on an image in which nothing was read yet: more takes longer where no symbol is.
    enum class Effort : std::uint8_t {
        quick,     ///< the image as it is, and a quarter of the work
        thorough,  ///< and at half and a quarter of its size
    };

    Effort effort = Effort::thorough;
    CodePolarity polarity = CodePolarity::both;
    /// Grey levels between dark and light, 4 to 255. Lower finds paler symbols, and walks along more edges.
    int least_contrast = 24;
    /// Symbols to look for, 1 or more; the search ends with them.
    int most_codes = 255;
};

/// Candidate corners of a part of an image; the heaviest are kept.
inline constexpr int data_matrix_corners = 64;
/// So many of them are tried. Of a thousand symbols that were read in cluttered photos one had another rank.
inline constexpr int data_matrix_tries = 24;
/// Steps along borders and looks between pixels, each a unit of work, for each pixel of an image: at every
/// size in which it is seen, and for each polarity; an eighth more for the corners that the row
/// gives in which it ends. Photos without symbols take most of it.
inline constexpr int data_matrix_work = 4;
inline constexpr int data_matrix_quick_work = 1;

/// Scratch bytes that read_data_matrix() needs.
constexpr std::int64_t read_data_matrix_scratch(Size size) {
    const Size half{size.width / 2, size.height / 2};
    return half.area() + half.area() / 4 + arena_bytes<BitWord>(detail::PassedSides::words(size)) +
           arena_bytes<detail::BorderCorner>(data_matrix_corners) +
           arena_bytes<std::int16_t>(detail::dash_samples) + arena_bytes<detail::DashedLine>(3) +
           2 * minimum<std::int64_t>(max_data_matrix_side * max_data_matrix_side, size.area()) +
           arena_bytes<BitWord>(std::int64_t{max_data_matrix_side} * bit_words(max_data_matrix_side)) +
           data_matrix_decode_scratch;
}

/// Finds and reads the Data Matrix symbols of an image. Their texts are appended to text, and they to codes.
///
/// Shapes   8x8 or larger, modules of 1 px or more
/// Order    as they are found
/// Scratch  read_data_matrix_scratch(image.size()) bytes, undefined afterwards
/// Time     bounded: data_matrix_work units a pixel, for two polarities and three sizes at most 2.7 times as
///          many; what is read with these is told
/// Errors   empty_image; image_too_large above max_image_side; bad_argument; scratch_too_small; not_found,
///          the lists untouched; capacity_exceeded when codes are full before all were read; buffer_too_small
///          when the text is
/// Source   ISO/IEC 16022; grades as far as a gray image allows after ISO/IEC 15415
inline Status read_data_matrix(ImageView<const Gray8> image, const ReadDataMatrixOptions& options,
                               Span<std::uint8_t> scratch, CodeText& text, ListView<Code>& codes);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

class DataMatrixReader {
public:
    DataMatrixReader(ImageView<const Gray8> image, const ReadDataMatrixOptions& options,
                     Span<std::uint8_t> scratch, CodeText& text, ListView<Code>& codes)
        : image_(image),
          options_(options),
          text_(text),
          codes_(codes),
          first_(codes.size()),
          arena_(scratch),
          halves_(arena_.take_unset<std::uint8_t>(image.size().width / 2 *
                                                  std::int64_t{image.size().height / 2} * 5 / 4)),
          passed_words_(arena_.take_unset<BitWord>(PassedSides::words(image.size()))),
          passed_(passed_words_, image.size()),
          corners_(arena_.take<BorderCorner>(data_matrix_corners)),
          samples_(arena_.take_unset<std::int16_t>(dash_samples)),
          dashed_(arena_.take<DashedLine>(3)),
          values_(arena_.take_unset<std::uint8_t>(
              minimum<std::int64_t>(max_data_matrix_side * max_data_matrix_side, image.size().area()))),
          sharpened_(arena_.take_unset<std::uint8_t>(values_.size())),
          words_(arena_.take_unset<BitWord>(std::int64_t{max_data_matrix_side} *
                                            bit_words(max_data_matrix_side))) {}

    Status read() {
        int level = 0;
        while (true) {
            if (options_.polarity != CodePolarity::light_on_dark) read_polarity(false);
            if (options_.polarity != CodePolarity::dark_on_light && !done()) read_polarity(true);
            // Half the size closes the gaps between dots and takes noise away.
            const Size size = image_.size();
            if (codes_.size() > first_ || done() || level == most_halvings) break;
            if (options_.effort == ReadDataMatrixOptions::Effort::quick) break;
            if (minimum(size.width, size.height) < 2 * least_halved_side) break;
            halve();
            ++level;
        }
        for (int i = first_; i < codes_.size(); ++i)
            for (SubPixelPoint& corner : codes_[i].corners)
                for (int k = 0; k < level; ++k)
                    corner = {SubPixel::from_raw(2 * corner.x.raw() + 128),
                              SubPixel::from_raw(2 * corner.y.raw() + 128)};
        if (stop_ != Status::ok) return stop_;
        return codes_.size() > first_ ? Status::ok : Status::not_found;
    }

private:
    static constexpr int most_halvings = 2;
    static constexpr int least_halved_side = 24;
    /// Places with light behind the dark along both sides of a corner, of 30: no symbol has fewer than
    /// fewest_thin, and of a thousand that were read in cluttered photos 18 had fewer than usual_thin.
    static constexpr int fewest_thin = 2;
    static constexpr int usual_thin = 12;
    /// For images of few pixels, in units of work: for a quick look, and for a thorough one.
    static constexpr int least_quick_work = 1 << 16;
    static constexpr int least_work = 1 << 17;

    /// The image becomes means of two by two pixels.
    void halve() {
        const Size size{image_.width() / 2, image_.height() / 2};
        const ImageView<Gray8> half(halves_.data(), size, size.width);
        halves_ = halves_.from(size.area());
        for (int y = 0; y < size.height; ++y) {
            const Gray8* upper = image_.row(2 * y);
            const Gray8* lower = image_.row(2 * y + 1);
            Gray8* to = half.row(y);
            for (int x = 0; x < size.width; ++x)
                to[x] = static_cast<Gray8>(
                    (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1] + 2) >> 2);
        }
        image_ = half;
        passed_ = PassedSides(passed_words_.first(PassedSides::words(size)), size);
    }
    bool ended() const { return done() || budget_.spent(); }
    bool done() const { return stop_ != Status::ok || codes_.size() - first_ >= options_.most_codes; }

    /// Rows in an order that soon meets what is large, and in the end every symbol.
    void read_polarity(bool inverted) {
        field_ = CodeField(image_, inverted);
        const bool quick = options_.effort == ReadDataMatrixOptions::Effort::quick;
        budget_ = quick ? WorkBudget(image_.size(), data_matrix_quick_work, least_quick_work)
                        : WorkBudget(image_.size(), data_matrix_work, least_work);
        // An eighth more for what the row finds in which the work ends.
        const std::int64_t more = budget_.left() / 8;
        passed_.clear();
        const int height = image_.height();
        const int step = clamp(height / 56, 3, 9);
        // First the middle, then halves and quarters, then all.
        for (int parts = 2; parts <= 8 && height / parts >= 2 * step; parts *= 2) {
            for (int i = 1; i < parts; i += 2) {
                scan(height * i / parts);
                const bool last = budget_.spent();
                if (last) budget_.extend(more);
                try_corners();
                if (last || ended()) return;
            }
        }
        int since = 0;
        for (int y = step / 2; y < height; y += step) {
            scan(y);
            const bool last = budget_.spent();
            if (++since < 16 && y + step < height && !last) continue;
            since = 0;
            if (last) budget_.extend(more);
            try_corners();
            if (last || ended()) return;
        }
    }
    /// A row without what lies in symbols that were read.
    void scan(int y) {
        const ListView<BorderCorner> list(corners_.data(), data_matrix_corners, &count_);
        const int width = image_.width();
        for (int x = 0; x < width;) {
            int first = x;
            int end = width;
            // The nearest symbol from here on; those that begin before it push the beginning on.
            for (int i = first_; i < codes_.size(); ++i) {
                const CodeColumns hidden = code_columns(codes_[i], y);
                if (hidden.last < first || hidden.first >= end) continue;
                if (hidden.first <= first) {
                    first = hidden.last + 1;
                    end = width;
                    i = first_ - 1;
                } else {
                    end = hidden.first;
                }
            }
            if (first >= width) return;
            budget_.spend(scan_row_for_corners(field_, y, first, end - 1, options_.least_contrast,
                                               budget_.left(), passed_, list));
            x = end;
        }
    }
    /// Whether a place lies in a symbol that was read.
    bool known(Point p) const {
        for (int i = first_; i < codes_.size(); ++i)
            if (code_covers(codes_[i], p)) return true;
        return false;
    }

    void try_corners() {
        const Span<BorderCorner> found = corners_.first(count_);
        for (BorderCorner& corner : found) {
            const int thin = thin_places(field_, corner.in, corner.threshold, budget_) +
                             thin_places(field_, corner.out, corner.threshold, budget_);
            if (thin < fewest_thin) corner.weight = 0;
            if (thin < usual_thin) corner.weight /= 4;
        }
        sort(found, [](const BorderCorner& a, const BorderCorner& b) { return a.weight > b.weight; });
        int tried = 0;
        for (const BorderCorner& corner : found) {
            if (ended() || tried == data_matrix_tries || corner.weight == 0) break;
            if (known(corner.in.last) || often_tried(corner)) continue;
            try_corner(corner);
            ++tried;
        }
        count_ = 0;
    }
    /// Whether the same corner failed at heavier pieces, from other thresholds, often enough.
    bool often_tried(const BorderCorner& corner) const {
        constexpr int most = 4;
        int tried = 0;
        for (const BorderCorner* other = corners_.begin(); other != &corner; ++other) {
            const int x = other->in.last.x - corner.in.last.x;
            const int y = other->in.last.y - corner.in.last.y;
            tried += x >= -3 && x <= 3 && y >= -3 && y <= 3 ? 1 : 0;
        }
        return tried >= most;
    }
    void try_corner(const BorderCorner& corner) {
        const FrameScratch scratch{{samples_, dashed_[0], budget_}, dashed_[1], dashed_[2]};
        FrameFinder finder(field_, corner, scratch);
        if (finder.find_arms(corner) != Status::ok) return;
        // Blur and dark neighbours make solid lines thicker than a module.
        constexpr int shares[] = {256, 166};
        for (const int share : shares) {
            const Result<DataMatrixFrame> frame = finder.find(share);
            if (frame && try_frame(*frame)) return;
            if (ended()) return;
        }
    }

    /// Reads a frame as it is and, if its borders are about right, moved to where they are clearest.
    bool try_frame(DataMatrixFrame frame) {
        const DataMatrixSize* size = data_matrix_size(frame.rows, frame.columns);
        bool mirrored = false;
        if (size == nullptr) {
            size = data_matrix_size(frame.columns, frame.rows);
            mirrored = size != nullptr;
        }
        // Modules of less than a pixel have no room, and say nothing.
        if (size == nullptr || size->rows * size->columns > values_.size()) return false;
        if (mirrored) {
            const EdgePlace upper = frame.upper;
            frame.upper = frame.right;
            frame.right = upper;
        }
        if (try_grid(frame, *size, mirrored)) return true;
        if (done()) return false;
        if (!make_clearer(field_, *size, frame, budget_)) return false;
        return try_grid(frame, *size, mirrored);
    }
    bool try_grid(const DataMatrixFrame& frame, const DataMatrixSize& size, bool mirrored) {
        const SquareToQuad map = map_of(frame);
        if (!map.there()) return false;
        budget_.spend(5 * std::int64_t{size.rows} * size.columns);
        sample_modules(field_, map, size.rows, size.columns, module_of(frame, size), values_);
        const BorderLevels levels = border_levels(values_, size);
        if (levels.light - levels.dark < options_.least_contrast / 2) return false;
        const BitView<BitWord> modules(words_.data(), {size.columns, size.rows}, bit_words(size.columns));
        for (int rule = 0; rule < module_rules; ++rule) {
            if (rule > 0) budget_.spend(8 * std::int64_t{size.rows} * size.columns);
            classify_modules(values_, size, static_cast<ModuleRule>(rule), sharpened_, modules);
            const BorderErrors errors = border_errors(modules, size);
            if (errors.wrong * 5 > errors.all) {
                if (errors.wrong * 3 > errors.all) return false;
                continue;
            }
            if (try_modules(frame, size, mirrored, modules)) return true;
            if (done()) return false;
            if (size.square()) {
                transpose(modules);
                if (try_modules(frame, size, true, modules)) return true;
                if (done()) return false;
            }
        }
        return false;
    }
    /// About the diagonal through the corner of the solid lines.
    static void transpose(BitView<BitWord> modules) {
        const int last = modules.width() - 1;
        for (int y = 0; y <= last; ++y)
            for (int x = 0; x + y < last; ++x) {
                const bool a = modules(x, y);
                modules.set(x, y, modules(last - y, last - x));
                modules.set(last - y, last - x, a);
            }
    }

    bool try_modules(const DataMatrixFrame& frame, const DataMatrixSize& size, bool mirrored,
                     BitView<const BitWord> modules) {
        const int text_first = text_.size();
        const CodeText before = text_;
        if (text_.begin_segment(TextSegment::not_stated) != Status::ok) {
            stop_ = Status::capacity_exceeded;
            return false;
        }
        budget_.spend(8 * std::int64_t{size.rows} * size.columns);
        const Result<DataMatrixReading> reading = data_matrix_decode(modules, arena_.rest(), text_);
        if (!reading) {
            text_ = before;
            if (reading.status() == Status::buffer_too_small || reading.status() == Status::capacity_exceeded)
                stop_ = reading.status();
            return false;
        }
        Code code;
        code.symbology = Symbology::data_matrix;
        code.aim_digit = reading->message.aim_digit;
        code.text_first = text_first;
        code.text_size = text_.size() - text_first;
        const bool turned = mirrored && size.square();
        const EdgePlace corners[4] = {turned ? frame.right : frame.upper, frame.opposite,
                                      turned ? frame.upper : frame.right, frame.corner};
        for (int i = 0; i < 4; ++i)
            code.corners[i] = {SubPixel::from_raw(corners[i].x), SubPixel::from_raw(corners[i].y)};
        code.corrected_errors = reading->corrected_errors;
        code.inverted = field_.inverted();
        code.mirrored = mirrored;
        code.grade = grade_data_matrix(field_, map_of(frame), size, values_, reading->unused_correction);
        const Status pushed = codes_.push(code);
        if (pushed == Status::ok) return true;
        text_ = before;
        stop_ = pushed;
        return false;
    }

    ImageView<const Gray8> image_;
    ReadDataMatrixOptions options_;
    CodeText& text_;
    ListView<Code>& codes_;
    int first_;
    Arena arena_;
    Span<std::uint8_t> halves_;
    Span<BitWord> passed_words_;
    PassedSides passed_;
    Span<BorderCorner> corners_;
    Span<std::int16_t> samples_;
    Span<DashedLine> dashed_;
    Span<std::uint8_t> values_;
    Span<std::uint8_t> sharpened_;
    Span<BitWord> words_;
    CodeField field_;
    WorkBudget budget_;
    int count_ = 0;
    Status stop_ = Status::ok;
};

}  // namespace detail

inline Status read_data_matrix(ImageView<const Gray8> image, const ReadDataMatrixOptions& options,
                               Span<std::uint8_t> scratch, CodeText& text, ListView<Code>& codes) {
    if (image.empty()) return Status::empty_image;
    if (image.width() > max_image_side || image.height() > max_image_side) return Status::image_too_large;
    if (options.least_contrast < 4 || options.least_contrast > 255 || options.most_codes < 1)
        return Status::bad_argument;
    if (scratch.size() < read_data_matrix_scratch(image.size())) return Status::scratch_too_small;
    return detail::DataMatrixReader(image, options, scratch, text, codes).read();
}

}  // namespace fovea
