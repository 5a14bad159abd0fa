// SPDX-License-Identifier: MIT
//
// QR codes found in an image and read.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/finder_patterns.hpp>
#include <fovea/code/finder_triples.hpp>
#include <fovea/code/local_threshold.hpp>
#include <fovea/code/qr_decode.hpp>
#include <fovea/code/qr_grade.hpp>
#include <fovea/code/qr_locate.hpp>
#include <fovea/code/qr_sample.hpp>
#include <fovea/code/work_budget.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/bits.hpp>
#include <fovea/segment/adaptive_threshold.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/warp/halve_row.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct ReadQrOptions {
    /// What is tried on an image in which nothing was read yet: more takes longer where no code is.
    enum class Effort : std::uint8_t {
        quick,     ///< one threshold
        several,   ///< the thresholds that need little scratch
        thorough,  ///< one that brings out blurred rings too, and the image at half its size
    };

    Effort effort = Effort::thorough;
    int most_codes = 16;                   ///< 1 or more: looks for no more
    int largest_version = max_qr_version;  ///< 1..40: larger symbols are not read; fewer need less scratch
};

/// Looks at modules for each pixel of an image, a unit of work each, at all thresholds together, and 2
/// million for a small one. Photos of 640x480 take 2 at most.
inline constexpr int qr_work = 12;

/// Scratch bytes that read_qr() needs: less where effort and versions are limited.
constexpr std::int64_t read_qr_scratch(Size size, const ReadQrOptions& options = {});

/// Reads the QR codes of an image, in any direction, in perspective, dark on light or light on dark, mirrored
/// or not. Their texts are appended to text and they to codes, those of the clearest finders first.
///
/// Shapes   src 1x1 or larger; modules of a pixel and more
/// Time     bounded by the pixels, for each threshold by 24 finder patterns and 16 tries of three of them,
///          and by qr_work; what is read with it is told
/// Scratch  read_qr_scratch(src.size(), options) bytes, undefined afterwards
/// Errors   empty_image; bad_argument; scratch_too_small; not_found; buffer_too_small where a text that was
///          read does not fit; capacity_exceeded where the list is full, with what it holds
/// Source   finder patterns as ISO/IEC 18004, clause 12 b), tells; then the plane through their centres and
///          the meeting of their outer edges or the alignment pattern, moved until the patterns that are
///          known fit best
inline Status read_qr(ImageView<const Gray8> src, const ReadQrOptions& options, Span<std::uint8_t> scratch,
                      CodeText& text, ListView<Code> codes);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

class QrReader {
public:
    /// The largest symbol that is read: one of which an image shows every module.
    static constexpr int most_modules(Size size, const ReadQrOptions& options) {
        return clamp(minimum(size.width, size.height) + 4, qr_size(min_qr_version),
                     qr_size(options.largest_version));
    }
    static constexpr bool is_thorough(const ReadQrOptions& options) {
        return options.effort == ReadQrOptions::Effort::thorough;
    }
    static constexpr std::int64_t threshold_scratch(Size size, const ReadQrOptions& options) {
        const std::int64_t narrow = arena_bytes<std::uint8_t>(adaptive_threshold_scratch(size, narrow_side)) +
                                    arena_bytes<Gray8>(std::int64_t{size.width} * band_rows);
        return maximum(maximum(local_threshold_scratch(size, finest_block), arena_bytes<Histogram>(1)),
                       is_thorough(options) ? narrow : 0);
    }
    static constexpr std::int64_t decode_scratch(int modules) {
        return qr_decode_scratch((modules - 17) / 4);
    }
    /// Of what comes behind the threshold.
    static constexpr std::int64_t reading_scratch(int modules) {
        const std::int64_t most = modules;
        return arena_bytes<FinderPattern>(max_finder_patterns) +
               arena_bytes<BitWord>(std::int64_t{bit_words(modules)} * most) +
               arena_bytes<std::int16_t>(most * most) + arena_bytes<std::uint8_t>(decode_scratch(modules));
    }
    static constexpr std::int64_t shared_scratch(Size size, const ReadQrOptions& options) {
        return maximum(threshold_scratch(size, options), reading_scratch(most_modules(size, options)));
    }
    static constexpr std::int64_t half_scratch(Size size, const ReadQrOptions& options) {
        return is_thorough(options) ? Size{size.width / 2, size.height / 2}.area() : 0;
    }
    static constexpr std::int64_t scratch(Size size, const ReadQrOptions& options) {
        return arena_bytes<BitWord>(std::int64_t{bit_words(size.width)} * size.height) +
               arena_bytes<Gray8>(half_scratch(size, options)) +
               arena_bytes<std::uint8_t>(shared_scratch(size, options));
    }

    QrReader(ImageView<const Gray8> src, const ReadQrOptions& options, Span<std::uint8_t> scratch,
             CodeText& text, ListView<Code> codes)
        : full_(src),
          options_(options),
          text_(text),
          codes_(codes),
          first_(codes.size()),
          most_(most_modules(src.size(), options)) {
        const Size size = src.size();
        Arena arena(scratch);
        bit_room_ = arena.take_unset<BitWord>(std::int64_t{bit_words(size.width)} * size.height);
        half_room_ = arena.take_unset<Gray8>(half_scratch(size, options));
        // When the image is black and white, the memory of its threshold serves what is found in it.
        threshold_room_ = arena.take_unset<std::uint8_t>(shared_scratch(size, options));
        Arena shared(threshold_room_);
        pattern_room_ = shared.take_unset<FinderPattern>(max_finder_patterns);
        module_room_ = shared.take_unset<BitWord>(std::int64_t{bit_words(most_)} * most_);
        gray_room_ = shared.take_unset<std::int16_t>(std::int64_t{most_} * most_);
        decode_room_ = shared.take_unset<std::uint8_t>(decode_scratch(most_));
    }

    Status read() {
        budget_ = WorkBudget(full_.size(), qr_work, least_work);
        const bool tiny = full_.width() < tiny_side || full_.height() < tiny_side;
        if (pass(full_, tiny ? Threshold::global : Threshold::fine)) return result();
        if (options_.effort == ReadQrOptions::Effort::quick) return result();
        if (pass(full_, tiny ? Threshold::fine : Threshold::global)) return result();
        if (pass(full_, Threshold::coarse)) return result();
        if (!is_thorough(options_)) return result();
        if (pass(full_, Threshold::narrow)) return result();
        if (full_.width() >= 2 * tiny_side && full_.height() >= 2 * tiny_side) {
            halve();
            if (pass(half_, Threshold::fine)) return result();
            if (pass(half_, Threshold::global)) return result();
            static_cast<void>(pass(half_, Threshold::narrow));
        }
        return result();
    }

private:
    enum class Threshold : std::uint8_t { fine, global, coarse, narrow };

    Status result() const {
        if (status_ != Status::ok) return status_;
        return codes_.size() > first_ ? Status::ok : Status::not_found;
    }
    /// True where reading ends: something was read, or does not fit.
    bool pass(ImageView<const Gray8> image, Threshold threshold) {
        image_ = image;
        bits_ = BitView<BitWord>(bit_room_.data(), image.size(), bit_words(image.width()));
        if (!binarize(threshold)) return false;
        int pattern_count = 0;
        const ListView<FinderPattern> patterns(pattern_room_.data(), max_finder_patterns, &pattern_count);
        // Gone before triples are tried, which need the stack.
        FinderSearch(bits_, patterns).rows(image.height() > tall ? 1 : 0, image.height() > tall ? 2 : 1);
        FinderTriples triples(patterns);
        for (int i = 0; i < triples.size() && status_ == Status::ok && !enough() && !budget_.spent(); ++i) {
            if (triples.usable(i) && try_triple(triples.corner(i), triples.right(i), triples.below(i)))
                triples.use(i);
        }
        return codes_.size() > first_ || status_ != Status::ok;
    }
    bool enough() const { return codes_.size() - first_ >= options_.most_codes; }
    bool binarize(Threshold threshold) {
        if (threshold == Threshold::global) {
            Arena arena(threshold_room_);
            Histogram& histogram = arena.take<Histogram>(1)[0];
            for (int y = 0; y < image_.height(); ++y) histogram.add_row(image_.row(y), image_.width());
            const Result<Gray8> level = otsu(histogram);
            if (!level) return false;
            if (pack_bits(image_, *level, bits_) != Status::ok) return false;
            return invert(bits_, bits_) == Status::ok;
        }
        if (threshold == Threshold::narrow) return narrow_means();
        LocalThresholdOptions options;
        if (threshold == Threshold::coarse) options.block = 24;
        return local_threshold(image_, options, threshold_room_, bits_) == Status::ok;
    }
    /// Against the mean of a window that is about as wide as the finder pattern of a small symbol: brings out
    /// the rings that a blur has filled. In bands, so that the bytes of a whole image are not needed.
    bool narrow_means() {
        const int width = image_.width();
        const int height = image_.height();
        Arena arena(threshold_room_);
        const Span<std::uint8_t> room =
            arena.take_unset<std::uint8_t>(adaptive_threshold_scratch(image_.size(), narrow_side));
        const Span<Gray8> pixels = arena.take_unset<Gray8>(std::int64_t{width} * band_rows);
        for (int y = 0; y < height; y += band_rows - 2 * narrow_reach) {
            const int top = maximum(y - narrow_reach, 0);
            const int bottom = minimum(y + band_rows - narrow_reach, height);
            const ImageView<const Gray8> rows(image_.row(top), {width, bottom - top}, image_.stride_bytes());
            const ImageView<Gray8> marks(pixels.data(), rows.size(), width);
            if (adaptive_threshold_inverse(rows, narrow_side, 1, room, marks) != Status::ok) return false;
            const int end = minimum(bottom == height ? height : bottom - narrow_reach, height);
            const ImageView<const Gray8> own(marks.row(y - top), {width, end - y}, width);
            if (pack_bits(own, BitView<BitWord>(bits_.row(y), own.size(), bits_.stride_words())) !=
                Status::ok)
                return false;
            if (end == height) break;
        }
        return true;
    }
    void halve() {
        const Size size{full_.width() / 2, full_.height() / 2};
        const ImageView<Gray8> half(half_room_.data(), size, size.width);
        for (int y = 0; y < size.height; ++y)
            kernels::halve_row(full_.row(2 * y), full_.row(2 * y + 1), size.width, half.row(y));
        half_ = half;
    }
    bool try_triple(const FinderPattern& corner, const FinderPattern& right, const FinderPattern& below) {
        const FinderImage image{bits_, corner.inverted};
        QrLocator locator(image);
        budget_.spend(QrLocator::begin_work);
        if (!locator.begin(corner, right, below)) return false;
        for (int i = 0; i < locator.sizes() && !budget_.spent(); ++i) {
            const int size = locator.size(i);
            if (size > most_) continue;
            budget_.spend(plane_work + 4 * fit_work(size));
            const int planes = locator.find_planes(size);
            if (planes == 0 || locator.fit(0) < least_fit) continue;
            for (int k = 0; k < planes && locator.fit(k) >= least_fit; ++k) {
                if (try_plane(locator, image, size, locator.plane(k), false)) return true;
            }
            if (budget_.spent()) return false;
            budget_.spend(refine_work * fit_work(size));
            ModulePlane plane = locator.plane(0);
            const int fit = locator.refine(size, plane);
            if (fit < refined_fit) continue;
            if (try_plane(locator, image, size, plane, true)) return true;
            if (fit < settled_fit) continue;
            if (budget_.spent()) return false;
            locator.settle(size, plane, budget_);
            if (try_plane(locator, image, size, plane, true)) return true;
        }
        return false;
    }
    bool try_plane(const QrLocator& locator, const FinderImage& image, int size, const ModulePlane& plane,
                   bool gray) {
        // Sampled and decoded once, and with levels thrice more, in windows of 81 of them.
        budget_.spend(std::int64_t{size} * size * (gray ? 70 : 6));
        QrGrid grid;
        locator.find_grid(size, plane, grid);
        if (!grid_inside(grid, size, image_.size())) return false;
        const BitView<BitWord> modules(module_room_.data(), {size, size}, bit_words(size));
        sample_bits(image, grid, modules);
        if (decode(modules, grid, image.inverted)) return true;
        if (!gray) return false;
        GrayModules levels(gray_room_, most_);
        levels.sample(image_, grid, size);
        for (const int sharpen : {0, 8, 16}) {
            levels.decide(sharpen, image.inverted, modules);
            if (decode(modules, grid, image.inverted)) return true;
        }
        return false;
    }
    bool decode(BitView<const BitWord> modules, const QrGrid& grid, bool inverted) {
        const int first = text_.size();
        const Result<QrSymbol> symbol = qr_decode(modules, decode_room_, text_);
        if (symbol.status() == Status::buffer_too_small) status_ = symbol.status();
        if (!symbol) return status_ != Status::ok;
        if (text_.size() == first) return true;  // an empty symbol says nothing
        Code code;
        code.symbology = Symbology::qr;
        code.aim_digit = symbol->aim_digit;
        code.text_first = first;
        code.text_size = text_.size() - first;
        code.corrected_errors = symbol->corrected_errors;
        code.inverted = inverted;
        code.mirrored = symbol->mirrored;
        const int size = modules.width();
        const ModulePoint corners[4] = {module_corner(0, 0), module_corner(size, 0),
                                        module_corner(size, size), module_corner(0, size)};
        for (int i = 0; i < 4; ++i) {
            // A mirrored symbol is read down where others are read across.
            code.corners[symbol->mirrored ? (4 - i) % 4 : i] = corner_of(grid.plane(corners[i]));
        }
        GrayModules levels(gray_room_, most_);
        levels.sample(image_, grid, size);
        code.grade = QrGrader(image_, grid.plane, levels, *symbol, inverted).grade(decode_room_);
        status_ = codes_.push(code);
        if (status_ != Status::ok) text_.shrink(first);
        return true;
    }
    /// At half the size pixel x lies between 2x and 2x + 1.
    SubPixelPoint corner_of(ModulePoint place) const {
        if (image_.width() != full_.width()) place = place * 2 + ModulePoint{128, 128};
        return {SubPixel::from_raw(saturate_cast<std::int32_t>(place.x)),
                SubPixel::from_raw(saturate_cast<std::int32_t>(place.y))};
    }

    /// Looks of QrLocator::fit().
    static constexpr int fit_work(int size) { return 172 + 2 * size; }

    static constexpr int least_work = 1 << 21;
    static constexpr int plane_work =
        8192;  ///< of QrLocator::find_planes(), most of it for the alignment pattern
    static constexpr int refine_work = 80;  ///< times that QrLocator::refine() fits
    static constexpr int tiny_side = 64;
    static constexpr int tall = 120;  ///< px, from which on every other row is looked at
    static constexpr int finest_block = 8;
    static constexpr int narrow_side = 15;
    static constexpr int narrow_reach = narrow_side / 2;
    static constexpr int band_rows = 64;
    static constexpr int least_fit = 650;
    static constexpr int refined_fit = 750;
    static constexpr int settled_fit = 850;

    ImageView<const Gray8> full_;
    ReadQrOptions options_;
    CodeText& text_;
    ListView<Code> codes_;
    int first_;
    int most_;
    Span<BitWord> bit_room_;
    Span<std::uint8_t> threshold_room_;
    Span<Gray8> half_room_;
    Span<FinderPattern> pattern_room_;
    Span<BitWord> module_room_;
    Span<std::int16_t> gray_room_;
    Span<std::uint8_t> decode_room_;
    ImageView<const Gray8> half_;
    ImageView<const Gray8> image_;
    BitView<BitWord> bits_;
    WorkBudget budget_;
    Status status_ = Status::ok;
};

}  // namespace detail

constexpr std::int64_t read_qr_scratch(Size size, const ReadQrOptions& options) {
    return detail::QrReader::scratch(size, options);
}

inline Status read_qr(ImageView<const Gray8> src, const ReadQrOptions& options, Span<std::uint8_t> scratch,
                      CodeText& text, ListView<Code> codes) {
    if (src.empty()) return Status::empty_image;
    if (options.most_codes < 1 || options.largest_version < min_qr_version ||
        options.largest_version > max_qr_version)
        return Status::bad_argument;
    if (scratch.size() < read_qr_scratch(src.size(), options)) return Status::scratch_too_small;
    return detail::QrReader(src, options, scratch, text, codes).read();
}

}  // namespace fovea
