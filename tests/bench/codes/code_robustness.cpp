// SPDX-License-Identifier: MIT
//
// Draws codes under one disturbance at a time, each stronger from level to level, and counts what fovea and
// the readers that are installed read of them and what they misread. The same pictures on every run.
//
// usage: code_robustness [--count N] [--only WORD]... [--reader NAME] [--csv FILE]
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <bench/codes/drawn_code.hpp>
#include <read/read_command.hpp>
#include <support/foreign_readers.hpp>

namespace {

using namespace fovea;
using test::CodeReader;
using test::CodeView;
using test::Texts;

/// A kind of code, and how many characters a text of it has.
struct Kind {
    const char* name;
    Symbology symbology;
    const char* letters;
    int shortest;
    int longest;
    int version = 1;  ///< of QR
    Size size{};      ///< of Data Matrix
};
const char* const digits = "0123456789";
const char* const capitals = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ-. ";
const char* const signs = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-./:?&=";
const Kind kinds[] = {{"EAN-13", Symbology::ean_13, digits, 12, 12},
                      {"UPC-E", Symbology::upc_e, digits, 6, 6},
                      {"Code 128", Symbology::code_128, signs, 6, 16},
                      {"Code 39", Symbology::code_39, capitals, 4, 10},
                      {"Interleaved 2 of 5", Symbology::interleaved_2_of_5, digits, 8, 14},
                      {"QR version 2", Symbology::qr, signs, 20, 24, 2},
                      {"QR version 7", Symbology::qr, signs, 100, 118, 7},
                      {"Data Matrix 16x16", Symbology::data_matrix, signs, 8, 10, 1, {16, 16}},
                      {"Data Matrix 24x24", Symbology::data_matrix, signs, 26, 34, 1, {24, 24}}};
/// Bars that are no code: runs of one to four modules, or of one and three.
const char* const no_code = "bars that are no code";

/// A level of a disturbance: what is drawn, and the number that stands for it.
struct Level {
    double value;
    CodeView view;
};
struct Disturbance {
    std::string name;
    std::string unit;
    std::vector<Level> levels;
};

/// Levels of one property of a view.
Disturbance levels_of(const char* name, const char* unit, double CodeView::*property,
                      const std::vector<double>& values, const CodeView& view = {}) {
    Disturbance result{name, unit, {}};
    for (const double value : values) {
        Level level{value, view};
        level.view.*property = value;
        result.levels.push_back(level);
    }
    return result;
}

std::vector<Disturbance> disturbances() {
    std::vector<Disturbance> all;
    for (const double module : {1.0, 1.25, 1.5, 2.0, 3.0, 4.0}) {
        CodeView view;
        view.module = module;
        char name[40];
        std::snprintf(name, sizeof name, "blur at %g px", module);
        all.push_back(levels_of(name, "modules", &CodeView::blur,
                                {0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.2}, view));
    }
    all.push_back(levels_of("noise", "grey levels", &CodeView::noise, {0, 5, 10, 15, 20, 30, 40, 60}));
    all.push_back(levels_of("contrast", "grey levels", &CodeView::contrast, {100, 50, 30, 20, 15, 10, 7, 5}));
    all.push_back(levels_of("uneven light", "times", &CodeView::light_ratio, {1, 2, 4, 8, 16, 32}));
    all.push_back(
        levels_of("rotation", "degrees", &CodeView::degrees, {0, 3, 7, 10, 15, 20, 25, 30, 35, 40, 45}));
    all.push_back(levels_of("perspective", "degrees", &CodeView::tilt, {0, 15, 25, 35, 45, 55, 65}));
    all.push_back(levels_of("curvature", "degrees", &CodeView::bend, {0, 15, 25, 35, 45, 55, 65, 75}));
    all.push_back(levels_of("torn", "share", &CodeView::torn, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}));
    all.push_back(levels_of("cut off", "share", &CodeView::cut, {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
    return all;
}

#ifdef FOVEA_HAVE_ZXING
/// Reads in a process of its own: version 1.4 of zxing-cpp ends the program at some codes, which then are not
/// read.
Texts read_apart(const apps::Picture<Gray8>& picture, Texts (*read)(const apps::Picture<Gray8>&)) {
    int ends[2] = {};
    if (pipe(ends) != 0) return {};
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        static_cast<void>(std::freopen("/dev/null", "w", stderr));
        for (const std::string& text : read(picture))
            static_cast<void>(write(ends[1], text.c_str(), text.size() + 1) >= 0);
        _exit(0);
    }
    close(ends[1]);
    Texts texts;
    std::string text;
    char bytes[256];
    for (ssize_t count = 0; (count = ::read(ends[0], bytes, sizeof bytes)) > 0;) {
        for (ssize_t i = 0; i < count; ++i) {
            if (bytes[i] != '\0') {
                text += bytes[i];
                continue;
            }
            texts.push_back(text);
            text.clear();
        }
    }
    close(ends[0]);
    if (child > 0) waitpid(child, nullptr, 0);
    return texts;
}
#endif

std::vector<CodeReader> readers() {
    std::vector<CodeReader> result = {{"fovea", [](const apps::Picture<Gray8>& picture) {
                                           std::vector<apps::ReadCode> codes;
                                           static_cast<void>(apps::detail::read_picture(picture, {}, codes));
                                           Texts texts;
                                           for (const apps::ReadCode& code : codes)
                                               texts.push_back(code.text);
                                           return texts;
                                       }}};
#ifdef FOVEA_HAVE_ZXING
    result.push_back({"zxing-cpp", [](const apps::Picture<Gray8>& picture) {
                          return read_apart(picture, test::read_one_with_zxing);
                      }});
#endif
#ifdef FOVEA_HAVE_ZBAR
    result.push_back(test::zbar_reader("zbar"));
#endif
#ifdef FOVEA_HAVE_DMTX
    result.push_back(
        {"libdmtx", [](const apps::Picture<Gray8>& picture) { return test::read_with_dmtx(picture, 1000); }});
#endif
    return result;
}
/// Whether a reader knows a symbology: what it does not know is not asked of it.
bool knows(const CodeReader& reader, const Kind* kind) {
    const std::string name = reader.name;
    if (name == "libdmtx") return kind != nullptr && kind->symbology == Symbology::data_matrix;
    if (name == "zbar") return kind == nullptr || kind->symbology != Symbology::data_matrix;
    return true;
}

bool is_ours(const CodeReader& reader) { return std::string(reader.name) == "fovea"; }

/// A number for a word, the same everywhere: FNV-1a.
std::uint64_t hash_of(const std::string& word) {
    std::uint64_t hash = 14695981039346656037U;
    for (const char c : word) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    return hash;
}

/// A random text of a kind with its modules. What may be told of it: a UPC-E is a UPC-A and an EAN-13 too.
struct Sample {
    apps::CodeModules modules;
    Texts truths;
};
std::string with_check_digit(std::string text) {
    std::vector<std::uint8_t> values;
    for (const char c : text) values.push_back(static_cast<std::uint8_t>(c - '0'));
    return text + static_cast<char>(
                      '0' + ean_check_digit({values.data(), static_cast<std::ptrdiff_t>(values.size())}));
}
std::string expanded(const std::string& upc_e) {
    std::uint8_t of_e[8] = {};
    std::uint8_t of_a[12] = {};
    for (std::size_t i = 0; i < 7; ++i) of_e[i] = static_cast<std::uint8_t>(upc_e[i] - '0');
    upc_a_of_upc_e(of_e, of_a);
    std::string text;
    for (int i = 0; i < 11; ++i) text += static_cast<char>('0' + of_a[i]);
    return with_check_digit(text);
}
Sample random_sample(const Kind& kind, Random& random) {
    Sample sample;
    std::string text = kind.symbology == Symbology::upc_e ? "0" : "";
    int length = random.between(kind.shortest, kind.longest);
    if (kind.symbology == Symbology::interleaved_2_of_5) length &= ~1;
    const auto letters = static_cast<std::uint32_t>(std::strlen(kind.letters));
    for (int i = 0; i < length; ++i) text += kind.letters[random.below(letters)];
    // A blank at an end is lost by some readers.
    for (char* end : {&text.front(), &text.back()})
        if (*end == ' ') *end = '7';
    apps::CodeDesign design;
    design.symbology = kind.symbology;
    design.qr.min_version = kind.version;
    design.data_matrix.size = kind.size;
    if (const std::string problem = apps::modules_of(text, design, sample.modules); !problem.empty()) {
        std::fprintf(stderr, "code_robustness: %s\n", problem.c_str());
        std::exit(1);
    }
    if (kind.symbology == Symbology::upc_e) {
        const std::string upc_a = expanded(text);
        sample.truths = {text + upc_a.back(), upc_a, "0" + upc_a};
    } else if (kind.symbology == Symbology::ean_13) {
        sample.truths = {with_check_digit(text)};
        if (text[0] == '0') sample.truths.push_back(sample.truths[0].substr(1));
    } else {
        sample.truths = {text};
    }
    return sample;
}
Sample random_bars(Random& random) {
    Sample sample;
    const bool two_widths = random.below(2) == 0;
    const int runs = 2 * random.between(12, 40) + 1;
    for (int i = 0; i < runs; ++i) {
        const int width = two_widths ? 1 + 2 * random.between(0, 1) : random.between(1, 4);
        sample.modules.dark.insert(sample.modules.dark.end(), static_cast<std::size_t>(width),
                                   static_cast<std::uint8_t>(i % 2 == 0 ? 1 : 0));
    }
    sample.modules.size = {static_cast<int>(sample.modules.dark.size()), 1};
    sample.modules.quiet = 10;
    sample.modules.bars = true;
    return sample;
}

struct Score {
    int read = 0;
    int misread = 0;
};

class Sheet {
public:
    Sheet(int count, const std::string& reader, std::FILE* csv) : count_(count), csv_(csv) {
        for (const CodeReader& one : readers())
            if (reader.empty() || one.name == reader) readers_.push_back(one);
        if (csv_ != nullptr) std::fprintf(csv_, "code,disturbance,level,unit,reader,pictures,read,misread\n");
    }

    /// kind is null for bars that are no code.
    void measure(const Kind* kind, const Disturbance& disturbance) {
        const char* code = kind != nullptr ? kind->name : no_code;
        std::printf("\n%s, %s (%s)\n%-12s", code, disturbance.name.c_str(), disturbance.unit.c_str(), "");
        for (const Level& level : disturbance.levels) std::printf(" %9g", level.value);
        std::printf("\n");
        std::vector<std::vector<Score>> scores(readers_.size());
        for (const Level& level : disturbance.levels) {
            const std::vector<Score> row = measure_level(kind, disturbance, level);
            for (std::size_t i = 0; i < readers_.size(); ++i) scores[i].push_back(row[i]);
        }
        for (std::size_t i = 0; i < readers_.size(); ++i) {
            if (!knows(readers_[i], kind)) continue;
            std::printf("%-12s", readers_[i].name);
            for (std::size_t k = 0; k < scores[i].size(); ++k) {
                const Score& score = scores[i][k];
                char cell[24];
                std::snprintf(cell, sizeof cell, score.misread > 0 ? "%d (-%d)" : "%d", score.read,
                              score.misread);
                std::printf(" %9s", cell);
                misread_ += is_ours(readers_[i]) ? score.misread : 0;
                if (csv_ != nullptr)
                    std::fprintf(csv_, "%s,%s,%g,%s,%s,%d,%d,%d\n", code, disturbance.name.c_str(),
                                 disturbance.levels[k].value, disturbance.unit.c_str(), readers_[i].name,
                                 count_, score.read, score.misread);
            }
            std::printf("\n");
        }
        std::fflush(stdout);
        if (csv_ != nullptr) std::fflush(csv_);
    }
    /// Texts that fovea has told and that were not there.
    int misread() const { return misread_; }

private:
    std::vector<Score> measure_level(const Kind* kind, const Disturbance& disturbance, const Level& level) {
        std::vector<Score> scores(readers_.size());
        const std::string name = std::string(kind != nullptr ? kind->name : no_code) + disturbance.name;
        const auto thousandths = static_cast<std::uint64_t>(level.value * 1000 + 0.5);
        for (int i = 0; i < count_; ++i) {
            Random random(hash_of(name) + thousandths, static_cast<std::uint64_t>(i));
            const Sample sample = kind != nullptr ? random_sample(*kind, random) : random_bars(random);
            CodeView view = level.view;
            // Anywhere between pixels, and not quite upright.
            view.x += random.between(-500, 500) / 1000.0;
            view.y += random.between(-500, 500) / 1000.0;
            view.degrees += random.between(-2000, 2000) / 1000.0;
            const apps::Picture<Gray8> picture = test::draw_code(sample.modules, view, random);
            for (std::size_t reader = 0; reader < readers_.size(); ++reader) {
                if (!knows(readers_[reader], kind)) continue;
                take(readers_[reader].read(picture), sample, scores[reader],
                     is_ours(readers_[reader])
                         ? name + " " + std::to_string(level.value) + " #" + std::to_string(i)
                         : "");
            }
        }
        return scores;
    }
    static void take(const Texts& texts, const Sample& sample, Score& score, const std::string& place) {
        bool right = false;
        bool wrong = false;
        for (const std::string& text : texts) {
            const bool same =
                std::find(sample.truths.begin(), sample.truths.end(), text) != sample.truths.end();
            right = right || same;
            wrong = wrong || !same;
            if (!same && !place.empty())
                std::fprintf(stderr, "misread: %s: '%s' for '%s'\n", place.c_str(), text.c_str(),
                             sample.truths.empty() ? "" : sample.truths[0].c_str());
        }
        score.read += right ? 1 : 0;
        score.misread += wrong ? 1 : 0;
    }

    int count_;
    std::FILE* csv_;
    std::vector<CodeReader> readers_;
    int misread_ = 0;
};

bool wanted(const std::vector<std::string>& only, const std::string& name) {
    return only.empty() || std::any_of(only.begin(), only.end(), [&](const std::string& word) {
               return name.find(word) != std::string::npos;
           });
}

}  // namespace

int main(int count, char** words) {
    int pictures = 20;
    std::vector<std::string> only;
    std::string reader;
    std::FILE* csv = nullptr;
    for (int i = 1; i < count; i += 2) {
        const std::string word = words[i];
        if (i + 1 < count && word == "--count")
            pictures = std::atoi(words[i + 1]);
        else if (i + 1 < count && word == "--only")
            only.push_back(words[i + 1]);
        else if (i + 1 < count && word == "--reader")
            reader = words[i + 1];
        else if (i + 1 < count && word == "--csv")
            csv = std::fopen(words[i + 1], "w");
        else
            pictures = 0;
        if (pictures <= 0 || (word == "--csv" && csv == nullptr)) {
            std::fprintf(stderr,
                         "usage: code_robustness [--count N] [--only WORD]... [--reader NAME] [--csv FILE]\n"
                         "  WORD  a part of \"CODE, DISTURBANCE\", such as \"UPC-E, blur\"\n");
            return 2;
        }
    }
    Sheet sheet(pictures, reader, csv);
    for (const Disturbance& disturbance : disturbances()) {
        for (const Kind& kind : kinds)
            if (wanted(only, std::string(kind.name) + ", " + disturbance.name))
                sheet.measure(&kind, disturbance);
        if (wanted(only, std::string(no_code) + ", " + disturbance.name)) sheet.measure(nullptr, disturbance);
    }
    if (csv != nullptr) std::fclose(csv);
    std::printf("\nfovea misread %d pictures\n", sheet.misread());
    return sheet.misread() > 0 ? 1 : 0;
}
