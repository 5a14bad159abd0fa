// SPDX-License-Identifier: MIT
//
// Runs cases and prints what they took.
#include <bench/harness.hpp>
#include <bench/memory.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <regex>

#include <fovea/image/image_view.hpp>

#include <fovea/simd/lanes.hpp>

#if defined(FOVEA_HAVE_OPENCV)
#include <opencv2/core/utility.hpp>
#endif

namespace fovea::bench {
namespace {

constexpr double batch_nanoseconds = 150e3;
constexpr double row_nanoseconds = 0.4e9;
constexpr int most_rounds = 101;
constexpr int least_rounds = 7;

struct Case {
    int order;
    std::string name;
    Sizes sizes;
    SetUp set_up;
};

std::vector<Case>& cases() {
    static std::vector<Case> all;
    return all;
}

double now() {
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double timed(const std::function<void()>& run, int calls) {
    const double start = now();
    for (int i = 0; i < calls; ++i) run();
    return now() - start;
}

double median(std::vector<double> samples) {
    const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
    std::nth_element(samples.begin(), middle, samples.end());
    return *middle;
}

/// Fills in the median of every column.
void measure(std::vector<Column>& columns) {
    std::vector<int> calls;
    std::vector<std::vector<double>> samples(columns.size());
    for (const Column& column : columns) {
        column.run();
        calls.push_back(1 + static_cast<int>(batch_nanoseconds / std::max(timed(column.run, 1), 1.0)));
    }
    const double start = now();
    for (int round = 0; round < most_rounds; ++round) {
        if (round >= least_rounds && now() - start > row_nanoseconds) break;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            columns[i].run();
            samples[i].push_back(timed(columns[i].run, calls[i]) / calls[i]);
        }
    }
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].nanoseconds = median(samples[i]);
}

/// What is measured of a row, as it is printed.
struct Figures {
    std::string name;
    std::string size;  ///< empty where figures per pixel would say nothing
    double pixels = 1;
    double ours = 0;
    double copy = 0;  ///< of the bytes that must be moved
    double theirs = 0;
    std::string peer;
    std::string remark;
    bool of_windows = false;
};

Figures measured(const Case& one, Size size) {
    Row row(size);
    one.set_up(row);
    std::vector<Column>& columns = row.columns();
    if (columns.empty()) {
        std::fprintf(stderr, "fovea_bench: %s times nothing\n", one.name.c_str());
        std::exit(2);
    }
    const auto bytes = static_cast<std::size_t>(row.moved_bytes() / 2);
    const Bytes from(bytes, 1);
    Bytes to(bytes, 2);
    columns.push_back({"memcpy", [&] {
                           std::memcpy(to.data(), from.data(), bytes);
                           consume(to);
                       }});
    measure(columns);
    Figures figures;
    figures.name = one.name;
    if (row.per_pixel()) {
        figures.size = std::to_string(size.width) + "x" + std::to_string(size.height);
        figures.pixels = static_cast<double>(size.area());
    }
    figures.ours = columns.front().nanoseconds;
    figures.copy = columns.back().nanoseconds;
    if (columns.size() > 2) {
        figures.theirs = columns[1].nanoseconds;
        figures.peer = columns[1].name;
    }
    figures.remark = row.remark();
    figures.of_windows = one.sizes == Sizes::windows;
    return figures;
}

// ---- What is printed ----------------------------------------------------------------------

/// A string of JSON. Names and remarks hold no control characters.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

void print_json(const Figures& f) {
    std::printf("{\"operator\":%s", quoted(f.name).c_str());
    if (f.of_windows) std::printf(",\"table\":\"windows\"");
    if (f.size.empty())
        std::printf(",\"ns\":%.1f", f.ours);
    else
        std::printf(",\"size\":\"%s\",\"ns\":%.1f,\"ns_per_px\":%.4f,\"memcpy_ratio\":%.3f", f.size.c_str(),
                    f.ours, f.ours / f.pixels, f.ours / f.copy);
    if (!f.peer.empty()) {
        std::printf(",\"peer\":%s,\"peer_ns\":%.1f", quoted(f.peer).c_str(), f.theirs);
        if (f.peer.rfind("OpenCV", 0) == 0) std::printf(",\"opencv_ratio\":%.3f", f.theirs / f.ours);
    }
    if (!f.remark.empty()) std::printf(",\"remark\":%s", quoted(f.remark).c_str());
    std::printf("}\n");
}

void print_row(const Figures& f) {
    std::printf("%-46s %-10s %10.4f", f.name.c_str(), f.size.c_str(), f.ours / 1e6);
    if (f.size.empty())
        std::printf(" %9s %8s", "", "");
    else
        std::printf(" %9.3f %8.2f", f.ours / f.pixels, f.ours / f.copy);
    if (!f.peer.empty()) std::printf(" %8.2f  %s", f.theirs / f.ours, f.peer.c_str());
    std::printf("\n");
    if (!f.remark.empty()) std::printf("    %s\n", f.remark.c_str());
}

/// The geometric mean of the ratios to OpenCV, which one operator among many does not rule.
class Mean {
public:
    void take(const Figures& f) {
        if (f.peer.rfind("OpenCV", 0) != 0 || f.of_windows) return;
        logarithms_ += std::log(f.theirs / f.ours);
        count_ += 1;
        behind_ += f.theirs < f.ours;
    }
    void print() const {
        if (count_ > 0)
            std::printf("\n%d rows beside OpenCV: %.2f times as fast in the geometric mean, %d rows slower\n",
                        count_, std::exp(logarithms_ / count_), behind_);
    }

private:
    double logarithms_ = 0;
    int count_ = 0;
    int behind_ = 0;
};

// ---- What is asked for --------------------------------------------------------------------

constexpr const char* help = R"(usage: fovea_bench [--filter REGEX] [--size WxH]... [--json] [--list]

Times operators of fovea beside memcpy of the bytes that they must move and beside OpenCV (one thread),
libjpeg-turbo or libpng, where these were found when it was built. The columns of a row take turns; what is
printed are medians.

  --filter REGEX   only the rows whose name the expression matches somewhere
  --size WxH       at this size, not at 640x480 and 1920x1080; may be given again
  --json           one line of JSON a row
  --list           the names, without timing anything
  --help           this text
)";

struct Options {
    std::regex filter{""};
    std::vector<Size> sizes;
    bool json = false;
    bool list = false;
};

[[noreturn]] void fail(const std::string& problem) {
    std::fprintf(stderr, "fovea_bench: %s; try --help\n", problem.c_str());
    std::exit(2);
}

Size size_of(const std::string& word) {
    Size size;
    char rest = 0;
    if (std::sscanf(word.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2 || size.width < 160 ||
        size.height < 120 || size.width > max_image_side || size.height > max_image_side)
        fail("--size: '" + word + "' is not like 640x480, from 160x120");
    return size;
}

Options options_of(int count, char** words) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const auto value = [&]() -> std::string {
            if (i + 1 == count) fail(word + " wants a value");
            return words[++i];
        };
        if (word == "--help") {
            std::fputs(help, stdout);
            std::exit(0);
        } else if (word == "--json") {
            options.json = true;
        } else if (word == "--list") {
            options.list = true;
        } else if (word == "--size") {
            options.sizes.push_back(size_of(value()));
        } else if (word == "--filter") {
            const std::string expression = value();
            try {
                options.filter = std::regex(expression);
            } catch (const std::regex_error&) {
                fail("--filter: '" + expression + "' is no regular expression");
            }
        } else {
            fail("'" + word + "' is not an option");
        }
    }
    return options;
}

std::vector<Size> sizes_of(const Case& one, const Options& options) {
    if (!options.sizes.empty()) return options.sizes;
    if (one.sizes == Sizes::vga_and_full_hd) return {{640, 480}, {1920, 1080}};
    return {{640, 480}};
}

void print_head(bool json) {
#if defined(FOVEA_HAVE_OPENCV)
    const std::string peer = std::string("OpenCV ") + CV_VERSION;
#else
    const std::string peer = "no OpenCV";
#endif
#if defined(__clang__)
    const std::string compiler = "clang++ " __clang_version__;
#else
    const std::string compiler = "g++ " __VERSION__;
#endif
    if (json) {
        std::printf("{\"compiler\":%s,\"vector_bytes\":%d,\"peer\":%s}\n", quoted(compiler).c_str(),
                    simd::lanes, quoted(peer).c_str());
        return;
    }
    std::printf("%s, vectors of %d bytes, %s\n\n", compiler.c_str(), simd::lanes, peer.c_str());
    std::printf("%-46s %-10s %10s %9s %8s %8s  %s\n", "operator", "size", "ms", "ns/px", "memcpy", "ratio",
                "to");
}

}  // namespace

bool add(int order, const std::string& name, Sizes sizes, SetUp set_up) {
    cases().push_back({order, name, sizes, std::move(set_up)});
    return true;
}

}  // namespace fovea::bench

int main(int count, char** words) {
    using namespace fovea::bench;
    const Options options = options_of(count, words);
    auto& all = cases();
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.order < b.order; });
    all.erase(std::remove_if(all.begin(), all.end(),
                             [&](const auto& one) { return !std::regex_search(one.name, options.filter); }),
              all.end());
    if (all.empty()) fail("--filter: no row has such a name");
    if (options.list) {
        for (const auto& one : all) std::printf("%s\n", one.name.c_str());
        return 0;
    }
#if defined(FOVEA_HAVE_OPENCV)
    cv::setNumThreads(1);
#endif
    print_head(options.json);
    Mean mean;
    for (const auto& one : all)
        for (const fovea::Size size : sizes_of(one, options)) {
            const Figures figures = measured(one, size);
            if (options.json)
                print_json(figures);
            else
                print_row(figures);
            std::fflush(stdout);
            mean.take(figures);
        }
    if (!options.json) mean.print();
    return 0;
}
