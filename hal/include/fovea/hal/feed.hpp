// SPDX-License-Identifier: MIT
//
// Feed: the lines of a source into a stream of the core, as they arrive.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/line_source.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea::hal {

/// Begins a frame: starts the stream for the size of the source, then the source.
///
/// Errors  what the stream says to the size and the scratch, with the source as it was; io_error of the
///         source
template <class Source, class Stream>
Status begin_frame(Source& source, Stream& stream, Border border, Span<std::uint8_t> scratch) {
    static_assert(is_line_source_v<Source>, "frames begin at a source of lines: hal/line_source.hpp");
    if (const Status s = stream.start(source.size(), border, scratch); s != Status::ok) return s;
    return source.start();
}

/// Pushes the lines that have arrived into a stream that begin_frame() began. True once the frame is
/// complete; false where its next line has not arrived yet: call again.
///
/// Errors  truncated and io_error of the source, size_mismatch for a line of other bytes than a row of the
///         stream has: begin the next frame then, for of this one no answer may be taken. out_of_range for a
///         stream that never began
template <class Source, class Stream>
Result<bool> pump(Source& source, Stream& stream) {
    static_assert(is_line_source_v<Source>, "lines come from a source of lines: hal/line_source.hpp");
    using Pixel = typename Stream::Input;
    const std::ptrdiff_t row_bytes = source.size().width * static_cast<std::ptrdiff_t>(sizeof(Pixel));
    while (!stream.complete()) {
        const Result<Span<const std::uint8_t>> line = source.next();
        if (!line) return line.status();
        if (line->empty()) return false;
        if (line->size() != row_bytes) return Status::size_mismatch;
        if (const Status s = stream.push(reinterpret_cast<const Pixel*>(line->data())); s != Status::ok)
            return s;
    }
    return true;
}

}  // namespace fovea::hal
