// SPDX-License-Identifier: MIT
//
// LineReader: lines of text out of a stream of bytes, whatever else arrives there.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/byte_stream.hpp>

namespace fovea::hal {

/// Finds lines that end in CR, LF or both. Bytes from 0x80 on belong to a line as they are (UTF-8); a line
/// with any control byte in it, NUL and the tabulator too, is not read: noise must not become a command.
///
/// Once a turn fill(), then next() until it answers no line: so a flood costs no turn more than so many
/// bytes.
template <int MostBytes = 256, int BytesATurn = 512>
class LineReader {
    static_assert(MostBytes > 0 && BytesATurn > 0, "a line has a byte, and a turn takes one");

public:
    /// Takes what has arrived, at most as much as there is room for: BytesATurn, less what next() has not
    /// seen yet.
    ///
    /// Errors  those of the stream
    template <class Stream>
    Status fill(Stream& stream) {
        static_assert(is_byte_stream_v<Stream>, "lines come from a stream of bytes: hal/byte_stream.hpp");
        for (int i = next_; i < arrived_; ++i) bytes_[i - next_] = bytes_[i];
        arrived_ -= next_;
        next_ = 0;
        if (arrived_ == BytesATurn) return Status::ok;
        const Result<int> got = stream.read({bytes_ + arrived_, BytesATurn - arrived_});
        if (!got) return got.status();
        arrived_ += *got;
        return Status::ok;
    }

    /// The next line without its end, good until the next call; nothing where none is complete. Empty lines
    /// are skipped.
    ///
    /// Errors  once for each line, which is then skipped to its end: capacity_exceeded for more than
    ///         MostBytes, malformed for a control byte
    Result<Span<const char>> next() {
        if (whole_) size_ = 0;
        whole_ = false;
        while (next_ < arrived_) {
            const std::uint8_t byte = bytes_[next_++];
            if (byte == '\r' || byte == '\n') {
                const bool line = !skipping_ && size_ > 0;
                skipping_ = false;
                if (!line) continue;
                whole_ = true;
                return Span<const char>(line_, size_);
            }
            if (skipping_) continue;
            if (byte < 0x20 || byte == 0x7f) return refuse(Status::malformed);
            if (size_ == MostBytes) return refuse(Status::capacity_exceeded);
            line_[size_++] = static_cast<char>(byte);
        }
        return Span<const char>();
    }

    /// Drops all that has arrived: the stream was opened anew.
    void drop() {
        next_ = arrived_ = size_ = 0;
        skipping_ = whole_ = false;
    }

    /// How many lines were not read.
    std::uint32_t refused() const { return refused_; }

private:
    Status refuse(Status why) {
        size_ = 0;
        skipping_ = true;
        ++refused_;
        return why;
    }

    std::uint8_t bytes_[std::size_t{BytesATurn}] = {};
    char line_[std::size_t{MostBytes}] = {};
    int next_ = 0;
    int arrived_ = 0;
    int size_ = 0;
    bool skipping_ = false;
    bool whole_ = false;
    std::uint32_t refused_ = 0;
};

}  // namespace fovea::hal
