// SPDX-License-Identifier: MIT
//
// Any bytes as a TOML file: the reader ends, what it answers lies within the bytes, and a file that it
// accepts gives the same items again when it is written from them.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/codec/toml.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

bool within(Span<const char> part, Span<const char> whole) {
    return part.empty() || (part.begin() >= whole.begin() && part.end() <= whole.end());
}
std::string string_of(Span<const char> text) { return {text.data(), static_cast<std::size_t>(text.size())}; }

std::string written(const TomlValue& value, Span<const char> whole) {
    require(within(value.text, whole));
    require(value.place.line >= 1 && value.place.column >= 1);
    const std::string text = string_of(value.text);
    switch (value.type) {
        case TomlType::string: {
            // The resolved form is never longer, and one byte less than it is too little.
            std::vector<char> buffer(text.size());
            const Span<char> room(buffer.data(), static_cast<std::ptrdiff_t>(buffer.size()));
            const Result<int> length = toml_string(value, room);
            require(length.ok() && *length <= room.size());
            if (*length > 0)
                require(toml_string(value, room.first(*length - 1)).status() == Status::buffer_too_small);
            return "\"" + text + "\"";
        }
        case TomlType::integer: require(value.number.millionths % 1000000 == 0); return text;
        case TomlType::decimal: return text;
        case TomlType::boolean: require(text == (value.truth ? "true" : "false")); return text;
        case TomlType::array: break;
    }
    std::string array = "[";
    TomlArrayReader elements(value);
    std::ptrdiff_t count = 0;
    for (Result<TomlValue> element = elements.next(); element; element = elements.next()) {
        require(element->type != TomlType::array);
        require(++count <= value.text.size());
        array += written(*element, whole) + ", ";
    }
    return array + "]";
}

/// All items in a form of one line each; "" if the file is refused.
std::string rewritten(Span<const char> text) {
    TomlReader reader(text);
    std::string items = "#\n";
    for (std::ptrdiff_t count = 0;; ++count) {
        require(count <= text.size());
        const Result<TomlItem> item = reader.next();
        if (!item) {
            require(item.status() == Status::malformed || item.status() == Status::out_of_range);
            require(reader.problem()[0] != '\0' && reader.place().line >= 1 && reader.place().column >= 1);
            return "";
        }
        require(reader.problem()[0] == '\0' && within(item->name, text));
        const std::string name = string_of(item->name);
        switch (item->kind) {
            case TomlKind::end: return items;
            case TomlKind::table: items += "[" + name + "]\n"; break;
            case TomlKind::array_table: items += "[[" + name + "]]\n"; break;
            case TomlKind::pair: items += name + " = " + written(item->value, text) + "\n"; break;
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // On the heap without a byte behind it.
    const std::vector<char> exact(data, data + size);
    const std::string once = rewritten({exact.data(), static_cast<std::ptrdiff_t>(exact.size())});
    const std::string twice = rewritten({once.data(), static_cast<std::ptrdiff_t>(once.size())});
    require(once == twice || once.empty());
    return 0;
}
