// SPDX-License-Identifier: MIT
//
// The table [codes] of a job, read from its text: every mistake with its line and column.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fovea/codec/toml.hpp>
#include <fovea/image/geometry.hpp>

#include <common/text.hpp>
#include <read/code_job.hpp>
#include <read/code_rule.hpp>
#include <read/symbology_names.hpp>

namespace fovea::apps {

/// What a job says of codes. Whatever else stands in it is a recipe.
struct CodeJobFile {
    /// There is a [codes]; without one nothing else here counts.
    bool found = false;
    /// No other table stands beside it.
    bool alone = true;
    CodeJob job;
    /// The text with blanks in place of [codes], so that all else stands where it stood.
    std::string recipe;
    TextPlace place;      ///< of the problem
    std::string problem;  ///< "" if it is good
};

/// Reads [codes], and if it stands alone what is in front of all tables. Stops at the first mistake.
CodeJobFile read_code_job(const std::string& text);

/// The keys of [codes] as a section of a manual page.
std::string code_keys_manual();

// ---- Implementation ---------------------------------------------------------------

namespace detail {

class CodeJobReader {
public:
    explicit CodeJobReader(const std::string& text) : text_(text) {}

    CodeJobFile read() {
        split_text();
        if (!file_.found || !file_.problem.empty()) return std::move(file_);
        if (file_.alone && !check_top()) return std::move(file_);
        for (const TomlItem& item : pairs_)
            if (!take(item)) return std::move(file_);
        static_cast<void>(check_whole());
        return std::move(file_);
    }

private:
    bool fail(TextPlace place, const std::string& problem) {
        file_.place = place;
        file_.problem = problem;
        return false;
    }

    /// Finds the table, and takes its lines out of the recipe.
    void split_text() {
        TomlReader reader(span_of(text_));
        bool inside = false;
        bool table_seen = false;
        int first_line = 0, end_line = 0;
        for (;;) {
            const Result<TomlItem> item = reader.next();
            if (!item) {
                if (file_.found) fail(reader.place(), reader.problem());
                return;
            }
            if (item->kind == TomlKind::pair) {
                if (inside)
                    pairs_.push_back(*item);
                else if (!table_seen)
                    top_.push_back(*item);
                continue;
            }
            if (item->kind == TomlKind::end) break;
            if (inside) end_line = item->place.line;
            table_seen = true;
            inside = string_of(item->name) == "codes";
            if (!inside) {
                file_.alone = false;
                continue;
            }
            const bool twice = file_.found;
            file_.found = true;
            if (twice || item->kind == TomlKind::array_table) {
                fail(item->place,
                     twice ? "[codes] stands twice" : "there is one [codes], in single brackets");
                return;
            }
            table_place_ = item->place;
            first_line = item->place.line;
        }
        file_.recipe = text_;
        int line = 1;
        for (char& c : file_.recipe) {
            if (c == '\n')
                ++line;
            else if (file_.found && line >= first_line && (end_line == 0 || line < end_line))
                c = ' ';
        }
    }

    /// What a recipe has in front of its tables stands in a job without one, too.
    bool check_top() {
        bool format = false, name = false;
        for (const TomlItem& item : top_) {
            const std::string key = string_of(item.name);
            bool& seen = key == "format" ? format : name;
            if (key != "format" && key != "name")
                return fail(item.place, "unknown key " + shortened(key, 40) +
                                            hint(nearest_name(key, {"format", "name"})));
            if (seen) return fail(item.place, key + " stands twice");
            seen = true;
            if (key == "format" &&
                (item.value.type != TomlType::integer || item.value.number.millionths != 1000000))
                return fail(item.value.place, "format: expected 1");
            std::string text;
            if (key == "name" &&
                (!string_in(item.value, text) || text.empty() || text.size() > 31 || !printable(text)))
                return fail(item.value.place,
                            "name: expected a text of 1 to 31 bytes without control characters");
        }
        if (!format) return fail({1, 1}, "the file lacks format = 1");
        return name || fail({1, 1}, "the file lacks name: what the job is called");
    }

    static bool string_in(const TomlValue& value, std::string& text) {
        // Escapes only make it shorter.
        std::vector<char> room(static_cast<std::size_t>(value.text.size()) + 1);
        const Result<int> size = toml_string(value, {room.data(), static_cast<std::ptrdiff_t>(room.size())});
        if (!size) return false;
        text.assign(room.data(), static_cast<std::size_t>(*size));
        return true;
    }

    bool take(const TomlItem& item) {
        const std::string name = string_of(item.name);
        std::vector<std::string> names;
        for (const CodeKey& key : code_keys()) {
            names.push_back(key.name);
            if (name != key.name) continue;
            if (place_of(name) != nullptr) return fail(item.place, name + " stands twice");
            places_.push_back({name, item.value.place});
            return take_value(key, item.value);
        }
        return fail(item.place,
                    "unknown key " + shortened(name, 40) + " in [codes]" + hint(nearest_name(name, names)));
    }
    const TextPlace* place_of(const std::string& name) const {
        for (const auto& [key, place] : places_)
            if (key == name) return &place;
        return nullptr;
    }

    bool take_value(const CodeKey& key, const TomlValue& value) {
        const std::string name = key.name;
        switch (key.type) {
            case CodeKeyType::truth:
                if (value.type != TomlType::boolean) return fail(value.place, name + " is true or false");
                if (value.truth) take_truth(name);
                return true;
            case CodeKeyType::whole: return whole_in(value, name, key.low, key.high, file_.job.count);
            case CodeKeyType::choice: return take_choice(key, value);
            case CodeKeyType::texts: return take_texts(key, value);
            case CodeKeyType::wholes: return take_wholes(key, value);
        }
        return true;
    }

    void take_truth(const std::string& name) {
        CodeJob& job = file_.job;
        BarRules& rules = job.options.rules;
        if (name == "taught") job.taught = true;
        if (name == "distinct") job.distinct = true;
        if (name == "unlike_last") job.unlike_last = true;
        if (name == "thorough") job.options.thorough = true;
        if (name == "add_on") rules.add_on = AddOn::appended;
        if (name == "ascii") rules.code_39_text = Code39Text::full_ascii;
        if (name == "check")
            rules.code_39_check = rules.interleaved_check = rules.codabar_check = CheckCharacter::required;
    }

    bool whole_in(const TomlValue& value, const std::string& name, int low, int high, int& number) {
        const std::int64_t found = value.number.millionths / 1000000;
        if (value.type != TomlType::integer || found < low || found > high)
            return fail(value.place, name + ": expected whole numbers from " + std::to_string(low) + " to " +
                                         std::to_string(high));
        number = static_cast<int>(found);
        return true;
    }

    /// "a" or "b", with quotes.
    static std::string quoted(std::vector<std::string> words) {
        for (std::string& word : words) word = json_string(word);
        return listed(words, "or");
    }
    bool take_choice(const CodeKey& key, const TomlValue& value) {
        const std::vector<std::string> choices = split(key.choices, '|');
        std::string text;
        const auto found =
            string_in(value, text) ? std::find(choices.begin(), choices.end(), text) : choices.end();
        if (found == choices.end())
            return fail(value.place, std::string(key.name) + ": expected " + quoted(choices) +
                                         hint(nearest_name(one_line(text), choices)));
        const auto number = static_cast<int>(found - choices.begin());
        if (std::string(key.name) == "others")
            file_.job.ignores_others = number == 1;
        else
            file_.job.least_grade = number;
        return true;
    }

    /// The elements of an array, so many of them as the key takes.
    bool elements_of(const CodeKey& key, const TomlValue& value, std::vector<TomlValue>& elements) {
        if (value.type != TomlType::array)
            return fail(value.place, std::string(key.name) + " is an array in brackets");
        TomlArrayReader reader(value);
        for (Result<TomlValue> each = reader.next(); each; each = reader.next()) elements.push_back(*each);
        const auto count = static_cast<int>(elements.size());
        if (count >= key.low && count <= key.high) return true;
        return fail(value.place, std::string(key.name) + ": expected " +
                                     (key.low == key.high ? "" : std::to_string(key.low) + " to ") +
                                     std::to_string(key.high) + " elements, not " + std::to_string(count));
    }

    bool take_texts(const CodeKey& key, const TomlValue& value) {
        constexpr std::size_t longest = 256;
        const std::string name = key.name;
        std::vector<TomlValue> elements;
        if (!elements_of(key, value, elements)) return false;
        for (const TomlValue& element : elements) {
            std::string text;
            if (!string_in(element, text)) return fail(element.place, name + ": expected texts in quotes");
            if (text.empty() || text.size() > longest)
                return fail(element.place, name + ": a text has 1 to " + std::to_string(longest) + " bytes");
            std::string problem;
            if (name == "symbologies") {
                SymbologySet set;
                problem = read_symbologies(text, set);
                if (problem.empty()) symbologies_ = symbologies_ | set;
            } else if (name == "allowed") {
                std::string bytes;
                problem = read_code_text(text, bytes);
                file_.job.allowed.allow(bytes);
            } else {
                CodePattern pattern;
                problem = pattern.read(text);
                file_.job.allowed.allow(pattern);
            }
            if (!problem.empty()) return fail(element.place, name + ": " + problem);
        }
        return true;
    }

    bool take_wholes(const CodeKey& key, const TomlValue& value) {
        const std::string name = key.name;
        std::vector<TomlValue> elements;
        if (!elements_of(key, value, elements)) return false;
        std::vector<int> numbers(elements.size());
        const bool region = name == "region";
        for (std::size_t k = 0; k < elements.size(); ++k)
            if (!whole_in(elements[k], name, region ? (k < 2 ? 0 : 1) : 2,
                          region ? max_image_side : most_bar_text, numbers[k]))
                return false;
        if (region) {
            file_.job.region = {numbers[0], numbers[1], numbers[2], numbers[3]};
            file_.job.region_place = value.place;
            return true;
        }
        BarRules& rules = file_.job.options.rules;
        rules.interleaved_shortest = *std::min_element(numbers.begin(), numbers.end());
        rules.interleaved_longest = *std::max_element(numbers.begin(), numbers.end());
        for (const int number : numbers)
            if (number % 2 != 0) return fail(value.place, "digits: expected even numbers");
        return is_valid(rules) || fail(value.place, "digits: expected even numbers");
    }

    /// What no key shows by itself.
    bool check_whole() {
        CodeJob& job = file_.job;
        if (place_of("symbologies") == nullptr)
            return fail(table_place_, "[codes] lacks symbologies: what is looked for, as [\"ean-13\"]");
        const TextPlace* const texts = place_of("allowed");
        if (job.taught && texts != nullptr)
            return fail(*texts, "allowed has no meaning beside taught = true; patterns have");
        if (job.ignores_others && !job.taught && job.allowed.empty())
            return fail(*place_of("others"),
                        "others = \"ignored\" wants allowed, patterns or taught beside it");
        if (job.distinct && job.count < 2)
            return fail(*place_of("distinct"), "distinct = true wants a count of 2 or more");
        job.options.symbologies = symbologies_;
        // One more than is expected, so that it is seen.
        job.options.most_codes = job.ignores_others ? CodeJob::most_seen : job.count + 1;
        return true;
    }

    const std::string& text_;
    CodeJobFile file_;
    TextPlace table_place_;
    SymbologySet symbologies_;
    std::vector<TomlItem> top_;
    std::vector<TomlItem> pairs_;
    std::vector<std::pair<std::string, TextPlace>> places_;
};

}  // namespace detail

inline CodeJobFile read_code_job(const std::string& text) { return detail::CodeJobReader(text).read(); }

inline std::string code_keys_manual() {
    std::string text =
        ".SH \"JOBS THAT READ CODES\"\n"
        "A job is a recipe, or has a table [codes], or both. What is in [codes] makes a picture OK or NG "
        "beside what\n"
        "the recipe does. Without a recipe the file begins with format = 1 and name = \"...\".\n"
        ".B fovea read \\-\\-job\njudges pictures by it.\n";
    for (const CodeKey& key : code_keys()) {
        text += std::string(".TP\n.B ") + key.name + "\n" + key.text;
        if (key.type == CodeKeyType::whole)
            text += "; " + std::to_string(key.low) + " to " + std::to_string(key.high);
        if (key.type == CodeKeyType::choice) text += "; " + listed(split(key.choices, '|'), "or");
        text += key.otherwise[0] == '\0' ? "; required" : std::string("; ") + key.otherwise + " if left out";
        text += ".\n";
    }
    return text;
}

}  // namespace fovea::apps
