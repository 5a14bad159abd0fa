// SPDX-License-Identifier: MIT
//
// Arguments: the words of a command line against a table of options, which also makes the help.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/number/decimal.hpp>

#include <common/text.hpp>

namespace fovea::apps {

/// One option of a command: --name, or --name VALUE when value is not "". --out is also -o.
struct Option {
    const char* name;
    const char* value;  ///< what the value is called in the help; "" for a switch
    const char* text;   ///< help, lines divided by '\n'
};

/// One command of the tool.
struct Command {
    const char* name;
    const char* operands;  ///< "IMAGE..." and the like
    const char* summary;   ///< one line
    std::vector<Option> options;
    const char* notes;  ///< further help, may be ""
};

/// What stood on the command line.
class Arguments {
public:
    /// Reads the words behind the command. problem() says what is wrong first, "" if nothing is.
    Arguments(const Command& command, const std::vector<std::string>& words) {
        bool options_end = false;
        for (std::size_t i = 0; i < words.size(); ++i) {
            const std::string& word = words[i];
            if (options_end || word == "-" || word.empty() || word[0] != '-')
                operands_.push_back(word);
            else if (word == "--")
                options_end = true;
            else
                read_option(command, words, i);
        }
    }

    const std::string& problem() const { return problem_; }
    const std::vector<std::string>& operands() const { return operands_; }
    bool has(const std::string& name) const { return find(name) != nullptr; }
    /// The value given, or otherwise.
    std::string value(const std::string& name, const std::string& otherwise = "") const {
        const Given* given = find(name);
        return given != nullptr ? given->value : otherwise;
    }

private:
    struct Given {
        std::string name, value;
    };

    void read_option(const Command& command, const std::vector<std::string>& words, std::size_t& i) {
        const std::size_t equals = words[i].find('=');
        const std::string name = words[i].substr(0, equals);
        std::vector<std::string> names = {"help"};
        const Option* option = nullptr;
        for (const Option& known : command.options) {
            names.push_back(known.name);
            if ("--" + names.back() == name || (name == "-o" && names.back() == "out")) option = &known;
        }
        if (name == "--help" || name == "-h") {
            given_.push_back({"help", ""});
            return;
        }
        if (option == nullptr) {
            // The dashes do not make names alike.
            const std::string near =
                nearest_name(name.substr(std::min(name.find_first_not_of('-'), name.size())), names);
            fail("unknown option " + name + hint(near.empty() ? "" : "--" + near));
            return;
        }
        const bool takes_value = option->value[0] != '\0';
        std::string value;
        if (equals != std::string::npos) {
            value = words[i].substr(equals + 1);
            if (!takes_value) fail(name + " takes no value");
        } else if (takes_value) {
            // Another option there means that the value was forgotten.
            if (i + 1 < words.size() && words[i + 1].compare(0, 2, "--") != 0)
                value = words[++i];
            else
                fail(name + " needs a value: " + name + " " + option->value);
        }
        if (has(option->name)) fail(name + " is given twice");
        given_.push_back({option->name, value});
    }
    void fail(const std::string& problem) {
        if (problem_.empty()) problem_ = problem;
    }
    const Given* find(const std::string& name) const {
        for (const Given& given : given_)
            if (given.name == name) return &given;
        return nullptr;
    }

    std::vector<Given> given_;
    std::vector<std::string> operands_;
    std::string problem_;
};

/// Reads the whole number of an option, if it is given. False if it is none from least to most, and problem
/// says so.
inline bool whole_option(const Arguments& arguments, const char* name, int least, int most, int& value,
                         std::string& problem) {
    if (!arguments.has(name)) return true;
    const std::string text = arguments.value(name);
    const Result<Decimal> number = parse_decimal(span_of(text));
    if (number && number->millionths % 1000000 == 0 && number->millionths / 1000000 >= least &&
        number->millionths / 1000000 <= most) {
        value = static_cast<int>(number->millionths / 1000000);
        return true;
    }
    problem = std::string("--") + name + " takes a whole number from " + std::to_string(least) + " to " +
              std::to_string(most) + ", not '" + one_line(text) + "'";
    return false;
}

/// The help of one command.
inline std::string help_of(const Command& command) {
    std::string text = std::string("usage: fovea ") + command.name + " [options] " + command.operands +
                       "\n\n" + command.summary + "\n";
    const auto row = [&](const std::string& left, const std::string& right) {
        text += "  " + left + std::string(left.size() < 24 ? 24 - left.size() : 1, ' ');
        for (const char c : right) {
            text += c;
            if (c == '\n') text += std::string(26, ' ');
        }
        text += '\n';
    };
    text += "\noptions:\n";
    for (const Option& option : command.options)
        row(std::string("--") + option.name +
                (option.value[0] != '\0' ? std::string(" ") + option.value : ""),
            option.text);
    row("--help", "show this");
    if (command.notes[0] != '\0') text += std::string("\n") + command.notes;
    return text;
}

}  // namespace fovea::apps
