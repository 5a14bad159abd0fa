// SPDX-License-Identifier: MIT
//
// CodeJob: which codes a picture must have, as the table [codes] of a job says.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/code/read_codes.hpp>
#include <fovea/codec/toml.hpp>
#include <fovea/image/geometry.hpp>

#include <read/code_rule.hpp>

namespace fovea::apps {

struct CodeJob {
    /// Codes that can be expected of a picture.
    static constexpr int most_codes = 8;
    /// Codes that a picture may have where others are ignored.
    static constexpr int most_seen = 32;

    CodeJob() { options.thorough = false; }

    /// What is looked for and how; its most_codes is set by those that are expected.
    ReadCodesOptions options;
    int count = 1;
    bool ignores_others = false;
    CodeRule allowed;
    /// Allowed is what was taught, and nothing until then.
    bool taught = false;
    /// No text may stand in a picture twice.
    bool distinct = false;
    bool unlike_last = false;
    /// 0 (F, any) to 4 (A).
    int least_grade = 0;
    /// Part of the picture; empty for all of it.
    Rectangle region;
    TextPlace region_place;

    /// The size of what is looked at in a picture.
    /// Of a picture of that size; empty where its region leaves it.
    Size looked_at(Size picture) const {
        return region.empty() ? picture : inside(picture) ? region.size() : Size{};
    }
    bool inside(Size picture) const {
        return region.empty() ||
               (region.width <= picture.width - region.x && region.height <= picture.height - region.y);
    }
};

enum class CodeKeyType : std::uint8_t { truth, whole, choice, texts, wholes };

/// A key of [codes].
struct CodeKey {
    const char* name;
    CodeKeyType type;
    /// As it stands in a job; "" if it must be given, "[]" for none.
    const char* otherwise;
    const char* text;
    /// Of numbers; of arrays how many elements they have, each from 0 on.
    int low = 0;
    int high = 0;
    /// Of a choice: "wrong|ignored".
    const char* choices = "";
};

inline Span<const CodeKey> code_keys() {
    static constexpr CodeKey keys[] = {
        {"symbologies", CodeKeyType::texts, "",
         "what is looked for, as [\"ean-13\", \"qr\"]; also \"bars\", \"matrices\", \"retail\" and \"all\"",
         1, 16},
        {"count", CodeKeyType::whole, "1", "how many codes are expected", 1, CodeJob::most_codes},
        {"distinct", CodeKeyType::truth, "false",
         "no two codes of a picture may have the same text; wants a count of 2 or more"},
        {"others", CodeKeyType::choice, "\"wrong\"", "what codes that are not allowed are", 0, 0,
         "wrong|ignored"},
        {"allowed", CodeKeyType::texts, "[]", "texts that are allowed; with no patterns either, all are", 0,
         256},
        {"patterns", CodeKeyType::texts, "[]",
         "patterns of texts that are allowed: # is a digit, @ a letter, ? any character, * any number of "
         "them",
         0, 256},
        {"taught", CodeKeyType::truth, "false",
         "allowed is what was read with the command TEACH, and nothing until then"},
        {"unlike_last", CodeKeyType::truth, "false", "no code may be one of the last picture that was OK"},
        {"least_grade", CodeKeyType::choice, "\"F\"", "a code that is graded worse is not OK", 0, 0,
         "F|D|C|B|A"},
        {"region", CodeKeyType::wholes, "[]",
         "part of the picture that is looked at, [x, y, width, height] in px", 4, 4},
        {"thorough", CodeKeyType::truth, "false",
         "look a second time, and several times as long, where nothing is seen at first sight"},
        {"add_on", CodeKeyType::truth, "false",
         "with the two or five digits that may stand beside EAN and UPC"},
        {"ascii", CodeKeyType::truth, "false", "Code 39: pairs that begin with $ % / + are one character"},
        {"check", CodeKeyType::truth, "false",
         "Code 39, Interleaved 2 of 5 and Codabar: only with a right check character"},
        {"digits", CodeKeyType::wholes, "[]",
         "Interleaved 2 of 5: how many digits are in use, as [14]; of several, all from the fewest to the "
         "most",
         1, 16},
    };
    return {keys, static_cast<std::ptrdiff_t>(sizeof keys / sizeof keys[0])};
}

}  // namespace fovea::apps
