// SPDX-License-Identifier: MIT
//
// SerialCommand: what a PLC or a person says to the daemon on a serial line.
//
// A command is a line of ASCII, ended by CR, LF or both. Capitals do not count. "#" and up to 16 letters and
// digits in front of it come back in front of the reply, so that replies can be told apart.
//
//     TRG               one trigger; its answer comes as a result, and OK says that it was taken
//     JOBS?             the jobs there are: OK 1 cap, 2 plate
//     JOB?              the job in use: OK 2 plate
//     JOB 2, JOB plate  takes another job between two frames
//     STAT?             OK triggers 9 ok 7 ng 1 error 0 missed 1 us 5210 6020 7404: the shortest, mean and
//                       longest time from trigger to answer
//     STAT RESET        counts from 0
//     LAST?             the last result again
//     RDY?              OK 1 if a trigger would be answered, OK 0 if not
//     TEACH name        keeps the next frame as a sample of that name, in the folder of [teach]; if the job
//                       has taught = true, its codes are those that are allowed from then on
//     VER?              OK fovead 0.1.0
//
// Replies are "OK ..." or "ERR number reason". A silent device replies to what asks (?), and to errors.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>

#include <daemon/text_buffer.hpp>

namespace fovea::apps {

enum class CommandVerb : std::uint8_t {
    none,  ///< an empty line
    trigger,
    list_jobs,
    ask_job,
    take_job,
    ask_tally,
    reset_tally,
    ask_last,
    ask_ready,
    teach,
    ask_version,
};

/// Numbers of errors, which do not change.
enum class CommandError : std::uint8_t {
    none = 0,
    malformed = 10,  ///< no line of printable ASCII, or too long
    unknown = 11,    ///< no such command
    argument = 12,   ///< an argument too many, none, or a wrong one
    no_such_job = 20,
    job_refused = 21,  ///< it does not fit this camera or this memory
    not_ready = 30,    ///< the camera is not in order, or there is no job
    busy = 31,         ///< another trigger is being answered
    nothing_yet = 40,  ///< no result yet
    keeps_none = 41,   ///< there is no folder for samples, and the job takes no codes
    failed = 50,       ///< it was tried
};

constexpr const char* describe(CommandError error) {
    switch (error) {
        case CommandError::none: return "";
        case CommandError::malformed: return "not a line of printable ASCII of at most 255 letters";
        case CommandError::unknown: return "no such command";
        case CommandError::argument: return "an argument is missing, wrong or too many";
        case CommandError::no_such_job: return "no such job";
        case CommandError::job_refused: return "the job does not fit";
        case CommandError::not_ready: return "not ready";
        case CommandError::busy: return "busy";
        case CommandError::nothing_yet: return "no result yet";
        case CommandError::keeps_none: return "[teach] has no folder, and the job no taught = true";
        case CommandError::failed: return "failed";
    }
    return "";
}

struct SerialCommand {
    CommandVerb verb = CommandVerb::none;
    CommandError error = CommandError::none;
    /// What is echoed, without its "#"; of a line that could not be read, too, where it began well.
    Span<const char> id;
    /// A job's or a sample's name.
    Span<const char> name;
    /// Of a job that is named by its number; 0 if it is not.
    int number = 0;
};

inline constexpr std::ptrdiff_t longest_command = 255;
inline constexpr std::ptrdiff_t longest_command_id = 16;
inline constexpr std::ptrdiff_t longest_job_name = 63;

/// Reads a line without its end. The spans of the answer lie in the line.
constexpr SerialCommand read_command(Span<const char> line);

/// Writes the reply to a command that failed: "#id ERR number reason", without an end.
inline void reply_error(const SerialCommand& command, CommandError error, TextBuffer& reply) {
    if (!command.id.empty()) reply.put('#').text(command.id).put(' ');
    reply.text("ERR ").number(static_cast<int>(error)).put(' ').text(describe(error));
}
/// Begins the reply to one that did not: "#id OK".
inline TextBuffer& reply_ok(const SerialCommand& command, TextBuffer& reply) {
    if (!command.id.empty()) reply.put('#').text(command.id).put(' ');
    return reply.text("OK");
}

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr bool is_letter_or_digit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}
/// What names of jobs and samples are made of; they become names of files.
constexpr bool is_name_letter(char c) { return is_letter_or_digit(c) || c == '-' || c == '_' || c == '.'; }

/// The next word of a line, and the line behind it.
constexpr Span<const char> take_word(Span<const char>& line) {
    while (!line.empty() && line[0] == ' ') line = line.from(1);
    std::ptrdiff_t length = 0;
    while (length < line.size() && line[length] != ' ') ++length;
    const Span<const char> word = line.first(length);
    line = line.from(length);
    return word;
}

constexpr bool same_word(Span<const char> word, const char* known) {
    std::ptrdiff_t k = 0;
    for (; k < word.size() && known[k] != '\0'; ++k) {
        const char c = word[k] >= 'a' && word[k] <= 'z' ? static_cast<char>(word[k] - 'a' + 'A') : word[k];
        if (c != known[k]) return false;
    }
    return k == word.size() && known[k] == '\0';
}

/// The name of a job or sample; empty for what cannot be one: a dot in front hides a file, or leaves its
/// folder.
constexpr Span<const char> name_in(Span<const char> word) {
    if (word.size() > longest_job_name || (!word.empty() && word[0] == '.')) return {};
    for (const char c : word)
        if (!is_name_letter(c)) return {};
    return word;
}

/// A number from 1 to 9999, 0 for what is none.
constexpr int number_in(Span<const char> word) {
    if (word.empty() || word.size() > 4) return 0;
    int number = 0;
    for (const char c : word) {
        if (c < '0' || c > '9') return 0;
        number = 10 * number + (c - '0');
    }
    return number;
}

}  // namespace detail

constexpr SerialCommand read_command(Span<const char> line) {
    struct Known {
        const char* word;
        CommandVerb verb;
        bool takes_name;
    };
    constexpr Known known[] = {
        {"TRG", CommandVerb::trigger, false},     {"JOBS?", CommandVerb::list_jobs, false},
        {"JOB?", CommandVerb::ask_job, false},    {"JOB", CommandVerb::take_job, true},
        {"STAT?", CommandVerb::ask_tally, false}, {"STAT", CommandVerb::reset_tally, true},
        {"LAST?", CommandVerb::ask_last, false},  {"RDY?", CommandVerb::ask_ready, false},
        {"TEACH", CommandVerb::teach, true},      {"VER?", CommandVerb::ask_version, false},
    };
    SerialCommand command;
    if (line.size() > longest_command) command.error = CommandError::malformed;
    for (const char c : line)
        if (c < ' ' || c > '~') command.error = CommandError::malformed;
    if (command.error != CommandError::none) return command;

    Span<const char> rest = line;
    Span<const char> word = detail::take_word(rest);
    if (!word.empty() && word[0] == '#') {
        const Span<const char> id = word.from(1);
        if (id.empty() || id.size() > longest_command_id) command.error = CommandError::malformed;
        for (const char c : id)
            if (!detail::is_letter_or_digit(c)) command.error = CommandError::malformed;
        if (command.error != CommandError::none) return command;
        command.id = id;
        word = detail::take_word(rest);
    }
    const Span<const char> argument = detail::take_word(rest);
    if (word.empty()) {
        // An echo of nothing would be no reply to anything.
        if (!command.id.empty()) command.error = CommandError::unknown;
        return command;
    }
    for (const Known& each : known) {
        if (!detail::same_word(word, each.word)) continue;
        command.verb = each.verb;
        if (!detail::take_word(rest).empty() || argument.empty() == each.takes_name)
            command.error = CommandError::argument;
        if (each.verb == CommandVerb::reset_tally) {
            if (!detail::same_word(argument, "RESET")) command.error = CommandError::argument;
        } else if (each.takes_name && command.error == CommandError::none) {
            command.number = each.verb == CommandVerb::take_job ? detail::number_in(argument) : 0;
            command.name = detail::name_in(argument);
            if (command.name.empty()) command.error = CommandError::argument;
        }
        return command;
    }
    command.error = CommandError::unknown;
    return command;
}

}  // namespace fovea::apps
