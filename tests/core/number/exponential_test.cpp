// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include <fovea/number/exponential.hpp>

namespace fovea::test {
namespace {

TEST(ExponentialOfMinus, IsTheRealFunctionToItsBound) {
    for (double x = 0; x < 33; x += 0.00173) {
        const auto fixed = static_cast<std::uint64_t>(std::llround(x * 4294967296.0));
        const double expected = std::exp(-static_cast<double>(fixed) / 4294967296.0) * 2147483648.0;
        ASSERT_NEAR(exponential_of_minus(fixed), expected, 8) << x;
    }
}

TEST(ExponentialOfMinus, KnowsItsEnds) {
    EXPECT_EQ(exponential_of_minus(0), 1u << 31);
    EXPECT_NEAR(exponential_of_minus(1), 2147483648.0, 8);
    EXPECT_EQ(exponential_of_minus(std::uint64_t{32} << 32), 0u);
    EXPECT_EQ(exponential_of_minus(~std::uint64_t{0}), 0u);
    static_assert(exponential_of_minus(std::uint64_t{1} << 32) > 790015000, "e^-1 is 0.36788");
}

TEST(ExponentialOfMinus, NeverGrows) {
    std::uint32_t before = exponential_of_minus(0);
    for (std::uint64_t x = 0; x < std::uint64_t{24} << 32; x += 77777777) {
        const std::uint32_t value = exponential_of_minus(x);
        ASSERT_LE(value, before);
        before = value;
    }
}

}  // namespace
}  // namespace fovea::test
