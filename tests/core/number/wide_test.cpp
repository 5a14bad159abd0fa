// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/number/wide.hpp>

namespace fovea::test {
namespace {

__extension__ using Word128 = unsigned __int128;

/// 64 bits with the top one set; half of them are patterns that carry far.
std::uint64_t digits(Random& random) {
    const std::uint64_t high = random.next();
    const std::uint64_t any = high << 32 | random.next();
    const int shift = random.between(0, 63);
    const std::uint64_t patterns[] = {
        any, ~(any >> shift), any >> shift, std::uint64_t{1} << shift, ~std::uint64_t{0} << shift, any};
    return patterns[random.below(6)] | std::uint64_t{1} << 63;
}

std::uint64_t divide_reference(std::uint64_t a, std::uint64_t b) {
    return static_cast<std::uint64_t>((static_cast<Word128>(a) << 63) / b);
}

TEST(MultiplyWide, IsTheProductOfTheCompiler) {
    Random random(1);
    for (int i = 0; i < 1000000; ++i) {
        const std::uint64_t a = digits(random) >> random.between(0, 63);
        const std::uint64_t b = digits(random) >> random.between(0, 63);
        const Word128 product = static_cast<Word128>(a) * b;
        const Wide expected{static_cast<std::uint64_t>(product >> 64), static_cast<std::uint64_t>(product)};
        ASSERT_EQ(multiply_wide(a, b), expected);
        ASSERT_EQ(narrow_words::multiply_wide(a, b), expected);
    }
    static_assert(narrow_words::multiply_wide(~std::uint64_t{0}, ~std::uint64_t{0}) ==
                  Wide{~std::uint64_t{0} - 1, 1});
}

TEST(DivideWide, IsTheQuotientOfTheCompilerInBothWays) {
    Random random(2);
    for (int i = 0; i < 1000000; ++i) {
        const std::uint64_t a = digits(random);
        const std::uint64_t b = digits(random);
        ASSERT_EQ(divide_wide(a, b), divide_reference(a, b)) << a << " / " << b;
        ASSERT_EQ(narrow_words::divide_wide(a, b), divide_reference(a, b)) << a << " / " << b;
    }
    const std::uint64_t least = std::uint64_t{1} << 63;
    const std::uint64_t most = ~std::uint64_t{0};
    for (const std::uint64_t a : {least, least + 1, most - 1, most})
        for (const std::uint64_t b : {least, least + 1, most - 1, most})
            EXPECT_EQ(narrow_words::divide_wide(a, b), divide_reference(a, b));
}

TEST(DivideWide, StartsFromAReciprocalThatIsNear) {
    // The loop that mends a quotient runs so often as the reciprocal is off: its bound is part of its proof.
    Random random(3);
    for (int i = 0; i < 1000000; ++i) {
        const std::uint64_t b = digits(random);
        const long double exact = 39614081257132168796771975168.0L / static_cast<long double>(b);  // 2^95
        const long double found = narrow_words::reciprocal(b);
        ASSERT_LE(found - exact, 1.2L) << b;
        ASSERT_LE(exact - found, 1.2L) << b;
    }
}

TEST(IsqrtWide, IsTheLargestRootThatFitsInBothWays) {
    Random random(4);
    for (int i = 0; i < 1000000; ++i) {
        const std::uint64_t value = digits(random) >> random.between(0, 1);
        const std::uint64_t root = isqrt_wide(value);
        const Word128 square = static_cast<Word128>(root) * root;
        const Word128 wanted = static_cast<Word128>(value) << 64;
        ASSERT_LE(square, wanted);
        ASSERT_LE(wanted - square, 2 * static_cast<Word128>(root));
        ASSERT_EQ(narrow_words::isqrt_wide(value), root) << value;
    }
    // Squares of 32 bits, and what is next to them.
    for (std::uint64_t root = 0xffffffffu; root > 0xfffffc00u; --root)
        for (const std::uint64_t value : {root * root - 1, root * root, root * root + 1})
            ASSERT_EQ(narrow_words::isqrt_wide(value), isqrt_wide(value)) << value;
}

}  // namespace
}  // namespace fovea::test
