// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <queue>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/prefix_code.hpp>

#include "lossless_files.hpp"

namespace fovea::test {
namespace {

std::vector<int> lengths_of(const std::vector<int>& frequencies, int longest) {
    const int symbols = static_cast<int>(frequencies.size());
    Bytes packed(2 * frequencies.size());
    const PackedNumbers numbers(packed.data());
    for (int i = 0; i < symbols; ++i)
        numbers.put(i, static_cast<std::uint32_t>(frequencies[static_cast<std::size_t>(i)]));
    Bytes lengths(frequencies.size(), 99);
    prefix_code_lengths(numbers, symbols, longest, lengths.data());
    return {lengths.begin(), lengths.end()};
}

/// What the codes take of the space, in units of 2^-15.
int space_of(const std::vector<int>& lengths) {
    int space = 0;
    for (const int length : lengths)
        if (length > 0) space += 1 << (15 - length);
    return space;
}

std::int64_t cost_of(const std::vector<int>& frequencies, const std::vector<int>& lengths) {
    std::int64_t cost = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) cost += std::int64_t{frequencies[i]} * lengths[i];
    return cost;
}

/// The cost of Huffman's code: the sum of all inner nodes' weights.
std::int64_t huffman_cost(const std::vector<int>& frequencies) {
    std::priority_queue<int, std::vector<int>, std::greater<>> nodes;
    for (const int frequency : frequencies)
        if (frequency > 0) nodes.push(frequency);
    std::int64_t cost = nodes.size() == 1 ? nodes.top() : 0;
    while (nodes.size() > 1) {
        int sum = nodes.top();
        nodes.pop();
        sum += nodes.top();
        nodes.pop();
        nodes.push(sum);
        cost += sum;
    }
    return cost;
}

TEST(PrefixCodeLengths, GivesTheFrequentSymbolsTheShortCodes) {
    EXPECT_EQ(lengths_of({1, 4, 0, 2, 1}, 15), (std::vector<int>{3, 1, 0, 2, 3}));
    EXPECT_EQ(lengths_of({5, 5, 5, 5}, 15), (std::vector<int>{2, 2, 2, 2}));
}

TEST(PrefixCodeLengths, MakesACompleteCodeOfOneSymbolOrNone) {
    EXPECT_EQ(lengths_of({0, 0, 0}, 15), (std::vector<int>{1, 1, 0}));
    EXPECT_EQ(lengths_of({7, 0, 0}, 15), (std::vector<int>{1, 1, 0}));
    EXPECT_EQ(lengths_of({0, 0, 7}, 15), (std::vector<int>{1, 0, 1}));
}

TEST(PrefixCodeLengths, AreAsShortAsHuffmansAndComplete) {
    Random random(3);
    for (int round = 0; round < 300; ++round) {
        std::vector<int> frequencies(static_cast<std::size_t>(random.between(2, 286)));
        const int most = random.between(1, 228);
        for (int& frequency : frequencies)
            frequency = random.between(0, 3) == 0 ? 0 : random.between(0, most);
        const std::vector<int> lengths = lengths_of(frequencies, 15);
        ASSERT_EQ(space_of(lengths), 1 << 15);
        if (std::count(frequencies.begin(), frequencies.end(), 0) + 2 > static_cast<int>(frequencies.size()))
            continue;
        ASSERT_EQ(cost_of(frequencies, lengths), huffman_cost(frequencies)) << "round " << round;
    }
}

TEST(PrefixCodeLengths, StayBelowTheirLimitOnFibonacciNumbers) {
    // The frequencies that make the deepest tree: 20 of them have a depth of 19.
    std::vector<int> frequencies = {1, 1};
    while (frequencies.size() < 20)
        frequencies.push_back(frequencies.back() + frequencies[frequencies.size() - 2]);
    for (const int limit : {5, 7, 15, 18, 19}) {
        const std::vector<int> lengths = lengths_of(frequencies, limit);
        EXPECT_LE(*std::max_element(lengths.begin(), lengths.end()), limit);
        EXPECT_EQ(limit <= 15 ? space_of(lengths) : 1 << 15, 1 << 15);
    }
    EXPECT_EQ(cost_of(frequencies, lengths_of(frequencies, 19)), huffman_cost(frequencies));
}

TEST(PrefixCodes, AreThoseOfTheExampleInRfc1951) {
    // Section 3.2.2: lengths 3, 3, 3, 3, 3, 2, 4, 4 give 010, 011, 100, 101, 110, 00, 1110, 1111.
    const std::uint8_t lengths[] = {3, 3, 3, 3, 3, 2, 4, 4};
    std::uint8_t bytes[16] = {};
    const PackedNumbers codes(bytes);
    prefix_codes(lengths, 8, codes);
    // First bit lowest.
    const std::uint32_t expected[] = {0b010, 0b110, 0b001, 0b101, 0b011, 0b00, 0b0111, 0b1111};
    for (int i = 0; i < 8; ++i) EXPECT_EQ(codes[i], expected[i]) << i;
}

TEST(PrefixDecoder, SaysWhatShapeACodeHas) {
    using Decoder = PrefixDecoder<8, 4>;
    std::uint8_t scratch[Decoder::scratch_bytes];
    Decoder decoder(scratch);
    const auto shape = [&](Bytes lengths) { return decoder.build(view_of(lengths)); };
    EXPECT_EQ(shape({1, 1}), PrefixCodeShape::complete);
    EXPECT_EQ(shape({3, 3, 3, 3, 3, 2, 4, 4}), PrefixCodeShape::complete);
    EXPECT_EQ(shape({0, 0, 1}), PrefixCodeShape::single);
    EXPECT_EQ(shape({0, 0, 0}), PrefixCodeShape::empty);
    EXPECT_EQ(shape({}), PrefixCodeShape::empty);
    EXPECT_EQ(shape({2}), PrefixCodeShape::wrong);         // a gap
    EXPECT_EQ(shape({1, 2}), PrefixCodeShape::wrong);      // a gap
    EXPECT_EQ(shape({15, 15}), PrefixCodeShape::wrong);    // a large gap
    EXPECT_EQ(shape({1, 1, 1}), PrefixCodeShape::wrong);   // too many
    EXPECT_EQ(shape({1, 1, 15}), PrefixCodeShape::wrong);  // too many, by the least there is
    EXPECT_EQ(shape({1, 1, 1, 1, 1, 1, 1, 1}), PrefixCodeShape::wrong);
}

TEST(PrefixDecoder, FindsNothingInTheGapOfASingleCode) {
    using Decoder = PrefixDecoder<8, 4>;
    std::uint8_t scratch[Decoder::scratch_bytes];
    Decoder decoder(scratch);
    EXPECT_EQ(decoder.build(view_of(Bytes{0, 0, 1})), PrefixCodeShape::single);
    EXPECT_EQ(decoder.read(0).symbol, 2);
    EXPECT_EQ(decoder.read(0).length, 1);
    EXPECT_EQ(decoder.read(1).symbol, -1);
    EXPECT_EQ(decoder.read(1).length, 0);
}

TEST(PrefixDecoder, ReadsBackEveryCodeShortOrLongerThanItsTable) {
    using Decoder = PrefixDecoder<286, 6>;
    Bytes scratch(Decoder::scratch_bytes);
    Random random(4);
    for (int round = 0; round < 100; ++round) {
        std::vector<int> frequencies(286);
        // A steep fall, so that lengths from 1 to 15 come up.
        for (int& frequency : frequencies) frequency = 1 << random.between(0, random.between(0, 12)) >> 1;
        const std::vector<int> wide = lengths_of(frequencies, 15);
        const Bytes lengths(wide.begin(), wide.end());
        Decoder decoder(scratch.data());
        ASSERT_EQ(decoder.build(view_of(lengths)), PrefixCodeShape::complete);
        Bytes packed(2 * 286);
        const PackedNumbers codes(packed.data());
        prefix_codes(lengths.data(), 286, codes);
        for (int symbol = 0; symbol < 286; ++symbol) {
            const int length = lengths[static_cast<std::size_t>(symbol)];
            if (length == 0) continue;
            const PrefixSymbol read = decoder.read(codes[symbol] | random.next() << length);
            ASSERT_EQ(read.symbol, symbol);
            ASSERT_EQ(read.length, length);
        }
    }
}

}  // namespace
}  // namespace fovea::test
