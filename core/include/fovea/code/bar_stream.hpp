// SPDX-License-Identifier: MIT
//
// Bar codes from rows as a camera delivers them, without the image. Book ch. 5.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/bar_line.hpp>
#include <fovea/code/bar_line_reader.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/code.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct BarStreamOptions {
    BarRules rules;
    int row_step = 2;        ///< every so many rows one is read: more leave the chip more time. 1..64
    int agreeing_lines = 2;  ///< as in ReadBarsOptions
};

/// Codes that a stream keeps in mind.
inline constexpr int most_stream_codes = 6;

/// Scratch bytes of a stream of rows: 13 KiB for 640 pixels.
constexpr std::int64_t bar_stream_scratch(int width) {
    return detail::BarLineReader::scratch_bytes(width, most_stream_codes);
}

/// Reads the codes whose bars the rows cross, upside down too, dark on light and light on dark. It takes rows
/// in their order and tells the codes after the last one; agreement of rows is as in read_bars().
class BarStream {
public:
    /// The scratch must outlive the stream. It is started with an error where it does not fit: every call
    /// answers it then.
    ///
    /// Errors  empty_image, image_too_large above max_image_side, bad_argument, scratch_too_small
    BarStream(int width, const BarStreamOptions& options, Span<std::uint8_t> scratch)
        : BarStream(width, options, scratch, check(width, options, scratch)) {}

    /// The next row, of as many pixels as the width. image_too_large after max_image_side rows.
    Status take(Span<const Gray8> row) {
        if (status_ != Status::ok) return status_;
        if (row.size() != width_) return Status::size_mismatch;
        if (y_ >= max_image_side) return Status::image_too_large;
        const int y = y_++;
        if (y % options_.row_step != 0) return Status::ok;
        const Span<std::int16_t> profile = reader_.profile(width_);
        for (int x = 0; x < width_; ++x) {
            profile[x] = static_cast<std::int16_t>(row[x] * (1 << bar_profile_bits));
        }
        const BarLine line = {
            {FinePixel(), FinePixel::from_int(y)}, {FinePixel::from_int(1), FinePixel()}, width_};
        reader_.read(line, 1, {});
        return Status::ok;
    }

    /// Memory that is idle between two calls, 8 bytes for each pixel of the width: where there is little, the
    /// next row may arrive in it. Empty where the stream was started with an error.
    Span<std::uint8_t> idle_scratch() const { return reader_.idle(); }

    /// The codes of the rows since the start, appended to text and list. No row is taken after it.
    ///
    /// Errors  as read_bars()
    Status finish(CodeText& text, ListView<Code> codes) {
        if (status_ != Status::ok) return status_;
        reader_.settle_rest();
        bool doubtful = false;
        for (const BarCandidate& candidate : reader_.candidates()) {
            if (!candidate.settled) {
                doubtful = true;
                continue;
            }
            const Status status = detail::append_code(candidate, detail::code_of(candidate), text, codes);
            if (status != Status::ok) return status;
        }
        if (reader_.settled() > 0) return Status::ok;
        return doubtful ? Status::undecided : Status::not_found;
    }

private:
    static Status check(int width, const BarStreamOptions& options, Span<std::uint8_t> scratch) {
        if (width <= 0) return Status::empty_image;
        if (width > max_image_side) return Status::image_too_large;
        if (!is_valid(options.rules) || options.row_step < 1 || options.row_step > 64 ||
            options.agreeing_lines < 1 || options.agreeing_lines > BarCandidate::most_offsets) {
            return Status::bad_argument;
        }
        return scratch.size() < bar_stream_scratch(width) ? Status::scratch_too_small : Status::ok;
    }
    BarStream(int width, const BarStreamOptions& options, Span<std::uint8_t> scratch, Status status)
        : BarStream(width, options, status, Arena(status == Status::ok ? scratch : Span<std::uint8_t>())) {}
    BarStream(int width, const BarStreamOptions& options, Status status, Arena arena)
        : status_(status),
          width_(width),
          options_(options),
          reader_(options.rules, options.agreeing_lines, arena, status == Status::ok ? width : 0,
                  status == Status::ok ? most_stream_codes : 0) {}

    Status status_;
    int width_;
    int y_ = 0;
    BarStreamOptions options_;
    detail::BarLineReader reader_;
};

}  // namespace fovea
