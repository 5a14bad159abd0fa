// SPDX-License-Identifier: MIT
//
// Bytes and Words at whatever width this program is compiled for.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <fovea/base/random.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea::test {
namespace {

using simd::Bytes;
using simd::Words;

constexpr std::size_t lanes = static_cast<std::size_t>(simd::lanes);
using Pixels = std::array<std::uint8_t, lanes>;
/// The values of Words in the order of their columns.
using Columns = std::array<std::uint16_t, lanes>;

Pixels random_pixels(Random& random) {
    Pixels pixels{};
    for (std::uint8_t& pixel : pixels) {
        const auto draw = static_cast<std::uint8_t>(random.below(256));
        pixel = random.below(4) == 0 ? 0 : random.below(4) == 0 ? 255 : draw;
    }
    return pixels;
}

/// make of Bytes, stored.
template <class Make>
Pixels stored(Make make) {
    Pixels pixels{};
    make().store(pixels.data());
    return pixels;
}

Columns columns_of(const Words& words) {
    std::array<std::uint16_t, lanes / 2> even{};
    std::array<std::uint16_t, lanes / 2> odd{};
    std::memcpy(even.data(), &words.even, sizeof words.even);
    std::memcpy(odd.data(), &words.odd, sizeof words.odd);
    Columns columns{};
    for (std::size_t i = 0; i < lanes; ++i) columns[i] = i % 2 == 0 ? even[i / 2] : odd[i / 2];
    return columns;
}
void put_columns(const Columns& columns, Words& words) {
    std::array<std::uint16_t, lanes / 2> even{};
    std::array<std::uint16_t, lanes / 2> odd{};
    for (std::size_t i = 0; i < lanes; ++i) (i % 2 == 0 ? even[i / 2] : odd[i / 2]) = columns[i];
    std::memcpy(&words.even, even.data(), sizeof words.even);
    std::memcpy(&words.odd, odd.data(), sizeof words.odd);
}

TEST(Bytes, LoadsAndStoresAWholeVectorAnywhere) {
    Random random(85);
    std::array<std::uint8_t, lanes + 9> from{};
    for (std::uint8_t& byte : from) byte = static_cast<std::uint8_t>(random.below(256));
    for (std::size_t shift = 0; shift < 9; ++shift) {
        std::array<std::uint8_t, lanes + 10> to{};
        to.fill(0xa5);
        Bytes::load(from.data() + shift).store(to.data() + shift);
        for (std::size_t i = 0; i < to.size(); ++i)
            ASSERT_EQ(to[i], i >= shift && i < shift + lanes ? from[i] : 0xa5) << shift << " " << i;
    }
}

TEST(Bytes, LoadsAndStoresAPartAndTouchesNothingBeside) {
    Random random(86);
    for (std::size_t count = 0; count <= lanes; ++count) {
        // Of exactly the size, so that the address sanitizer sees a byte too many.
        const auto from = std::make_unique<std::uint8_t[]>(count);
        const auto to = std::make_unique<std::uint8_t[]>(count);
        for (std::size_t i = 0; i < count; ++i) from[i] = static_cast<std::uint8_t>(1 + random.below(255));
        const Pixels whole = stored([&] { return Bytes::load(from.get(), static_cast<int>(count)); });
        for (std::size_t i = 0; i < lanes; ++i) ASSERT_EQ(whole[i], i < count ? from[i] : 0);
        Bytes::load(whole.data()).store(to.get(), static_cast<int>(count));
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(to[i], from[i]);
        Pixels guarded{};
        guarded.fill(0xa5);
        Bytes::load(whole.data()).store(guarded.data(), static_cast<int>(count));
        for (std::size_t i = count; i < lanes; ++i) ASSERT_EQ(guarded[i], 0xa5);
    }
}

TEST(Bytes, WorksOnEveryPixelAlone) {
    Random random(87);
    for (int round = 0; round < 5000; ++round) {
        const Pixels a = random_pixels(random);
        const Pixels b = random_pixels(random);
        const auto with = [&](auto operation) {
            return stored([&] { return operation(Bytes::load(a.data()), Bytes::load(b.data())); });
        };
        const Pixels low = with([](Bytes x, Bytes y) { return lower(x, y); });
        const Pixels high = with([](Bytes x, Bytes y) { return higher(x, y); });
        const Pixels mask = with([](Bytes x, Bytes y) { return at_least(x, y); });
        const Pixels both = with([](Bytes x, Bytes y) { return x & y; });
        const Pixels any = with([](Bytes x, Bytes y) { return x | y; });
        const Pixels one = with([](Bytes x, Bytes y) { return x ^ y; });
        const Pixels none = with([](Bytes x, Bytes) { return ~x; });
        for (std::size_t i = 0; i < lanes; ++i) {
            ASSERT_EQ(low[i], std::min(a[i], b[i]));
            ASSERT_EQ(high[i], std::max(a[i], b[i]));
            ASSERT_EQ(mask[i], a[i] >= b[i] ? 255 : 0);
            ASSERT_EQ(both[i], a[i] & b[i]);
            ASSERT_EQ(any[i], a[i] | b[i]);
            ASSERT_EQ(one[i], a[i] ^ b[i]);
            ASSERT_EQ(none[i], 255 - a[i]);
        }
    }
}

TEST(Bytes, AddAndSubtractEveryPairOfLevels) {
    for (int a = 0; a < 256; ++a)
        for (int first = 0; first < 256; first += static_cast<int>(lanes)) {
            // Neighbours differ, so that a carry into one would show.
            Pixels left{};
            Pixels right{};
            for (std::size_t i = 0; i < lanes; ++i) {
                left[i] = static_cast<std::uint8_t>(i % 2 == 0 ? a : 255 - a);
                right[i] = static_cast<std::uint8_t>(first + static_cast<int>(i));
            }
            const auto with = [&](auto operation) {
                return stored([&] { return operation(Bytes::load(left.data()), Bytes::load(right.data())); });
            };
            const Pixels sum = with([](Bytes x, Bytes y) { return x + y; });
            const Pixels difference = with([](Bytes x, Bytes y) { return x - y; });
            const Pixels held_sum = with([](Bytes x, Bytes y) { return add_saturated(x, y); });
            const Pixels held_difference = with([](Bytes x, Bytes y) { return subtract_saturated(x, y); });
            const Pixels mean = with([](Bytes x, Bytes y) { return average(x, y); });
            for (std::size_t i = 0; i < lanes; ++i) {
                ASSERT_EQ(sum[i], (left[i] + right[i]) % 256);
                ASSERT_EQ(difference[i], (256 + left[i] - right[i]) % 256);
                ASSERT_EQ(held_sum[i], std::min(left[i] + right[i], 255));
                ASSERT_EQ(held_difference[i], std::max(left[i] - right[i], 0));
                ASSERT_EQ(mean[i], (left[i] + right[i] + 1) / 2);
            }
        }
}

TEST(Bytes, SpreadsOneValueOverAllPixels) {
    for (int value = 0; value < 256; ++value)
        for (const std::uint8_t pixel : stored([&] { return Bytes::all(static_cast<std::uint8_t>(value)); }))
            ASSERT_EQ(pixel, value);
}

TEST(Words, HoldEvenAndOddColumnsApartAndGoBack) {
    Random random(88);
    for (int round = 0; round < 1000; ++round) {
        const Pixels pixels = random_pixels(random);
        const Words words(Bytes::load(pixels.data()));
        const Columns columns = columns_of(words);
        for (std::size_t i = 0; i < lanes; ++i) ASSERT_EQ(columns[i], pixels[i]);
        ASSERT_EQ(stored([&] { return words.narrow(); }), pixels);
        ASSERT_EQ(stored([&] { return words.saturate(); }), pixels);
    }
    const Columns all = columns_of(Words::all(0xabcd));
    for (const std::uint16_t value : all) EXPECT_EQ(value, 0xabcd);
}

TEST(Words, SaturateWhatAPixelCannotHold) {
    for (int first = 0; first < 65536; first += static_cast<int>(lanes)) {
        Columns columns{};
        for (std::size_t i = 0; i < lanes; ++i)
            columns[i] = static_cast<std::uint16_t>(first + static_cast<int>(i));
        Words words;
        put_columns(columns, words);
        const Pixels pixels = stored([&] { return words.saturate(); });
        for (std::size_t i = 0; i < lanes; ++i) ASSERT_EQ(pixels[i], std::min<int>(columns[i], 255));
    }
}

/// operation(Words, Words) against expected(int, int) on values below the bounds.
template <class Operation, class Expected>
void compare(std::uint32_t bound_a, std::uint32_t bound_b, Operation operation, Expected expected) {
    Random random(89);
    for (int round = 0; round < 5000; ++round) {
        Columns a{};
        Columns b{};
        const auto draw = [&](std::uint32_t bound) {
            const std::uint32_t kind = random.below(6);
            return static_cast<std::uint16_t>(kind == 0 ? 0 : kind == 1 ? bound - 1 : random.below(bound));
        };
        for (std::size_t i = 0; i < lanes; ++i) {
            a[i] = draw(bound_a);
            b[i] = draw(bound_b);
        }
        Words words_a;
        Words words_b;
        put_columns(a, words_a);
        put_columns(b, words_b);
        const Columns c = columns_of(operation(words_a, words_b));
        for (std::size_t i = 0; i < lanes; ++i)
            ASSERT_EQ(c[i], expected(a[i], b[i])) << a[i] << " and " << b[i];
    }
}

TEST(Words, AddUpTo16Bits) {
    compare(
        32768, 32768, [](const Words& a, const Words& b) { return a + b; },
        [](int a, int b) { return a + b; });
    compare(
        65536, 1, [](const Words& a, const Words& b) { return a + b; }, [](int a, int) { return a; });
    compare(
        1, 65536, [](const Words& a, const Words& b) { return a + b; }, [](int, int b) { return b; });
}

TEST(Words, MultiplyAndShiftUpTo16Bits) {
    compare(
        258, 1, [](const Words& a, const Words&) { return a * 255; }, [](int a, int) { return a * 255; });
    compare(
        2, 1, [](const Words& a, const Words&) { return a * 65535; }, [](int a, int) { return a * 65535; });
    compare(
        65536, 1, [](const Words& a, const Words&) { return a * 1; }, [](int a, int) { return a; });
    compare(
        65536, 1, [](const Words& a, const Words&) { return a * 0; }, [](int, int) { return 0; });
    compare(
        256, 1, [](const Words& a, const Words&) { return a << 8; }, [](int a, int) { return a << 8; });
    compare(
        2, 1, [](const Words& a, const Words&) { return a << 15; }, [](int a, int) { return a << 15; });
    for (int n = 0; n < 16; ++n)
        compare(
            65536, 1, [n](const Words& a, const Words&) { return a >> n; },
            [n](int a, int) { return a >> n; });
}

TEST(Words, MultiplyColumnByColumn) {
    compare(
        256, 256, [](const Words& a, const Words& b) { return a * b; }, [](int a, int b) { return a * b; });
    compare(
        2, 65536, [](const Words& a, const Words& b) { return a * b; }, [](int a, int b) { return a * b; });
}

TEST(Words, GiveTheDistanceOfTwoValuesOf15Bits) {
    compare(
        32768, 32768, [](const Words& a, const Words& b) { return absolute(a - b); },
        [](int a, int b) { return std::abs(a - b); });
}

TEST(Bytes, AddAndSubtractModulo256) {
    Random random(91);
    for (int round = 0; round < 1000; ++round) {
        const Pixels a = random_pixels(random);
        const Pixels b = random_pixels(random);
        const Pixels sum = stored([&] { return Bytes::load(a.data()) + Bytes::load(b.data()); });
        const Pixels difference = stored([&] { return Bytes::load(a.data()) - Bytes::load(b.data()); });
        for (std::size_t i = 0; i < lanes; ++i) {
            ASSERT_EQ(sum[i], (a[i] + b[i]) & 255);
            ASSERT_EQ(difference[i], (a[i] - b[i]) & 255);
        }
    }
}

TEST(Bytes, ShiftEveryPixelAlone) {
    Random random(93);
    for (int round = 0; round < 200; ++round)
        for (int n = 0; n < 8; ++n) {
            const Pixels a = random_pixels(random);
            const Pixels left = stored([&] { return Bytes::load(a.data()) << n; });
            const Pixels right = stored([&] { return Bytes::load(a.data()) >> n; });
            for (std::size_t i = 0; i < lanes; ++i) {
                ASSERT_EQ(left[i], (a[i] << n) & 255);
                ASSERT_EQ(right[i], a[i] >> n);
            }
        }
}

TEST(Words, HoldADifferenceBetween0And255) {
    Random random(92);
    for (int round = 0; round < 1000; ++round) {
        const Pixels a = random_pixels(random);
        const Pixels b = random_pixels(random);
        const Pixels held = stored([&] {
            return (Words(Bytes::load(a.data())) * 3 - Words(Bytes::load(b.data())) - Words::all(100)).held();
        });
        for (std::size_t i = 0; i < lanes; ++i)
            ASSERT_EQ(held[i], std::max(0, std::min(255, 3 * a[i] - b[i] - 100)));
    }
}

TEST(Words, SubtractFromADifferenceAgain) {
    // The difference may be negative as long as absolute() or another difference takes it.
    compare(
        16384, 8192, [](const Words& a, const Words& b) { return absolute(a - b - b); },
        [](int a, int b) { return std::abs(a - 2 * b); });
    compare(
        16384, 16384, [](const Words& a, const Words& b) { return a - (a - b); },
        [](int, int b) { return b; });
}

TEST(Words, CompareAndChooseUnsignedNumbers) {
    compare(
        65536, 65536, [](const Words& a, const Words& b) { return lower(a, b); },
        [](int a, int b) { return std::min(a, b); });
    compare(
        65536, 65536, [](const Words& a, const Words& b) { return higher(a, b); },
        [](int a, int b) { return std::max(a, b); });
    compare(
        65536, 65536, [](const Words& a, const Words& b) { return at_least(a, b); },
        [](int a, int b) { return a >= b ? 65535 : 0; });
    compare(
        65536, 65536, [](const Words& a, const Words& b) { return (a & b) | ~a; },
        [](int a, int b) { return ((a & b) | ~a) & 65535; });
}

TEST(Words, GiveTheHighHalfOfAProduct) {
    for (const int k : {0, 1, 2, 255, 256, 7282, 10486, 32767, 32768, 65535})
        compare(
            65536, 1,
            [=](const Words& a, const Words&) { return times_high(a, static_cast<std::uint16_t>(k)); },
            [=](int a, int) {
                return static_cast<int>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(k) >> 16);
            });
}

TEST(Words, GiveTheHighHalfOfTheirProducts) {
    compare(
        65536, 65536, [](const Words& a, const Words& b) { return times_high(a, b); },
        [](int a, int b) {
            return static_cast<int>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b) >> 16);
        });
}

TEST(Words, SumProductsOfEitherSignThatEndAboveZero) {
    // On the way every sum is below zero or above 2^16.
    for (const int k : {-32768, -257, -1, 0, 1, 300, 32767})
        compare(
            256, 256,
            [=](const Words& a, const Words& b) {
                const auto by = static_cast<std::int16_t>(k);
                const auto back = static_cast<std::int16_t>(-(k == -32768 ? -32767 : k));
                const Words sum = Words::all(60000) + times_signed(a, by) + times_signed(b, -200);
                const Words rest = k == -32768 ? sum + a : sum;
                return rest + times_signed(a, back);
            },
            [](int, int b) { return 60000 - 200 * b; });
}

TEST(Words, LoadAndStoreNumbersOf16BitsInTheirOrder) {
    Random random(91);
    for (std::size_t count = 1; count <= lanes; ++count) {
        std::array<std::uint16_t, lanes> from{};
        for (auto& number : from) number = static_cast<std::uint16_t>(random.next());
        const bool whole = count == lanes;
        const Words words =
            whole ? Words::load(from.data()) : Words::load(from.data(), static_cast<int>(count));
        const Columns columns = columns_of(words);
        for (std::size_t i = 0; i < lanes; ++i) ASSERT_EQ(columns[i], i < count ? from[i] : 0);
        std::array<std::uint16_t, lanes> to{};
        to.fill(0xa5a5);
        if (whole)
            words.store(to.data());
        else
            words.store(to.data(), static_cast<int>(count));
        for (std::size_t i = 0; i < lanes; ++i) ASSERT_EQ(to[i], i < count ? from[i] : 0xa5a5);
        std::array<std::int16_t, lanes> differences{};
        (Words::all(3) - Words::all(5)).store(differences.data(), static_cast<int>(count));
        for (std::size_t i = 0; i < lanes; ++i) ASSERT_EQ(differences[i], i < count ? -2 : 0);
    }
}

TEST(Words, ComputeTheMeanOfAPixelAndItsDoubleAsAFilterDoes) {
    // 3 a + 2 b + 4 over 8, the shape of every smoothing: all of it below 2^16.
    Random random(90);
    for (int round = 0; round < 1000; ++round) {
        const Pixels a = random_pixels(random);
        const Pixels b = random_pixels(random);
        const Pixels mean = stored([&] {
            const Words x(Bytes::load(a.data()));
            const Words y(Bytes::load(b.data()));
            return ((x * 3 + (y << 2) + y + Words::all(4)) >> 3).narrow();
        });
        for (std::size_t i = 0; i < lanes; ++i) ASSERT_EQ(mean[i], (3 * a[i] + 5 * b[i] + 4) >> 3);
    }
}

}  // namespace
}  // namespace fovea::test
