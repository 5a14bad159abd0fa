// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/bar_edges.hpp>
#include <fovea/code/decode_bars.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

TEST(DecodeBars, ReadsEverySymbologyAndTellsWhich) {
    for (const BarSample& sample : bar_samples) {
        const std::vector<std::int32_t> edges = edges_of(bars_of(sample.symbology, sample.text), 600);
        BarReading reading;
        ASSERT_EQ(decode_bars(span_of(edges), 0, {}, reading), Status::ok) << sample.text;
        EXPECT_EQ(reading.symbology, sample.symbology);
        EXPECT_EQ(text_of(reading), sample.text);
        BarRules none;
        none.symbologies = {};
        EXPECT_EQ(decode_bars(span_of(edges), 0, none, reading), Status::not_found);
    }
}

TEST(DecodeBars, NoSymbologyIsTakenForAnotherFromEitherEnd) {
    for (const BarSample& sample : bar_samples) {
        const std::vector<std::int32_t> edges = edges_of(bars_of(sample.symbology, sample.text), 600);
        std::vector<std::int32_t> reversed(edges.size() + 1);
        reversed.resize(static_cast<std::size_t>(reverse_bar_edges(
            span_of(edges), {reversed.data(), static_cast<std::ptrdiff_t>(reversed.size())})));
        for (const BarSample& other : bar_samples) {
            if (other.symbology == sample.symbology) continue;
            BarRules rules;
            rules.symbologies = other.symbology;
            if (sample.symbology == Symbology::upc_a && other.symbology == Symbology::ean_13) continue;
            BarReading reading;
            EXPECT_EQ(decode_bars(span_of(edges), 0, rules, reading), Status::not_found);
            EXPECT_EQ(decode_bars(span_of(reversed), 0, rules, reading), Status::not_found);
        }
    }
}

TEST(DecodeBars, GoesOnBehindACode) {
    std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::ean_13, "9780905705712"), 600);
    const std::int32_t end = edges.back();
    edges.pop_back();
    for (const std::int32_t edge : edges_of(bars_of(Symbology::code_128, "FOVEA"), 500)) {
        if (edge > 0) edges.push_back(end + edge);
    }
    BarReading reading;
    ASSERT_EQ(decode_bars(span_of(edges), 0, {}, reading), Status::ok);
    EXPECT_EQ(text_of(reading), "9780905705712");
    ASSERT_EQ(decode_bars(span_of(edges), reading.last, {}, reading), Status::ok);
    EXPECT_EQ(text_of(reading), "FOVEA");
    EXPECT_EQ(decode_bars(span_of(edges), reading.last, {}, reading), Status::not_found);
}

TEST(DecodeBars, RandomRunsAreNoCodes) {
    // Widths of one to four modules with some noise, as a line through text or a pattern has them.
    Random random(3181);
    int read = 0;
    for (int round = 0; round < 20000; ++round) {
        std::vector<std::int32_t> edges = {0, 6000};
        for (int i = 0; i < 99; ++i) {
            edges.push_back(edges.back() + 512 * random.between(1, 4) + random.between(-60, 60));
        }
        edges.push_back(edges.back() + 6000);
        BarReading reading;
        if (decode_bars(span_of(edges), 0, {}, reading) == Status::ok) ++read;
    }
    EXPECT_EQ(read, 0);
}

TEST(DecodeBars, AnyRisingEdgesAreTaken) {
    Random random(3182);
    for (int round = 0; round < 3000; ++round) {
        std::vector<std::int32_t> edges(random.below(120));
        std::int32_t at = round % 3 == 0 ? -2147483647 : 0;
        const std::uint32_t most = round % 2 == 0 ? 3 : 30000000;
        for (std::int32_t& edge : edges) {
            edge = at;
            at = static_cast<std::int32_t>(std::int64_t{at} +
                                           random.below(most) % (2147483647 - std::int64_t{at} / 2));
            if (at < edge) at = edge;
        }
        BarReading reading;
        static_cast<void>(decode_bars(span_of(edges), 0, {}, reading));
    }
}

TEST(DecodeBars, ChecksItsArguments) {
    const std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::ean_13, "9780905705712"), 600);
    BarReading reading;
    reading.size = 77;
    EXPECT_EQ(decode_bars(span_of(edges), -1, {}, reading), Status::out_of_range);
    EXPECT_EQ(decode_bars(span_of(edges), 64, {}, reading), Status::out_of_range);
    BarRules odd;
    odd.interleaved_shortest = 7;
    EXPECT_EQ(decode_bars(span_of(edges), 0, odd, reading), Status::bad_argument);
    EXPECT_EQ(decode_bars({}, 0, {}, reading), Status::not_found);
    EXPECT_EQ(reading.size, 77);
}

TEST(DecodeBars, TheFirstLookLeavesOutNothingThatADecoderReads) {
    Random random(31);
    int read = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        // Runs and quiet zone are some wider or narrower, so that decoders are near their limits.
        const BarSample& sample = bar_samples[static_cast<std::size_t>(trial) % std::size(bar_samples)];
        std::vector<std::int32_t> edges = edges_of(bars_of(sample.symbology, sample.text), 600);
        const std::int32_t quiet = random.between(1, 12) * 400;
        const int jitter = random.between(0, 120);
        std::vector<std::int32_t> moved = {0};
        for (std::size_t i = 1; i < edges.size(); ++i) {
            const std::int32_t run = i == 1 ? quiet : edges[i] - edges[i - 1];
            moved.push_back(moved.back() + std::max(1, run + random.between(-jitter, jitter)));
        }
        const BarEdges line = span_of(moved);
        const BarRules rules;
        for (int first = 1; first + detail::fewest_bar_edges < line.size(); first += 2) {
            BarReading plain;
            Status expected = decode_ean(line, first, rules, plain);
            if (expected != Status::ok) expected = decode_code_128(line, first, plain);
            if (expected != Status::ok) expected = decode_code_39(line, first, rules, plain);
            if (expected != Status::ok) expected = decode_interleaved(line, first, rules, plain);
            if (expected != Status::ok) expected = decode_codabar(line, first, rules, plain);
            BarReading reading;
            const Status status = detail::decode_bars_at(line, first, rules, reading);
            ASSERT_EQ(status == Status::ok, expected == Status::ok) << trial << ' ' << first;
            if (status != Status::ok) continue;
            ++read;
            EXPECT_EQ(text_of(reading), text_of(plain));
            EXPECT_EQ(reading.symbology, plain.symbology);
        }
    }
    EXPECT_GT(read, 1000);
}

}  // namespace
}  // namespace fovea::test
