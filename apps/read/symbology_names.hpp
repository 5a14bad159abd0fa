// SPDX-License-Identifier: MIT
//
// Symbologies on a command line: "ean-13,qr", and groups of them.
#pragma once

#include <string>
#include <vector>

#include <fovea/code/bar_reading.hpp>
#include <fovea/code/symbology.hpp>

#include <common/text.hpp>

namespace fovea::apps {

/// The word for a symbology on a command line: its name in small letters, with - for blanks.
inline std::string word_of(Symbology symbology) {
    std::string word = small_letters(name(symbology));
    for (char& c : word)
        if (c == ' ') c = '-';
    return word;
}
inline Symbology symbology_at(int index) { return static_cast<Symbology>(index); }

/// Symbologies of words divided by commas; the problem if one is none.
inline std::string read_symbologies(const std::string& text, SymbologySet& set) {
    std::vector<std::string> names = {"all", "bars", "matrices", "retail"};
    for (int i = 0; i < symbology_count; ++i) names.push_back(word_of(symbology_at(i)));
    set = SymbologySet();
    for (const std::string& given : split(text, ',')) {
        const std::string word = small_letters(given);
        SymbologySet added;
        if (word == "all") added = SymbologySet::all();
        if (word == "bars") added = bar_symbologies();
        if (word == "matrices") added = SymbologySet(Symbology::qr) | Symbology::data_matrix;
        if (word == "retail") added = retail_symbologies();
        for (int i = 0; i < symbology_count; ++i)
            if (word == word_of(symbology_at(i))) added = symbology_at(i);
        if (added.empty())
            return "there is no symbology '" + one_line(given) + "'" + hint(nearest_name(word, names)) +
                   "; there are " + listed(names);
        set = set | added;
    }
    return "";
}

}  // namespace fovea::apps
