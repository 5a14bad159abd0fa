// SPDX-License-Identifier: MIT
//
// The texts that a code may have, as they stand in a file: one on each line.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>

namespace fovea::apps {

/// Lines of bytes that must outlive it. Empty lines are none, and a CR in front of a line's end is not a part
/// of its text.
class AllowedTexts {
public:
    constexpr AllowedTexts() = default;
    explicit constexpr AllowedTexts(Span<const std::uint8_t> file) : file_(file) {}

    constexpr int count() const {
        int count = 0;
        for_each([&](Span<const std::uint8_t>) {
            ++count;
            return false;
        });
        return count;
    }
    constexpr bool contains(Span<const std::uint8_t> text) const {
        return for_each([&](Span<const std::uint8_t> line) {
            if (line.size() != text.size()) return false;
            for (std::ptrdiff_t i = 0; i < line.size(); ++i)
                if (line[i] != text[i]) return false;
            return true;
        });
    }

private:
    /// True as soon as found(line) is.
    template <class Found>
    constexpr bool for_each(Found found) const {
        for (std::ptrdiff_t at = 0; at < file_.size();) {
            std::ptrdiff_t end = at;
            while (end < file_.size() && file_[end] != '\n') ++end;
            std::ptrdiff_t last = end;
            if (last > at && file_[last - 1] == '\r') --last;
            if (last > at && found(file_.from(at).first(last - at))) return true;
            at = end + 1;
        }
        return false;
    }

    Span<const std::uint8_t> file_;
};

}  // namespace fovea::apps
