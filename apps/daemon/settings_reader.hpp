// SPDX-License-Identifier: MIT
//
// Reads settings from text, and writes the pages about them from the same table.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/codec/toml.hpp>

#include <common/text.hpp>
#include <daemon/result_presets.hpp>
#include <daemon/result_template.hpp>
#include <daemon/settings.hpp>

namespace fovea::apps {

/// What is wrong with a settings file; problem is empty if nothing is.
struct SettingsProblem {
    std::string problem;
    TextPlace place;
};

/// Reads settings. After a problem they are as they were.
inline SettingsProblem read_settings(const std::string& text, Settings& settings);

/// A settings file with every key, its default and its help. `fovead --sample-config` prints it.
inline std::string sample_settings();

/// The same as a table of a manual page.
inline std::string settings_manual();

// ---- Implementation ---------------------------------------------------------------

namespace detail {

class SettingsReader {
public:
    SettingsReader(const std::string& text, Settings& into) : reader_(span_of(text)), settings_(into) {}

    SettingsProblem read() {
        for (;;) {
            const Result<TomlItem> item = reader_.next();
            if (!item) return {reader_.problem(), reader_.place()};
            place_ = item->place;
            if (item->kind == TomlKind::end) break;
            if (item->kind == TomlKind::pair)
                take_pair(*item);
            else
                begin_table(string_of(item->name), item->kind == TomlKind::array_table);
            if (!problem_.empty()) return {problem_, place_};
        }
        check_control();
        if (!problem_.empty()) return {problem_, place_};
        if (!seen("", "format")) return {"the key format = 1 is missing", {1, 1}};
        check_lines();
        return {problem_, place_};
    }

private:
    struct Seen {
        std::string table;
        std::string key;
        TextPlace place;
    };

    void fail(const std::string& problem) { problem_ = problem; }

    bool seen(const std::string& table, const std::string& key) const {
        for (const Seen& each : seen_)
            if (each.table == table && each.key == key) return true;
        return false;
    }
    /// Of a key that was seen.
    void fail_at(const std::string& table, const std::string& key, const std::string& problem) {
        for (const Seen& each : seen_)
            if (each.table == table && each.key == key) place_ = each.place;
        fail(problem);
    }

    static std::vector<std::string> tables() {
        std::vector<std::string> names;
        for (const SettingKey& key : setting_keys())
            if (key.table[0] != '\0' && (names.empty() || names.back() != key.table))
                names.push_back(key.table);
        return names;
    }

    void begin_table(const std::string& name, bool array) {
        check_control();
        const std::string wanted = array ? "[[" + name + "]]" : name;
        for (const std::string& known : tables()) {
            if (known == wanted) {
                if (!array && seen(name, "")) return fail("[" + name + "] stands twice");
                table_ = known;
                seen_.push_back({name, "", place_});
                if (!array) return;
                if (settings_.controls.push({}) != Status::ok)
                    return fail("more than " + std::to_string(Settings::most_controls) + " of [[control]]");
                forget(known);
                return;
            }
            if (known == "[[" + name + "]]")
                return fail("[[" + name + "]] has two brackets, since it may come again");
            if (array && known == name) return fail("[" + name + "] has one bracket, since it comes once");
        }
        std::vector<std::string> plain;
        for (const std::string& known : tables())
            plain.push_back(known[0] == '[' ? known.substr(2, known.size() - 4) : known);
        fail("unknown table " + one_line(name) + hint(nearest_name(name, plain)));
    }
    void forget(const std::string& table) {
        std::vector<Seen> kept;
        for (const Seen& each : seen_)
            if (each.table != table) kept.push_back(each);
        seen_ = kept;
    }
    /// A control has both of its keys.
    void check_control() {
        if (table_ != "[[control]]" || !problem_.empty()) return;
        for (const char* key : {"name", "value"})
            if (!seen(table_, key)) return fail(std::string("a [[control]] without its ") + key);
    }
    /// What no key shows by itself: a trigger without its line, and a line for two things.
    void check_lines() {
        const Settings::Lines& lines = settings_.lines;
        const bool triggered = settings_.trigger.source == TriggerSource::line;
        if (triggered && lines.chip.empty())
            return fail_at("trigger", "source", "source = \"line\" wants a chip in [lines]");
        if (triggered && settings_.trigger.line.empty())
            return fail_at("trigger", "source", "source = \"line\" wants a line = beside it");
        if (lines.chip.empty()) return;
        const struct {
            const char* table;
            const char* key;
            const Text<63>& line;
        } used[] = {{"lines", "ready", lines.ready},
                    {"lines", "busy", lines.busy},
                    {"lines", "valid", lines.valid},
                    {"lines", "ok", lines.ok},
                    {"lines", "ng", lines.not_ok},
                    {"lines", "alarm", lines.alarm},
                    {"trigger", "line", settings_.trigger.line}};
        const int count = triggered ? 7 : 6;
        for (int k = 0; k < count; ++k)
            for (int other = 0; other < k; ++other)
                if (!used[k].line.empty() && used[k].line == used[other].line)
                    return fail_at(used[k].table, used[k].key,
                                   std::string(k == 6 ? "the trigger" : used[k].key) + " has the line of " +
                                       used[other].key);
    }

    void take_pair(const TomlItem& item) {
        const std::string name = string_of(item.name);
        std::vector<std::string> names;
        for (const SettingKey& key : setting_keys()) {
            if (table_ != key.table) continue;
            names.push_back(key.name);
            if (name != key.name) continue;
            if (seen(table_, name)) return fail(name + " stands twice");
            seen_.push_back({table_, name, item.value.place});
            return take_value(key, item.value);
        }
        fail("unknown key " + one_line(name) + (table_.empty() ? "" : " in " + table_) +
             hint(nearest_name(name, names)));
    }

    void take_value(const SettingKey& key, const TomlValue& value) {
        place_ = value.place;
        SettingValue found;
        char letters[512];
        const std::string name = key.name;
        switch (key.type) {
            case SettingType::boolean:
                if (value.type != TomlType::boolean) return fail(name + " is true or false");
                found.number = value.truth ? 1 : 0;
                break;
            case SettingType::integer:
                if (value.type != TomlType::integer) return fail(name + " is a whole number");
                found.number = value.number.millionths / 1000000;
                if (found.number < key.low || found.number > key.high)
                    return fail(name + " is from " + std::to_string(key.low) + " to " +
                                std::to_string(key.high));
                break;
            case SettingType::text:
            case SettingType::choice: {
                if (value.type != TomlType::string) return fail(name + " is a text in quotes");
                const Result<int> length = toml_string(value, letters);
                if (!length || *length > (key.type == SettingType::text ? key.high : 500))
                    return fail(name + " is longer than " + std::to_string(key.high) + " bytes");
                found.text = {letters, *length};
                const std::string text(letters, static_cast<std::size_t>(*length));
                if (!printable(text))
                    return fail(name + " has a control character, or is no UTF-8" +
                                (name == "results" ? "; a line ends with \\\\r\\\\n here" : ""));
                if (key.type == SettingType::text) {
                    if (*length < key.low) return fail(name + " is empty");
                    if (name == "results" && !check_template(text)) return;
                    break;
                }
                const std::vector<std::string> choices = split(key.choices, '|');
                std::size_t k = 0;
                while (k < choices.size() && choices[k] != text) ++k;
                if (k == choices.size())
                    return fail(name + " is one of " + listed(choices, "or") +
                                hint(nearest_name(text, choices)));
                found.number = static_cast<std::int64_t>(k);
                break;
            }
        }
        key.place.load(settings_, found);
    }
    bool check_template(const std::string& text) {
        if (text.empty() || text == "json" || result_preset(span_of(text)) != nullptr) return true;
        ResultTemplate made;
        if (made.read(span_of(text)) == Status::ok) return true;
        fail(std::string("results: ") + made.problem() + ", at letter " + std::to_string(made.place()) +
             "; man fovead.conf has all");
        return false;
    }

    TomlReader reader_;
    Settings& settings_;
    std::string table_;
    std::vector<Seen> seen_;
    std::string problem_;
    TextPlace place_;
};

/// What a value may be, for people.
inline std::string allowed(const SettingKey& key) {
    switch (key.type) {
        case SettingType::boolean: return "true or false";
        case SettingType::integer: return std::to_string(key.low) + " to " + std::to_string(key.high);
        case SettingType::choice: return listed(split(key.choices, '|'), "or");
        case SettingType::text: return "";
    }
    return "";
}

}  // namespace detail

inline SettingsProblem read_settings(const std::string& text, Settings& settings) {
    Settings fresh;
    for (const SettingKey& key : setting_keys())
        if (key.type == SettingType::text && std::strlen(key.otherwise) > 2) {
            const std::string otherwise(key.otherwise + 1, std::strlen(key.otherwise) - 2);
            key.place.load(fresh, {0, span_of(otherwise)});
        }
    SettingsProblem problem = detail::SettingsReader(text, fresh).read();
    if (problem.problem.empty()) settings = fresh;
    return problem;
}

inline std::string sample_settings() {
    std::string text = "# Settings of fovead. What is left out is as it stands here.\n";
    std::string table;
    for (const SettingKey& key : setting_keys()) {
        const bool array = key.table[0] == '[';
        if (table != key.table) {
            text += std::string("\n") + (array ? "#" : "") +
                    (array ? key.table : std::string("[") + key.table + "]") + "\n";
            table = key.table;
        }
        const std::string values = detail::allowed(key);
        text += std::string("# ") + key.text +
                (values.empty() || key.table[0] == '\0' ? "" : " (" + values + ")") + "\n";
        const std::string otherwise =
            array ? (key.type == SettingType::integer ? "20" : "\"gain\"") : key.otherwise;
        text += std::string(array ? "#" : "") + key.name + " = " + otherwise + "\n";
    }
    return text;
}

inline std::string settings_manual() {
    std::string text;
    std::string table = "-";
    for (const SettingKey& key : setting_keys()) {
        if (table != key.table) {
            table = key.table;
            text += table.empty() ? ".SS In front of all tables\n"
                                  : ".SS " + (table[0] == '[' ? table : "[" + table + "]") + "\n";
        }
        const std::string values = detail::allowed(key);
        text += std::string(".TP\n.B ") + key.name + "\n";
        for (const char* letter = key.text; *letter != '\0'; ++letter)
            text += *letter == '\\' ? "\\e" : std::string(1, *letter);
        if (!values.empty()) text += "; " + values;
        if (key.otherwise[0] != '\0') text += std::string("; ") + key.otherwise + " if left out";
        if (key.change == SettingChange::reopens) text += "; opens the devices anew";
        text += ".\n";
    }
    return text;
}

}  // namespace fovea::apps
