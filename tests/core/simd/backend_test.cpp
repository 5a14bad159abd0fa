// SPDX-License-Identifier: MIT
//
// The raw operations at whatever width this program is compiled for, against one scalar line each.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/random.hpp>
#include <fovea/simd/backend.hpp>

namespace fovea::test {
namespace {

// Not all of these are functions of the namespace at every width, so the names are found there.
using namespace fovea::simd;

constexpr std::size_t byte_count = sizeof(RawBytes);
constexpr std::size_t word_count = sizeof(RawWords) / 2;
using ByteArray = std::array<std::uint8_t, byte_count>;
using WordArray = std::array<std::uint16_t, word_count>;

/// Values that a lane could confuse with its neighbour: ends, the top bit, and their neighbours.
constexpr int byte_ends[] = {0, 1, 2, 126, 127, 128, 129, 254, 255};
constexpr int word_ends[] = {0, 1, 2, 254, 255, 256, 257, 0x7ffe, 0x7fff, 0x8000, 0x8001, 0xfffe, 0xffff};

int random_byte(Random& random) {
    return random.below(2) == 0 ? byte_ends[random.below(9)] : static_cast<int>(random.below(256));
}
int random_word(Random& random) {
    return random.below(2) == 0 ? word_ends[random.below(13)] : static_cast<int>(random.below(65536));
}

template <class Array, class Draw>
Array drawn(Draw draw) {
    Array array{};
    for (auto& lane : array) lane = static_cast<std::remove_reference_t<decltype(lane)>>(draw());
    return array;
}

/// operation of raw vectors against expected of the values of each lane. The vectors never leave this
/// function, so that widths without a register warn of nothing.
template <class Raw, class Array, class Operation, class Expected>
void compare(const Array& a, const Array& b, Operation operation, Expected expected) {
    Raw raw_a;
    Raw raw_b;
    Raw raw_c;
    std::memcpy(&raw_a, a.data(), sizeof raw_a);
    std::memcpy(&raw_b, b.data(), sizeof raw_b);
    operation(raw_a, raw_b, raw_c);
    Array c{};
    std::memcpy(c.data(), &raw_c, sizeof raw_c);
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_EQ(int{c[i]}, expected(int{a[i]}, int{b[i]}))
            << int{a[i]} << " and " << int{b[i]} << " in lane " << i;
}

/// Every pair of bytes, in lanes whose neighbours are random.
template <class Operation, class Expected>
void compare_bytes(Operation operation, Expected expected) {
    Random random(81);
    for (int pair = 0; pair < 65536; ++pair) {
        ByteArray a = drawn<ByteArray>([&] { return random_byte(random); });
        ByteArray b = drawn<ByteArray>([&] { return random_byte(random); });
        const std::size_t lane = static_cast<std::size_t>(pair) % byte_count;
        a[lane] = static_cast<std::uint8_t>(pair >> 8);
        b[lane] = static_cast<std::uint8_t>(pair);
        compare<RawBytes>(a, b, operation, expected);
        if (testing::Test::HasFatalFailure()) return;
    }
}

/// Pairs of words that keep the contract of Words.
template <class Operation, class Expected, class Allowed>
void compare_words(Operation operation, Expected expected, Allowed allowed) {
    Random random(82);
    for (int round = 0; round < 20000; ++round) {
        WordArray a{};
        WordArray b{};
        for (std::size_t i = 0; i < word_count; ++i) {
            int x = 0;
            int y = 0;
            do {
                x = random_word(random);
                y = random_word(random);
            } while (!allowed(x, y));
            a[i] = static_cast<std::uint16_t>(x);
            b[i] = static_cast<std::uint16_t>(y);
        }
        compare<RawWords>(a, b, operation, expected);
        if (testing::Test::HasFatalFailure()) return;
    }
}
constexpr auto always = [](int, int) { return true; };

TEST(Backend, HasVectorsOfItsWidth) {
    static_assert(sizeof(RawBytes) == FOVEA_BYTES && sizeof(RawWords) == FOVEA_BYTES && lanes == FOVEA_BYTES);
    const auto bytes = drawn<ByteArray>([n = 0]() mutable { return n++; });
    compare<RawBytes>(
        bytes, bytes,
        [](const RawBytes& a, const RawBytes&, RawBytes& c) { c = bits_as<RawBytes>(bits_as<RawWords>(a)); },
        [](int a, int) { return a; });
}

TEST(Backend, SpreadsOneValueOverAllLanes) {
    for (int value = 0; value < 256; ++value)
        compare<RawBytes>(
            ByteArray{}, ByteArray{},
            [&](const RawBytes&, const RawBytes&, RawBytes& c) {
                c = all_bytes(static_cast<std::uint8_t>(value));
            },
            [&](int, int) { return value; });
    for (int value = 0; value < 65536; ++value)
        compare<RawWords>(
            WordArray{}, WordArray{},
            [&](const RawWords&, const RawWords&, RawWords& c) {
                c = all_words(static_cast<std::uint16_t>(value));
            },
            [&](int, int) { return value; });
}

TEST(Backend, TakesTheLowerOfEveryTwoBytes) {
    compare_bytes([](const RawBytes& a, const RawBytes& b, RawBytes& c) { c = lower(a, b); },
                  [](int a, int b) { return std::min(a, b); });
}
TEST(Backend, TakesTheHigherOfEveryTwoBytes) {
    compare_bytes([](const RawBytes& a, const RawBytes& b, RawBytes& c) { c = higher(a, b); },
                  [](int a, int b) { return std::max(a, b); });
}
TEST(Backend, MasksWhereTheFirstByteIsAtLeastTheSecond) {
    compare_bytes([](const RawBytes& a, const RawBytes& b, RawBytes& c) { c = at_least(a, b); },
                  [](int a, int b) { return a >= b ? 255 : 0; });
}

TEST(Backend, AddsAndSubtractsBytesModuloTheirWidth) {
    compare_bytes([](const RawBytes& a, const RawBytes& b, RawBytes& c) { c = plus_bytes(a, b); },
                  [](int a, int b) { return (a + b) & 255; });
    compare_bytes([](const RawBytes& a, const RawBytes& b, RawBytes& c) { c = minus_bytes(a, b); },
                  [](int a, int b) { return (a - b) & 255; });
}

TEST(Backend, AddsWordsWhoseSumFits) {
    compare_words([](const RawWords& a, const RawWords& b, RawWords& c) { c = plus(a, b); },
                  [](int a, int b) { return a + b; }, [](int a, int b) { return a + b < 65536; });
}
TEST(Backend, SubtractsWordsModuloTheirWidth) {
    compare_words([](const RawWords& a, const RawWords& b, RawWords& c) { c = minus(a, b); },
                  [](int a, int b) { return (a - b) & 0xffff; }, always);
}
TEST(Backend, MultipliesWordsWhoseProductFits) {
    Random random(83);
    for (int i = 0; i < 4000; ++i) {
        const int factor = random_word(random);
        const auto a = drawn<WordArray>([&] {
            return factor == 0
                       ? random_word(random)
                       : static_cast<int>(random.below(65536 / static_cast<std::uint32_t>(factor) + 1));
        });
        bool fits = true;
        for (const int value : a) fits = fits && value * std::int64_t{factor} < 65536;
        if (!fits) continue;
        compare<RawWords>(
            a, a,
            [&](const RawWords& x, const RawWords&, RawWords& c) {
                c = times(x, static_cast<std::uint16_t>(factor));
            },
            [&](int x, int) { return x * factor; });
    }
}
TEST(Backend, MultipliesWordsByWordsWhoseProductFits) {
    compare_words([](const RawWords& a, const RawWords& b, RawWords& c) { c = product(a, b); },
                  [](int a, int b) { return a * b; },
                  [](int a, int b) { return std::int64_t{a} * b < 65536; });
}
TEST(Backend, ShiftsWordsLeftWhereTheResultFits) {
    for (int bits = 0; bits < 16; ++bits) {
        Random random(84);
        for (int i = 0; i < 500; ++i) {
            const auto a = drawn<WordArray>([&] { return random.below(65536u >> bits); });
            compare<RawWords>(
                a, a, [&](const RawWords& x, const RawWords&, RawWords& c) { c = shift_left(x, bits); },
                [&](int x, int) { return x << bits; });
        }
    }
}
TEST(Backend, ShiftsEveryWordRight) {
    for (int bits = 0; bits < 16; ++bits)
        compare_words([&](const RawWords& a, const RawWords&, RawWords& c) { c = shift_right(a, bits); },
                      [&](int a, int) { return a >> bits; }, always);
}
TEST(Backend, TakesTheMagnitudeOfEverySignedWord) {
    for (int value = 0; value < 65536; ++value) {
        WordArray a{};
        Random random(static_cast<std::uint64_t>(value));
        for (auto& lane : a) lane = static_cast<std::uint16_t>(random_word(random));
        a[static_cast<std::size_t>(value) % word_count] = static_cast<std::uint16_t>(value);
        compare<RawWords>(
            a, a, [](const RawWords& x, const RawWords&, RawWords& c) { c = absolute(x); },
            [](int x, int) { return x < 0x8000 ? x : 0x10000 - x; });
    }
}
TEST(Backend, HoldsEverySignedWordAt0And255) {
    compare_words([](const RawWords& a, const RawWords&, RawWords& c) { c = hold_to_byte(a); },
                  [](int a, int) { return a >= 0x8000 ? 0 : std::min(a, 255); }, always);
}
TEST(Backend, HoldsEveryWordAt255) {
    for (int value = 0; value < 65536; ++value) {
        WordArray a{};
        Random random(static_cast<std::uint64_t>(value));
        for (auto& lane : a) lane = static_cast<std::uint16_t>(random_word(random));
        a[static_cast<std::size_t>(value) % word_count] = static_cast<std::uint16_t>(value);
        compare<RawWords>(
            a, a, [](const RawWords& x, const RawWords&, RawWords& c) { c = at_most_255(x); },
            [](int x, int) { return std::min(x, 255); });
    }
}

}  // namespace
}  // namespace fovea::test
