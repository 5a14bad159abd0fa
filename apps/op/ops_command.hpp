// SPDX-License-Identifier: MIT
//
// fovea ops: what is in the catalogue.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fovea/catalogue/operator.hpp>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <op/all_operators.hpp>
#include <op/pipeline.hpp>

namespace fovea::apps {

inline Command ops_help() {
    return {"ops",
            "[NAME...]",
            "Lists the operators of `fovea op`, or tells of some of them.",
            {{"json", "", "one line of JSON for each operator"},
             {"markdown", "", "the table of the documentation"}},
            ""};
}

namespace detail {

inline std::string pixels_text(const Operator& op) {
    std::string text = describe(op.inputs[0]);
    if (op.input_count() == 2) text += std::string(", ") + describe(op.inputs[1]);
    return text + " to " + describe(op.output);
}

/// "opening (open)": a name, and the shorter one where there is.
inline std::string names_of(const Operator& op) {
    return op.name + (op.alias == nullptr ? std::string() : std::string(" (") + op.alias + ")");
}

inline std::string listed_line(const Operator& op) {
    const std::string names = names_of(op);
    return "  " + names + std::string(names.size() < 24 ? 24 - names.size() : 1, ' ') + op.summary + "\n";
}

inline std::string told(const Operator& op) {
    std::string text = names_of(op) + ": " + op.summary + "\n  " + pixels_text(op);
    text += op.book[0] == '\0' ? "\n" : std::string("; book ") + op.book + "\n";
    for (int i = 0; i < op.parameter_count(); ++i) {
        const OperatorParameter& parameter = op.parameters[i];
        text += std::string("  ") + parameter.name + ": " + parameter.text + "; " + range_text(parameter) +
                "; " +
                (parameter.follows && i > 0 ? std::string("as ") + op.parameters[i - 1].name
                                            : value_text(parameter, parameter.preset)) +
                " if not given\n";
    }
    return text;
}

inline std::string json_operator(const std::string& family, const Operator& op) {
    std::string text = "{\"schema\":1,\"op\":" + json_string(op.name) + ",\"family\":" + json_string(family) +
                       (op.alias == nullptr ? "" : ",\"alias\":" + json_string(op.alias)) +
                       ",\"summary\":" + json_string(op.summary) + ",\"inputs\":[" +
                       json_string(describe(op.inputs[0]));
    if (op.input_count() == 2) text += "," + json_string(describe(op.inputs[1]));
    text += "],\"output\":" + json_string(describe(op.output)) + ",\"parameters\":[";
    for (int i = 0; i < op.parameter_count(); ++i) {
        const OperatorParameter& parameter = op.parameters[i];
        text +=
            std::string(i == 0 ? "" : ",") + "{\"name\":" + json_string(parameter.name) +
            ",\"least\":" + std::to_string(parameter.least) + ",\"most\":" + std::to_string(parameter.most) +
            ",\"step\":" + std::to_string(parameter.step) + ",\"preset\":" + std::to_string(parameter.preset);
        if (parameter.choices != nullptr) {
            text += ",\"choices\":[";
            const std::vector<std::string> choices = choices_of(parameter);
            for (std::size_t k = 0; k < choices.size(); ++k)
                text += (k == 0 ? "" : ",") + json_string(choices[k]);
            text += "]";
        }
        text += "}";
    }
    return text + "]}\n";
}

/// A cell of a table of Markdown.
inline std::string cell(const std::string& text) {
    std::string escaped;
    for (const char c : text) escaped += c == '|' ? "\\|" : std::string(1, c);
    return escaped;
}

inline std::string markdown_row(const Operator& op) {
    std::string values;
    for (int i = 0; i < op.parameter_count(); ++i)
        values += (i == 0 ? "" : "; ") + std::string("`") + op.parameters[i].name + "` " +
                  range_text(op.parameters[i]);
    return std::string("| `") + op.name + "`" +
           (op.alias == nullptr ? std::string() : std::string(", `") + op.alias + "`") + " | " +
           cell(op.summary) + " | " + pixels_text(op) + " | " + cell(values) + " | " + op.book + " |\n";
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode ops_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(ops_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(ops_help()));
        return exit_ok;
    }
    if (!arguments.problem().empty()) {
        io.complain("fovea ops: " + arguments.problem());
        return exit_failed;
    }
    std::vector<const Operator*> wanted;
    for (const std::string& name : arguments.operands()) {
        std::string problem;
        const Operator* op = detail::operator_meant(name, problem);
        if (op == nullptr) {
            io.complain("fovea ops: " + problem);
            return exit_failed;
        }
        wanted.push_back(op);
    }
    const bool json = arguments.has("json");
    const bool markdown = arguments.has("markdown");
    if (markdown)
        io.print(
            "# All operators of `fovea op`\n\nPrinted by `fovea ops --markdown`. Each is a function of the "
            "core too, under "
            "the same name or nearly so.\n");
    for (const OperatorFamily& family : all_operators()) {
        if (markdown)
            io.print("\n## " + std::string(family.name) +
                     "\n\n| operator | what it does | pixels | parameters | book |\n|---|---|---|---|---|\n");
        else if (!json && wanted.empty())
            io.print(std::string(family.name) + "\n");
        for (const Operator& op : family.operators) {
            const bool named = std::find(wanted.begin(), wanted.end(), &op) != wanted.end();
            if (!wanted.empty() && !named) continue;
            if (json)
                io.print(detail::json_operator(family.name, op));
            else if (markdown)
                io.print(detail::markdown_row(op));
            else if (named)
                io.print(detail::told(op));
            else
                io.print(detail::listed_line(op));
        }
    }
    return exit_ok;
}

}  // namespace fovea::apps
