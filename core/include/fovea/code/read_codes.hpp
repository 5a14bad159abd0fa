// SPDX-License-Identifier: MIT
//
// All codes of an image, bars and matrices. Book ch. 5.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/read_bars.hpp>
#include <fovea/code/read_blurred_bars.hpp>
#include <fovea/code/read_data_matrix.hpp>
#include <fovea/code/read_qr.hpp>
#include <fovea/code/symbology.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct ReadCodesOptions {
    /// What is looked for. Fewer are faster, and leave less to mistake; rules.symbologies does not count.
    SymbologySet symbologies = SymbologySet::all();
    /// Ends the search, 1 or more.
    int most_codes = 32;
    /// True: what is harder to see is looked for where nothing was read at first sight, which takes several
    /// times as long.
    bool thorough = true;
    /// How bar codes are understood.
    BarRules rules;
};

/// Scratch bytes that read_codes() needs.
constexpr std::int64_t read_codes_scratch(Size size) {
    return maximum(maximum(read_bars_scratch(size), read_blurred_bars_scratch(size)),
                   maximum(read_qr_scratch(size), read_data_matrix_scratch(size)));
}

/// Reads the codes of an image: first what is found fastest, QR, then bars, then Data Matrix; if there are
/// none, again with all means, and bars out of focus before Data Matrix. For one code of a small image whose
/// edges cross, Data Matrix comes before bars.
///
/// Shapes   src 1x1 or larger
/// Time     bounded, as read_qr(), read_data_matrix() and read_bars() are
/// Scratch  read_codes_scratch(src.size()) bytes, undefined afterwards
/// Errors   empty_image; bad_argument for no symbology or no code to look for; scratch_too_small; not_found;
///          undecided where something was read on which lines did not agree; buffer_too_small and
///          capacity_exceeded with the codes that had room. Text and codes are appended to
/// Source   book ch. 5
inline Status read_codes(ImageView<const Gray8> src, const ReadCodesOptions& options,
                         Span<std::uint8_t> scratch, CodeText& text, ListView<Code> codes);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Whether edges of an image of few pixels cross, as those of modules do and those of bars do not: of the
/// eigenvalues of their structure tensor the smaller is more than 1/2.6 of the larger. An eighth of the
/// pixels is looked at.
///
/// Source  Foerstner and Guelch, A Fast Operator for Detection and Precise Location of Distinct Points, 1987
inline bool small_matrix_likely(ImageView<const Gray8> src) {
    constexpr std::int64_t most_pixels = 1 << 15;
    if (src.size().area() > most_pixels) return false;
    // Squares of 255 and 2^12 places and one a row more: below 2^31.
    std::int32_t xx = 0;
    std::int32_t yy = 0;
    std::int32_t xy = 0;
    for (int y = 1; y + 1 < src.height(); ++y) {
        const Gray8* row = src.row(y);
        const Gray8* above = src.row(y - 1);
        const Gray8* below = src.row(y + 1);
        // Rows in turn at all columns, even and odd ones in even and odd rows: no size of modules is in step.
        for (int x = 1 + (3 * y + y / 2) % 8; x + 1 < src.width(); x += 8) {
            const int across = row[x + 1] - row[x - 1];
            const int down = below[x] - above[x];
            xx += across * across;
            yy += down * down;
            xy += across * down;
        }
    }
    const std::int64_t both = std::int64_t{xx} + yy;
    const std::int64_t apart = std::int64_t{xx} - yy;
    return 5 * (apart * apart + 4 * std::int64_t{xy} * xy) < both * both;
}

/// One look at an image for everything that is asked for.
/// bars_seen: an earlier look read no bars on any line.
inline Status look_for_codes(ImageView<const Gray8> src, const ReadCodesOptions& options, bool thorough,
                             bool bars_seen, Span<std::uint8_t> scratch, CodeText& text,
                             ListView<Code> codes) {
    const int before = codes.size();
    const auto left = [&] { return options.most_codes - (codes.size() - before); };
    const auto failed = [](Status status) {
        return status != Status::ok && status != Status::not_found && status != Status::undecided;
    };
    Status doubt = Status::not_found;
    const auto look_for_data_matrix = [&] {
        using Effort = ReadDataMatrixOptions::Effort;
        ReadDataMatrixOptions data_matrix;
        data_matrix.effort = thorough ? Effort::thorough : Effort::quick;
        data_matrix.most_codes = left();
        return read_data_matrix(src, data_matrix, scratch, text, codes);
    };
    if (options.symbologies.contains(Symbology::qr)) {
        ReadQrOptions qr;
        qr.effort = thorough ? ReadQrOptions::Effort::thorough : ReadQrOptions::Effort::quick;
        qr.most_codes = left();
        if (Status s = read_qr(src, qr, scratch, text, codes); failed(s)) return s;
    }
    const SymbologySet bars = options.symbologies & bar_symbologies();
    bool data_matrix = options.symbologies.contains(Symbology::data_matrix);
    // A search for one code ends with it, so that the likely one comes first.
    if (data_matrix && options.most_codes == 1 && !thorough && left() > 0 && small_matrix_likely(src)) {
        if (Status s = look_for_data_matrix(); failed(s)) return s;
        data_matrix = false;
    }
    if (!bars.empty() && left() > 0) {
        ReadBarsOptions rules;
        rules.rules = options.rules;
        rules.rules.symbologies = bars;
        rules.most_codes = left();
        rules.effort = thorough ? 2 : 1;
        doubt = read_bars(src, rules, bars_seen, scratch, text, codes);
        if (failed(doubt)) return doubt;
    }
    // Before what is dearest: no blurred bars were found in a photo of anything else.
    if (thorough && !bars.empty() && codes.size() == before) {
        if (Status s = read_blurred_bars(src, bars, left(), scratch, text, codes); failed(s)) return s;
    }
    if (data_matrix && left() > 0) {
        if (Status s = look_for_data_matrix(); failed(s)) return s;
    }
    return codes.size() > before ? Status::ok : doubt;
}

}  // namespace detail

inline Status read_codes(ImageView<const Gray8> src, const ReadCodesOptions& options,
                         Span<std::uint8_t> scratch, CodeText& text, ListView<Code> codes) {
    if (src.empty()) return Status::empty_image;
    if (options.symbologies.empty() || options.most_codes < 1) return Status::bad_argument;
    if (scratch.size() < read_codes_scratch(src.size())) return Status::scratch_too_small;
    const Status first = detail::look_for_codes(src, options, false, false, scratch, text, codes);
    if (!options.thorough || (first != Status::not_found && first != Status::undecided)) return first;
    return detail::look_for_codes(src, options, true, first == Status::not_found, scratch, text, codes);
}

}  // namespace fovea
