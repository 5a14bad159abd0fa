// SPDX-License-Identifier: MIT
//
// Code: what is told of a bar or matrix code that was read.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/symbology.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Where the bytes of a text begin to mean something else: an assignment number of Extended Channel
/// Interpretations (AIM ITS/04-023): 3 is ISO/IEC 8859-1, 20 Shift JIS, 26 UTF-8, 899 plain bytes.
struct TextSegment {
    static constexpr int not_stated = -1;

    int first = 0;  ///< its first byte
    int eci = not_stated;
};
inline constexpr int most_text_segments = 16;

/// What a decoder writes: bytes into the caller's memory, and what they mean.
class CodeText {
public:
    explicit constexpr CodeText(Span<std::uint8_t> room) : room_(room) {}

    constexpr int size() const { return size_; }
    constexpr Span<const std::uint8_t> bytes() const { return {room_.data(), size_}; }
    /// The segments in their order; bytes before the first one have no meaning stated.
    constexpr Span<const TextSegment> segments() const { return segments_.span(); }
    constexpr void clear() { shrink(0); }
    /// Keeps the first size bytes and the segments that begin in them.
    constexpr void shrink(int size) {
        FOVEA_ASSERT(size >= 0 && size <= size_);
        size_ = size;
        while (!segments_.empty() && segments_[segments_.size() - 1].first >= size) {
            segments_.view().shrink(segments_.size() - 1);
        }
    }
    /// buffer_too_small when the room is full.
    constexpr Status push(std::uint8_t byte) {
        if (size_ >= room_.size()) return Status::buffer_too_small;
        room_[size_++] = byte;
        return Status::ok;
    }
    /// What is pushed from here on is of that interpretation. capacity_exceeded after most_text_segments.
    constexpr Status begin_segment(int eci) {
        const int last = segments_.size() - 1;
        if (last >= 0 && segments_[last].eci == eci) return Status::ok;
        if (last < 0 && eci == TextSegment::not_stated) return Status::ok;
        if (last >= 0 && segments_[last].first == size_) {
            segments_[last].eci = eci;
            return Status::ok;
        }
        return segments_.push({size_, eci});
    }

private:
    Span<std::uint8_t> room_;
    int size_ = 0;
    List<TextSegment, most_text_segments> segments_;
};

/// How well a code is printed and seen: grades 4 (A, the best) to 0 (F), not_graded where it says nothing of
/// that symbology. What a gray image allows of ISO/IEC 15416 (bars) and ISO/IEC 15415 (matrices); as the
/// camera is no verifier, they compare codes of one setup and certify none.
struct CodeGrade {
    static constexpr std::int8_t not_graded = -1;

    std::int8_t overall = not_graded;  ///< the worst of the others
    std::int8_t symbol_contrast = not_graded;
    std::int8_t modulation = not_graded;
    std::int8_t decodability = not_graded;  ///< bars only
    std::int8_t quiet_zone = not_graded;
    std::int8_t unused_error_correction = not_graded;  ///< matrices only
};

/// A code that was read.
struct Code {
    Symbology symbology = Symbology::ean_13;
    char aim_digit = '0';  ///< the last sign of its identifier, "]E0": what was done with its contents
    int text_first = 0;    ///< where its text begins in the text that all codes of an image share
    int text_size = 0;     ///< bytes
    /// Its corners in the image: where reading begins at the top, then clockwise as one reads it. Of bars the
    /// ends of those that were seen.
    SubPixelPoint corners[4];
    int agreeing_lines = 0;    ///< bars: scan lines that read the same
    int corrected_errors = 0;  ///< matrices: codewords that error correction mended
    bool inverted = false;     ///< light on dark
    bool mirrored = false;     ///< seen from behind
    CodeGrade grade;
};

}  // namespace fovea
