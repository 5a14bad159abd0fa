// SPDX-License-Identifier: MIT
//
// CodeRule: which texts of codes are allowed. Whoever judges codes asks it, on a command line or in a daemon.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/draw/utf8.hpp>

#include <common/text.hpp>
#include <read/code_escape.hpp>

namespace fovea::apps {

/// What texts have in common:
///
///     #  a digit      @  a letter of ASCII      ?  any character      *  any number of them, also none
///
/// Everything else stands for itself. \ stands in front of these four and of itself, and of n r t and xNN.
class CodePattern {
public:
    /// "" if it is a pattern, or what is wrong with it; then it is as it was.
    std::string read(const std::string& text);
    /// Takes no memory, and time of its length times that of the text at most.
    bool fits(Span<const char> text) const;

private:
    enum class Kind : std::uint8_t { byte, digit, letter, character, rest };
    struct Element {
        Kind kind = Kind::byte;
        char byte = '\0';
    };

    /// Bytes in front of a text, which is not empty, that an element stands for; 0 if it does not.
    static int taken(Element element, Span<const char> text);

    std::vector<Element> elements_;
};

class CodeRule {
public:
    void allow(std::string text) { texts_.push_back(std::move(text)); }
    void allow(CodePattern pattern) { patterns_.push_back(std::move(pattern)); }
    /// True where every text is allowed.
    bool empty() const { return texts_.empty() && patterns_.empty(); }
    bool allows(Span<const char> text) const;

private:
    std::vector<std::string> texts_;
    std::vector<CodePattern> patterns_;
};

/// A text as it is told in a line, "a\x1db" or "a\\b", as its bytes. "" if all is well, or what is not.
inline std::string read_code_text(const std::string& line, std::string& text);

// ---- Implementation ---------------------------------------------------------------

inline std::string read_code_text(const std::string& line, std::string& text) {
    text.clear();
    for (std::size_t at = 0; at < line.size();) {
        char letter = line[at++];
        if (letter == '\\' && !take_escape(line, at, "\\", letter))
            return "after \\ comes one of n r t xNN \\";
        text += letter;
    }
    return "";
}

inline std::string CodePattern::read(const std::string& text) {
    std::vector<Element> fresh;
    for (std::size_t at = 0; at < text.size();) {
        Element element{Kind::byte, text[at++]};
        switch (element.byte) {
            case '#': element.kind = Kind::digit; break;
            case '@': element.kind = Kind::letter; break;
            case '?': element.kind = Kind::character; break;
            case '*': element.kind = Kind::rest; break;
            case '\\':
                if (!take_escape(text, at, "\\#@?*", element.byte))
                    return "after \\ comes one of n r t xNN \\ # @ ? *";
                break;
            default: break;
        }
        fresh.push_back(element);
    }
    elements_ = std::move(fresh);
    return "";
}

inline int CodePattern::taken(Element element, Span<const char> text) {
    const char c = text[0];
    switch (element.kind) {
        case Kind::byte: return c == element.byte ? 1 : 0;
        case Kind::digit: return c >= '0' && c <= '9' ? 1 : 0;
        case Kind::letter: return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ? 1 : 0;
        case Kind::character: return first_code_point(text).bytes;
        case Kind::rest: break;
    }
    return 0;
}

inline bool CodePattern::fits(Span<const char> text) const {
    std::ptrdiff_t at = 0;
    std::size_t next = 0;
    // Where the last * stands, and where what it is for ends so far. Of an earlier one the shortest will do.
    std::size_t rest = elements_.size();
    std::ptrdiff_t rest_ends = 0;
    while (at < text.size()) {
        if (next < elements_.size() && elements_[next].kind == Kind::rest) {
            rest = next++;
            rest_ends = at;
            continue;
        }
        const int bytes = next < elements_.size() ? taken(elements_[next], text.from(at)) : 0;
        if (bytes > 0) {
            at += bytes;
            ++next;
            continue;
        }
        if (rest == elements_.size()) return false;
        at = rest_ends += first_code_point(text.from(rest_ends)).bytes;
        next = rest + 1;
    }
    while (next < elements_.size() && elements_[next].kind == Kind::rest) ++next;
    return next == elements_.size();
}

inline bool CodeRule::allows(Span<const char> text) const {
    const auto is_text = [&](const std::string& allowed) {
        return std::equal(text.begin(), text.end(), allowed.begin(), allowed.end());
    };
    return empty() || std::any_of(texts_.begin(), texts_.end(), is_text) ||
           std::any_of(patterns_.begin(), patterns_.end(),
                       [&](const CodePattern& pattern) { return pattern.fits(text); });
}

}  // namespace fovea::apps
