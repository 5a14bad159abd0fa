// SPDX-License-Identifier: MIT
//
// A strict reader of JSON (RFC 8259) that keeps the order of keys: what a machine would make of what the tool
// prints. Host tests only.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/draw/utf8.hpp>

namespace fovea::test {

struct Json {
    enum class Kind { null, boolean, number, string, array, object };

    Kind kind = Kind::null;
    std::string
        text;  ///< of a number as it stands, of a string without quotes and escapes, "true" or "false"
    std::vector<Json> items;        ///< of an array; of an object its values
    std::vector<std::string> keys;  ///< of an object, in order

    /// The value of a key; null if there is none.
    const Json& operator[](const std::string& key) const {
        static const Json none;
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (keys[i] == key) return items[i];
        return none;
    }
    double number() const { return std::stod(text); }
};

namespace detail {

class JsonReader {
public:
    explicit JsonReader(const std::string& text) : text_(text) {}

    std::optional<Json> whole() {
        Json json;
        if (!value(json, 0)) return {};
        blanks();
        if (at_ != text_.size()) return {};
        return json;
    }

private:
    bool is(char c) const { return at_ < text_.size() && text_[at_] == c; }
    bool take(char c) {
        if (!is(c)) return false;
        ++at_;
        return true;
    }
    bool take(const std::string& word) {
        if (text_.compare(at_, word.size(), word) != 0) return false;
        at_ += word.size();
        return true;
    }
    void blanks() {
        while (is(' ') || is('\t') || is('\n') || is('\r')) ++at_;
    }
    bool digits() {
        const std::size_t start = at_;
        while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9') ++at_;
        return at_ > start;
    }

    bool value(Json& json, int depth) {
        if (depth > 32) return false;
        blanks();
        if (is('{')) return object(json, depth);
        if (is('[')) return array(json, depth);
        if (is('"')) {
            json.kind = Json::Kind::string;
            return string(json.text);
        }
        if (take("null")) return true;
        for (const char* word : {"true", "false"})
            if (take(word)) {
                json.kind = Json::Kind::boolean;
                json.text = word;
                return true;
            }
        return number(json);
    }
    bool object(Json& json, int depth) {
        json.kind = Json::Kind::object;
        take('{');
        blanks();
        if (take('}')) return true;
        do {
            blanks();
            std::string key;
            if (!string(key)) return false;
            for (const std::string& before : json.keys)
                if (before == key) return false;
            blanks();
            if (!take(':')) return false;
            json.keys.push_back(key);
            json.items.emplace_back();
            if (!value(json.items.back(), depth + 1)) return false;
            blanks();
        } while (take(','));
        return take('}');
    }
    bool array(Json& json, int depth) {
        json.kind = Json::Kind::array;
        take('[');
        blanks();
        if (take(']')) return true;
        do {
            json.items.emplace_back();
            if (!value(json.items.back(), depth + 1)) return false;
            blanks();
        } while (take(','));
        return take(']');
    }
    bool number(Json& json) {
        json.kind = Json::Kind::number;
        const std::size_t start = at_;
        take('-');
        if (!take('0') && !digits()) return false;
        if (take('.') && !digits()) return false;
        if (take('e') || take('E')) {
            if (!take('+')) take('-');
            if (!digits()) return false;
        }
        json.text = text_.substr(start, at_ - start);
        return true;
    }
    bool hex(std::uint32_t& value) {
        value = 0;
        for (int i = 0; i < 4; ++i, ++at_) {
            if (at_ >= text_.size()) return false;
            const char c = text_[at_];
            const int digit = c >= '0' && c <= '9'   ? c - '0'
                              : c >= 'a' && c <= 'f' ? c - 'a' + 10
                              : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                     : -1;
            if (digit < 0) return false;
            value = value * 16 + static_cast<std::uint32_t>(digit);
        }
        return true;
    }
    static void put_utf8(std::uint32_t code, std::string& out) {
        if (code < 0x80) {
            out += static_cast<char>(code);
            return;
        }
        const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
        const std::uint32_t lead = more == 1 ? 0xc0 : more == 2 ? 0xe0 : 0xf0;
        out += static_cast<char>(lead | code >> (6 * more));
        for (int i = more - 1; i >= 0; --i) out += static_cast<char>(0x80 | (code >> (6 * i) & 0x3f));
    }
    bool escape(std::string& out) {
        if (at_ >= text_.size()) return false;
        const char c = text_[at_++];
        const std::string plain = "\"\\/bfnrt";
        const std::size_t place = plain.find(c);
        if (place != std::string::npos) {
            out += "\"\\/\b\f\n\r\t"[place];
            return true;
        }
        std::uint32_t code = 0;
        if (c != 'u' || !hex(code) || (code >= 0xdc00 && code <= 0xdfff)) return false;
        if (code >= 0xd800 && code <= 0xdbff) {
            std::uint32_t low = 0;
            if (!take("\\u") || !hex(low) || low < 0xdc00 || low > 0xdfff) return false;
            code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
        }
        put_utf8(code, out);
        return true;
    }
    bool string(std::string& out) {
        if (!take('"')) return false;
        while (at_ < text_.size() && !is('"')) {
            if (static_cast<unsigned char>(text_[at_]) < 0x20) return false;
            if (take('\\')) {
                if (!escape(out)) return false;
                continue;
            }
            const Span<const char> rest(text_.data() + at_, static_cast<std::ptrdiff_t>(text_.size() - at_));
            const CodePoint read = first_code_point(rest);
            if (read.value == replacement_character && read.bytes < 3) return false;
            if (read.value == replacement_character && text_.compare(at_, 3, "\xef\xbf\xbd") != 0)
                return false;
            out.append(text_, at_, static_cast<std::size_t>(read.bytes));
            at_ += static_cast<std::size_t>(read.bytes);
        }
        return take('"');
    }

    const std::string& text_;
    std::size_t at_ = 0;
};

}  // namespace detail

/// The value that a text is; nothing if it is no JSON: also for a key that comes twice and for bad UTF-8.
inline std::optional<Json> parse_json(const std::string& text) { return detail::JsonReader(text).whole(); }

}  // namespace fovea::test
