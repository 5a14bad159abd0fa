// SPDX-License-Identifier: MIT
//
// fovea read: the bar and matrix codes in pictures.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fovea/code/read_codes.hpp>
#include <fovea/code/text_utf8.hpp>
#include <fovea/draw/cross.hpp>
#include <fovea/draw/line.hpp>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>
#include <read/code_job_reader.hpp>
#include <read/code_judge.hpp>
#include <read/code_report.hpp>
#include <read/code_rule.hpp>
#include <read/symbology_names.hpp>

namespace fovea::apps {

inline Command read_help() {
    return {
        "read",
        "IMAGE...",
        "Reads bar codes, QR codes and Data Matrix codes in pictures.",
        {{"symbology", "NAME,...",
          "what to look for, as `ean-13,qr`; also `bars`, `matrices`, `retail`\nand `all`, which is what is "
          "looked for if "
          "not given"},
         {"most", "N", "codes of a picture after which the search ends; 32"},
         {"quick", "", "do not look a second time, and longer, where nothing is seen at\nfirst sight"},
         {"add-on", "", "with the two or five digits that may stand beside EAN and UPC"},
         {"ascii", "", "Code 39: pairs that begin with $ % / + are one character"},
         {"check", "", "Code 39, Interleaved 2 of 5 and Codabar: only with a right check\ncharacter"},
         {"digits", "N,...",
          "Interleaved 2 of 5: how many digits are in use, as 14; 6,80 are 6 to 80, as without it"},
         {"allowed", "TEXT", "the text that a code must have: it is OK, any other is NG"},
         {"allowed-file", "FILE", "the same with a text on each line"},
         {"pattern", "PATTERN",
          "the same for all texts that a pattern fits: # is a digit, @ a letter,\n? any character, * any "
          "number "
          "of them, \\ in front of one of these\nthe character itself"},
         {"job", "JOB.toml",
          "judge each picture as fovead does by the [codes] of that job, which\nhas all of the options "
          "above"},
         {"unique", "", "tell a code once, in however many pictures it stands"},
         {"prefix", "TEXT", "stands in front of each text"},
         {"suffix", "TEXT", "stands behind it"},
         {"raw", "", "nothing but the bytes of each text, and a line feed"},
         {"json", "", "one JSON object a code instead of one line for people"},
         {"explain", "PICTURE",
          "write a picture of what was read, PNG or PPM; of several images,\nnumber n goes to PICTURE with "
          "-n before its "
          "ending"}},
        "Pictures are PGM, PPM, BMP, PNG or baseline JPEG; - is the standard input. Texts are UTF-8, as\n"
        "far as a code says or lets guess what its bytes mean; \\n, \\r, \\t and \\xNN stand for control\n"
        "characters. Corners begin where reading begins and go on clockwise as one reads.\n\n"
        "Ends with 0 when every picture has a code and all are allowed, with 1 when one has none or one\n"
        "that is not, and with 2 when a picture cannot be read or judged.\n"};
}

namespace detail {

struct ReadSettings {
    ReadCodesOptions codes;
    bool json = false;
    bool raw = false;
    bool unique = false;
    bool judges = false;  ///< some texts are allowed, others not
    CodeRule allowed;
    bool by_job = false;
    CodeJob job;
    std::string prefix;
    std::string suffix;
    std::string explain_name;
};

/// "14" or "8,14": the fewest and the most of these.
inline std::string read_digits(const std::string& text, BarRules& rules) {
    int least = most_bar_text;
    int most = 0;
    for (const std::string& word : split(text, ',')) {
        const Result<Decimal> number = parse_decimal(span_of(word));
        const std::int64_t count = number ? number->millionths / 1000000 : 0;
        if (!number || number->millionths % 2000000 != 0 || count < 2 || count > most_bar_text)
            return "--digits takes even numbers from 2 to " + std::to_string(most_bar_text) +
                   " such as 14, not '" + one_line(text) + "'";
        least = std::min(least, static_cast<int>(count));
        most = std::max(most, static_cast<int>(count));
    }
    rules.interleaved_shortest = least;
    rules.interleaved_longest = most;
    return "";
}

/// The texts of a file, one on each line.
template <class Io>
std::string read_allowed(Io& io, const std::string& name, CodeRule& allowed) {
    const Result<Span<const std::uint8_t>> bytes = io.storage().load(name.c_str());
    if (!bytes) return "--allowed-file " + file_problem(name, bytes.status(), io.storage());
    const std::string text(reinterpret_cast<const char*>(bytes->data()),
                           static_cast<std::size_t>(bytes->size()));
    for (std::string line : split(text, '\n')) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (!line.empty()) allowed.allow(line);
    }
    return allowed.empty() ? "--allowed-file " + name + ": no text stands in it" : "";
}

/// The job of --job, which leaves nothing of what it says to other options.
template <class Io>
std::string read_job_option(Io& io, const Arguments& arguments, ReadSettings& settings) {
    for (const char* const other : {"symbology", "most", "quick", "add-on", "ascii", "check", "digits",
                                    "allowed", "allowed-file", "pattern", "unique"})
        if (arguments.has(other))
            return std::string("--") + other + " has no meaning beside --job, which says it";
    const std::string name = arguments.value("job");
    const Result<Span<const std::uint8_t>> bytes = io.storage().load(name.c_str());
    if (!bytes) return "--job " + file_problem(name, bytes.status(), io.storage());
    const CodeJobFile file = read_code_job(std::string(bytes->begin(), bytes->end()));
    if (!file.problem.empty())
        return "--job " + name + ":" + std::to_string(file.place.line) + ":" +
               std::to_string(file.place.column) + ": " + file.problem;
    if (!file.found) return "--job " + name + ": there is no [codes] in it";
    settings.by_job = true;
    settings.job = file.job;
    return file.job.taught ? "--job " + name + ": with taught = true only fovead knows what is allowed" : "";
}

template <class Io>
std::string read_settings(Io& io, const Arguments& arguments, ReadSettings& settings) {
    settings.json = arguments.has("json");
    settings.raw = arguments.has("raw");
    settings.unique = arguments.has("unique");
    settings.prefix = arguments.value("prefix");
    settings.suffix = arguments.value("suffix");
    settings.explain_name = arguments.value("explain");
    settings.codes.thorough = !arguments.has("quick");
    BarRules& rules = settings.codes.rules;
    if (arguments.has("add-on")) rules.add_on = AddOn::appended;
    if (arguments.has("ascii")) rules.code_39_text = Code39Text::full_ascii;
    if (arguments.has("check"))
        rules.code_39_check = rules.interleaved_check = rules.codabar_check = CheckCharacter::required;
    if (settings.json && settings.raw) return "--json and --raw are two ways to say it; give one";
    std::string problem;
    if (arguments.has("symbology"))
        problem = read_symbologies(arguments.value("symbology"), settings.codes.symbologies);
    if (problem.empty() && arguments.has("digits")) problem = read_digits(arguments.value("digits"), rules);
    if (problem.empty()) whole_option(arguments, "most", 1, 1000, settings.codes.most_codes, problem);
    if (arguments.has("allowed")) settings.allowed.allow(arguments.value("allowed"));
    CodePattern pattern;
    if (problem.empty() && arguments.has("pattern")) {
        problem = pattern.read(arguments.value("pattern"));
        if (!problem.empty()) return "--pattern: " + problem;
        settings.allowed.allow(pattern);
    }
    if (problem.empty() && arguments.has("allowed-file"))
        problem = read_allowed(io, arguments.value("allowed-file"), settings.allowed);
    if (problem.empty() && arguments.has("job")) problem = read_job_option(io, arguments, settings);
    settings.judges = settings.by_job || arguments.has("allowed") || arguments.has("allowed-file") ||
                      arguments.has("pattern");
    return problem;
}

/// What bytes of the texts of an image may be: two of the largest symbols are less.
inline constexpr int text_room = 65536;

/// Reads the codes of a picture, in the order in which a page is read.
inline Status read_picture(const Picture<Gray8>& image, const ReadCodesOptions& options,
                           std::vector<ReadCode>& read) {
    // Not set to 0, which takes as long as a small picture.
    const auto scratch_bytes = static_cast<std::ptrdiff_t>(read_codes_scratch(image.size));
    const std::unique_ptr<std::uint8_t[]> scratch(new std::uint8_t[static_cast<std::size_t>(scratch_bytes)]);
    const std::unique_ptr<std::uint8_t[]> room(new std::uint8_t[text_room]);
    std::vector<Code> codes(static_cast<std::size_t>(options.most_codes));
    int count = 0;
    CodeText text({room.get(), text_room});
    const Status status = read_codes(image.view(), options, {scratch.get(), scratch_bytes}, text,
                                     ListView<Code>(codes.data(), options.most_codes, &count));
    for (int i = 0; i < count; ++i) {
        const Code& code = codes[static_cast<std::size_t>(i)];
        std::vector<std::uint8_t> utf8(static_cast<std::size_t>(text_utf8_room(code.text_size)));
        const std::uint8_t* first = room.get() + code.text_first;
        ReadCode one{code, "", std::string(first, first + code.text_size)};
        const Result<int> size = text_utf8(text, code.text_first, code.text_size,
                                           {utf8.data(), static_cast<std::ptrdiff_t>(utf8.size())});
        one.text = size ? std::string(utf8.begin(), utf8.begin() + *size) : one.bytes;
        read.push_back(one);
    }
    return status;
}

/// A picture with a frame around each code and a cross where reading begins. What of them lies outside is not
/// drawn.
inline Picture<Rgb888> explain_codes(const Picture<Gray8>& image, const std::vector<ReadCode>& read) {
    Picture<Rgb888> picture(image.size);
    for (int y = 0; y < image.size.height; ++y)
        for (int x = 0; x < image.size.width; ++x) {
            const Gray8 level = image.view()(x, y);
            picture.view()(x, y) = {level, level, level};
        }
    const Rgb888 colour{0, 220, 60};
    for (const ReadCode& one : read) {
        Point corners[4];
        for (int i = 0; i < 4; ++i)
            corners[i] = {one.code.corners[i].x.round(), one.code.corners[i].y.round()};
        for (int i = 0; i < 4; ++i)
            static_cast<void>(draw_line(picture.view(), corners[i], corners[(i + 1) % 4], colour));
        static_cast<void>(draw_cross(picture.view(), corners[0], 6, colour));
    }
    return picture;
}

template <class Io>
class CodeReader {
public:
    CodeReader(Io& io, const ReadSettings& settings, bool names_images)
        : io_(io), settings_(settings), names_images_(names_images) {}

    ExitCode read(const std::string& name, const std::string& explain_name) {
        Picture<Gray8> image;
        std::string problem;
        if (!load_picture(io_.storage(), name, max_image_side, image, problem)) {
            io_.complain(problem);
            if (settings_.json)
                io_.print(json_no_code(name, problem.substr(std::min(problem.size(), name.size() + 2))));
            return exit_failed;
        }
        std::vector<ReadCode> read;
        ExitCode code = exit_ok;
        if (settings_.by_job) code = judge(name, image, read);
        const Status status = settings_.by_job ? Status::ok : read_picture(image, settings_.codes, read);
        if (read.empty() && !settings_.by_job) {
            const std::string why = nothing_read(status);
            io_.complain(name + ": " + why);
            if (settings_.json) io_.print(json_no_code(name, why));
            code = status == Status::not_found || status == Status::undecided ? exit_not_ok : exit_failed;
        }
        for (std::size_t i = 0; i < read.size() && !settings_.by_job; ++i)
            code = worse(code, tell(name, static_cast<int>(i), read[i]));
        if (!explain_name.empty() &&
            !save_picture(io_.storage(), explain_name, explain_codes(image, read), problem)) {
            io_.complain(problem);
            code = exit_failed;
        }
        return code;
    }

private:
    static std::string nothing_read(Status status) {
        if (status == Status::not_found)
            return "no code was read; is it sharp, lit evenly and whole, with its quiet zone?";
        if (status == Status::undecided)
            return "a code was seen, and its lines do not agree well enough to tell it";
        return describe(status);
    }
    /// As the daemon does, picture by picture.
    ExitCode judge(const std::string& name, const Picture<Gray8>& image, std::vector<ReadCode>& read) {
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(read_job_scratch(settings_.job.looked_at(image.size))));
        const CodesVerdict found = judge_.judge(
            image.view(), settings_.job, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
        if (found.verdict == Verdict::ok) judge_.remember();
        for (const CodeReading& reading : judge_.codes()) {
            read.push_back({reading.code, string_of(reading.text),
                            std::string(reading.bytes.begin(), reading.bytes.end())});
            print_code(name, static_cast<int>(read.size()) - 1, read.back(),
                       reading.fault[0] == '\0' ? "OK" : "NG");
        }
        if (found.verdict == Verdict::ok) return exit_ok;
        io_.complain(name + ": " + found.reason);
        if (settings_.json && read.empty()) io_.print(json_no_code(name, found.reason));
        return found.verdict == Verdict::unmeasured ? exit_failed : exit_not_ok;
    }
    ExitCode tell(const std::string& name, int index, const ReadCode& read) {
        const bool allowed = settings_.allowed.allows(span_of(read.text));
        const std::string verdict = !settings_.judges ? "" : allowed ? "OK" : "NG";
        if (settings_.unique) {
            const std::string key = human_code(read);
            if (std::find(told_.begin(), told_.end(), key) != told_.end())
                return allowed ? exit_ok : exit_not_ok;
            told_.push_back(key);
        }
        print_code(name, index, read, verdict);
        return allowed ? exit_ok : exit_not_ok;
    }
    void print_code(const std::string& name, int index, const ReadCode& read, const std::string& verdict) {
        ReadCode shown = read;
        shown.text = settings_.prefix + read.text + settings_.suffix;
        if (settings_.json)
            io_.print(json_code(name, index, shown, verdict));
        else if (settings_.raw)
            io_.print(settings_.prefix + read.bytes + settings_.suffix + "\n");
        else
            io_.print((names_images_ ? one_line(name) + ": " : "") + (verdict.empty() ? "" : verdict + " ") +
                      human_code(shown) + "\n");
    }

    Io& io_;
    const ReadSettings& settings_;
    bool names_images_;
    std::vector<std::string> told_;
    CodeJudge judge_;
};

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode read_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(read_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(read_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    const std::vector<std::string>& images = arguments.operands();
    detail::ReadSettings settings;
    if (problem.empty() && images.empty()) problem = "which picture? give at least one IMAGE";
    if (problem.empty()) problem = detail::read_settings(io, arguments, settings);
    const auto picture_of = [&](std::size_t i) {
        const std::string& name = settings.explain_name;
        return name.empty() || images.size() == 1 ? name : numbered(name, i);
    };
    if (problem.empty() && settings.explain_name == "-")
        problem = "--explain writes a file; the standard output has the results";
    if (const std::string refusal = picture_name_problem(settings.explain_name);
        problem.empty() && !refusal.empty())
        problem = "--explain " + refusal;
    for (std::size_t i = 0; problem.empty() && i < images.size(); ++i)
        if (const std::string picture = picture_of(i);
            std::find(images.begin(), images.end(), picture) != images.end())
            problem = "--explain would overwrite " + picture + "; give another name";
    if (!problem.empty()) {
        io.complain("fovea read: " + problem);
        return exit_failed;
    }
    detail::CodeReader<Io> reader(io, settings, images.size() > 1);
    ExitCode code = exit_ok;
    for (std::size_t i = 0; i < images.size(); ++i) code = worse(code, reader.read(images[i], picture_of(i)));
    return code;
}

}  // namespace fovea::apps
