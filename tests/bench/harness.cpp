// SPDX-License-Identifier: MIT
//
// Runs every case and prints a line a row: name, size, nanoseconds of a call, of memcpy, of the peer and its
// name, and a remark, divided by tabs. usage: bench [NAME]     NAME: only cases whose name holds it
#include <bench/harness.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>

#include <fovea/simd/lanes.hpp>

#if defined(FOVEA_HAVE_OPENCV)
#include <opencv2/core/utility.hpp>
#endif

namespace fovea::bench {
namespace {

constexpr double batch_nanoseconds = 150e3;
constexpr double row_nanoseconds = 0.6e9;
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

void run(const Case& one, Size size) {
    Row row(size);
    one.set_up(row);
    std::vector<Column>& columns = row.columns();
    if (columns.empty()) return;
    const auto bytes = static_cast<std::size_t>(size.area());
    std::vector<unsigned char> from(bytes, 1);
    std::vector<unsigned char> to(bytes, 2);
    columns.push_back({"memcpy", [&] {
                           std::memcpy(to.data(), from.data(), bytes);
                           consume(to);
                       }});
    measure(columns);
    const bool has_peer = columns.size() > 2;
    const std::string pixels = std::to_string(size.width) + "x" + std::to_string(size.height);
    std::printf("%s\t%s\t%.0f\t%.0f\t%.0f\t%s\t%s\n", one.name.c_str(),
                row.per_pixel() ? pixels.c_str() : "-", columns.front().nanoseconds,
                columns.back().nanoseconds, has_peer ? columns[1].nanoseconds : 0.0,
                has_peer ? columns[1].name.c_str() : "", row.remark().c_str());
    std::fflush(stdout);
}

}  // namespace

bool add(int order, const std::string& name, Sizes sizes, SetUp set_up) {
    cases().push_back({order, name, sizes, std::move(set_up)});
    return true;
}

}  // namespace fovea::bench

int main(int count, char** words) {
    using namespace fovea::bench;
#if defined(FOVEA_HAVE_OPENCV)
    cv::setNumThreads(1);
    std::printf("# OpenCV %s\n", CV_VERSION);
#endif
    std::printf("# vectors of %d bytes\n", fovea::simd::lanes);
    auto& all = cases();
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.order < b.order; });
    for (const auto& one : all) {
        if (count > 1 && one.name.find(words[1]) == std::string::npos) continue;
        run(one, {640, 480});
        if (one.sizes == Sizes::vga_and_full_hd) run(one, {1920, 1080});
    }
    return 0;
}
