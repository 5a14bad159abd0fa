// SPDX-License-Identifier: MIT
//
// Reads the photo sets of codes with fovea and with the readers that are installed, picture by picture in
// turn, and prints how many each reads at every quarter turn, how often it says something else, and the
// median of the times of the processor that it takes.
//
// usage: code_readers [SET...]
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include <read/read_command.hpp>
#include <support/code_photos.hpp>
#include <support/foreign_readers.hpp>

namespace {

using namespace fovea;
using test::CodeReader;
using test::Photo;
using test::Texts;

Texts read_with_fovea(const apps::Picture<Gray8>& picture, int most_codes) {
    std::vector<apps::ReadCode> codes;
    ReadCodesOptions options;
    options.most_codes = most_codes;
    static_cast<void>(apps::detail::read_picture(picture, options, codes));
    Texts texts;
    for (const apps::ReadCode& code : codes) texts.push_back(code.text);
    return texts;
}

std::vector<CodeReader> readers() {
    std::vector<CodeReader> result = {
        {"fovea, one code", [](const apps::Picture<Gray8>& picture) { return read_with_fovea(picture, 1); }},
        {"fovea, all codes",
         [](const apps::Picture<Gray8>& picture) { return read_with_fovea(picture, 32); }}};
#ifdef FOVEA_HAVE_ZXING
    result.push_back({"zxing-cpp, one code", test::read_one_with_zxing});
    result.push_back({"zxing-cpp, all codes", test::read_with_zxing});
#endif
#ifdef FOVEA_HAVE_ZBAR
    result.push_back(test::zbar_reader("zbar, all codes"));
#endif
    return result;
}

/// Readers differ in whether a UPC-A has the leading zero of its EAN-13, and whether a UPC-E is told as
/// UPC-A.
bool same(const std::string& text, const std::string& truth) {
    const std::string read = test::plain(text);
    return read == truth || (truth.size() == 12 && read == "0" + truth);
}

/// Time of the processor that this program has taken: what else runs does not count.
double processor_ms() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) / 1e6;
}

struct Score {
    int read[4] = {};
    int other = 0;
    std::vector<double> milliseconds;

    void add(const Score& more) {
        for (int turn = 0; turn < 4; ++turn) read[turn] += more.read[turn];
        other += more.other;
        milliseconds.insert(milliseconds.end(), more.milliseconds.begin(), more.milliseconds.end());
    }
};

void tell(const std::string& set, const std::vector<CodeReader>& all, std::vector<Score> scores) {
    for (std::size_t i = 0; i < all.size(); ++i) {
        Score& score = scores[i];
        std::sort(score.milliseconds.begin(), score.milliseconds.end());
        std::printf("| %s | %zu | %s | %d / %d / %d / %d | %d | %.2f | %.1f |\n", i == 0 ? set.c_str() : "",
                    score.milliseconds.size() / 4, all[i].name, score.read[0], score.read[1], score.read[2],
                    score.read[3], score.other, score.milliseconds[score.milliseconds.size() / 2],
                    score.milliseconds.back());
        std::fflush(stdout);
    }
}

/// Adds to the total.
void measure(const std::string& set, const std::vector<CodeReader>& all, std::vector<Score>& total) {
    std::vector<Photo> pictures = test::photos(set);
    if (pictures.empty()) return;
    std::vector<Score> scores(all.size());
    for (int turn = 0; turn < 4; ++turn) {
        for (Photo& photo : pictures) {
            for (std::size_t i = 0; i < all.size(); ++i) {
                const double start = processor_ms();
                const Texts texts = all[i].read(photo.picture);
                scores[i].milliseconds.push_back(processor_ms() - start);
                const bool right =
                    !photo.text.empty() && std::any_of(texts.begin(), texts.end(),
                                                       [&](const auto& t) { return same(t, photo.text); });
                scores[i].read[turn] += right ? 1 : 0;
                for (const std::string& text : texts) scores[i].other += same(text, photo.text) ? 0 : 1;
            }
            photo.picture = test::turned(photo.picture);
        }
    }
    for (std::size_t i = 0; i < all.size(); ++i) total[i].add(scores[i]);
    tell(set, all, scores);
}

}  // namespace

int main(int count, char** words) {
    std::vector<std::string> sets(words + 1, words + count);
    if (sets.empty()) {
        const auto folder = test::data_folder() / "codes";
        if (!std::filesystem::exists(folder)) {
            std::fprintf(stderr, "code_readers: no photos in %s; FOVEA_TEST_DATA names their folder\n",
                         folder.c_str());
            return 1;
        }
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            sets.push_back(entry.path().filename().string());
        std::sort(sets.begin(), sets.end());
    }
    std::printf(
        "| set | pictures | reader | read at 0 / 90 / 180 / 270 degrees | other texts | ms, median | ms, "
        "most |\n"
        "|---|---|---|---|---|---|---|\n");
    const std::vector<CodeReader> all = readers();
    std::vector<Score> total(all.size());
    for (const std::string& set : sets) measure(set, all, total);
    if (!total[0].milliseconds.empty()) tell("all sets", all, total);
}
