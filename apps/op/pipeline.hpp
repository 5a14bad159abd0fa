// SPDX-License-Identifier: MIT
//
// Pipelines of the tool: "gaussian_5x5 | otsu | open:3", operators of the catalogue one after the
// other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/catalogue/operator.hpp>
#include <fovea/number/decimal.hpp>

#include <common/text.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

/// An operator and the values of its parameters, in order.
struct PipelineStep {
    const Operator* op = nullptr;
    std::vector<int> values;
};

/// A picture of any pixel, on the heap.
struct AnyPicture {
    PixelKind kind = PixelKind::none;
    Size size;
    std::vector<std::uint8_t> bytes;

    AnyPicture() = default;
    AnyPicture(PixelKind of, Size s)
        : kind(of), size(s), bytes(static_cast<std::size_t>(s.area() * fovea::bytes_of(of))) {}
    AnyImage image() { return {bytes.data(), size, std::ptrdiff_t{size.width} * fovea::bytes_of(kind)}; }
};

/// The names in "a|b|c" of a parameter.
inline std::vector<std::string> choices_of(const OperatorParameter& parameter) {
    return parameter.choices == nullptr ? std::vector<std::string>() : split(parameter.choices, '|');
}

/// A value as a person writes it.
inline std::string value_text(const OperatorParameter& parameter, int value) {
    const std::vector<std::string> choices = choices_of(parameter);
    const auto index = static_cast<std::size_t>(value);
    return value >= 0 && index < choices.size() ? choices[index] : std::to_string(value);
}

/// What a parameter may be, as "1, 3 ... 63" or "replicate, reflect_101 or zero".
inline std::string range_text(const OperatorParameter& parameter) {
    if (parameter.choices != nullptr) return listed(choices_of(parameter), "or");
    const int steps = (parameter.most - parameter.least) / parameter.step;
    const std::string most = std::to_string(parameter.least + steps * parameter.step);
    if (parameter.step == 1) return std::to_string(parameter.least) + " to " + most;
    return std::to_string(parameter.least) + ", " + std::to_string(parameter.least + parameter.step) +
           " ... " + most;
}

namespace detail {

inline std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\n");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

/// The operator that a word means: its name or alias, or the beginning of one operator's name alone.
inline const Operator* operator_meant(const std::string& word, std::string& problem) {
    if (const Operator* op = find_operator(all_operators(), word.c_str())) return op;
    std::vector<std::string> names;
    std::vector<const Operator*> begun;
    for (const OperatorFamily& family : all_operators())
        for (const Operator& op : family.operators) {
            if (op.alias != nullptr) names.push_back(op.alias);
            names.push_back(op.name);
            if (!word.empty() && names.back().compare(0, word.size(), word) == 0) begun.push_back(&op);
        }
    // One alone, or one that all the others begin with: opening, not opening_shaped.
    for (const Operator* op : begun) {
        const std::string name = op->name;
        if (std::all_of(begun.begin(), begun.end(), [&](const Operator* other) {
                return std::string(other->name).compare(0, name.size(), name) == 0;
            }))
            return op;
    }
    if (begun.size() > 1) {
        std::vector<std::string> some;
        for (std::size_t i = 0; i < begun.size() && i < 4; ++i) some.push_back(begun[i]->name);
        if (begun.size() > 4) some.push_back("others");
        problem = "'" + one_line(word) + "' may be " + listed(some, "or");
    } else {
        problem = "no operator is called '" + one_line(word) + "'" + hint(nearest_name(word, names)) +
                  "; `fovea ops` lists them";
    }
    return nullptr;
}

/// A value from its text; false if it is none of the parameter's.
inline bool read_value(const OperatorParameter& parameter, const std::string& text, int& value) {
    const std::vector<std::string> choices = choices_of(parameter);
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (choices[i] == text) {
            value = static_cast<int>(i);
            return true;
        }
    if (!choices.empty()) return false;
    const Result<Decimal> number = parse_decimal(fovea::apps::span_of(text));
    if (!number || number->millionths % 1000000 != 0) return false;
    const std::int64_t whole = number->millionths / 1000000;
    if (whole < parameter.least || whole > parameter.most) return false;
    value = static_cast<int>(whole);
    return parameter.allows(value);
}

/// "3", "3,5" or "width=3,border=zero" behind an operator's name.
inline bool read_values(PipelineStep& step, const std::string& text, std::string& problem) {
    const Operator& op = *step.op;
    const int count = op.parameter_count();
    std::vector<bool> given(static_cast<std::size_t>(count), false);
    for (int i = 0; i < count; ++i) step.values.push_back(op.parameters[i].preset);
    std::size_t next = 0;
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) names.push_back(op.parameters[i].name);
    for (const std::string& part : text.empty() ? std::vector<std::string>() : split(text, ',')) {
        const std::size_t equals = part.find('=');
        std::size_t index = next++;
        if (equals != std::string::npos) {
            const std::string name = trimmed(part.substr(0, equals));
            index = 0;
            while (index < names.size() && names[index] != name) ++index;
            if (index == names.size()) {
                problem = std::string(op.name) + " has no parameter '" + one_line(name) + "'" +
                          hint(nearest_name(name, names));
                return false;
            }
        }
        if (index >= names.size()) {
            problem = std::string(op.name) +
                      (names.empty() ? " takes no value" : " takes no more than " + listed(names));
            return false;
        }
        const OperatorParameter& parameter = op.parameters[index];
        const std::string value = trimmed(equals == std::string::npos ? part : part.substr(equals + 1));
        if (!read_value(parameter, value, step.values[index])) {
            problem = std::string(op.name) + ": " + parameter.name + " is " + range_text(parameter) +
                      ", not '" + one_line(value) + "'";
            return false;
        }
        given[index] = true;
    }
    for (std::size_t i = 1; i < names.size(); ++i)
        if (op.parameters[i].follows && !given[i] && given[i - 1]) step.values[i] = step.values[i - 1];
    return true;
}

}  // namespace detail

/// Reads a pipeline. False if it is wrong, and problem says why.
inline bool parse_pipeline(const std::string& text, std::vector<PipelineStep>& steps, std::string& problem) {
    steps.clear();
    for (const std::string& word : split(text, '|')) {
        const std::string part = detail::trimmed(word);
        const std::size_t colon = part.find(':');
        PipelineStep step;
        step.op = detail::operator_meant(detail::trimmed(part.substr(0, colon)), problem);
        if (step.op == nullptr) return false;
        if (!detail::read_values(step, colon == std::string::npos ? "" : part.substr(colon + 1), problem))
            return false;
        if (!steps.empty() && steps.back().op->output != step.op->inputs[0]) {
            problem = std::string(steps.back().op->name) + " makes " + describe(steps.back().op->output) +
                      ", but " + step.op->name + " takes " + describe(step.op->inputs[0]);
            return false;
        }
        steps.push_back(std::move(step));
    }
    return true;
}

/// Runs one step. second is the other input of operators that have two.
inline Status run_step(const PipelineStep& step, AnyPicture& input, AnyPicture* second, AnyPicture& output,
                       std::int64_t& scratch_bytes) {
    OperatorCall call;
    for (std::size_t i = 0; i < step.values.size(); ++i) call.values[i] = step.values[i];
    call.inputs[0] = input.image();
    if (second != nullptr) call.inputs[1] = second->image();
    const Size size = step.op->size_for(input.size, call.values);
    if (size.empty()) return Status::bad_argument;
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    output = AnyPicture(step.op->output, size);
    scratch_bytes = step.op->scratch_for(input.size, call.values);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(scratch_bytes));
    call.scratch = {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())};
    call.output = output.image();
    return run_operator(*step.op, call);
}

}  // namespace fovea::apps
