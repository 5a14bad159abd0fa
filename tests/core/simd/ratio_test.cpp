// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include <fovea/simd/ratio.hpp>

namespace fovea::test {
namespace {

constexpr std::size_t lanes = static_cast<std::size_t>(simd::lanes);

/// ratio_of<Bits>() and twice() of every part of every whole, in lanes beside other ones.
template <int Bits>
void check_every_pair() {
    for (int whole = 1; whole < 256; ++whole)
        for (int first = 0; first <= whole; first += simd::lanes) {
            std::array<std::uint8_t, lanes> part{};
            std::array<std::uint8_t, lanes> quotient{};
            std::array<std::uint8_t, lanes> rest{};
            for (std::size_t i = 0; i < lanes; ++i)
                part[i] = static_cast<std::uint8_t>((first + static_cast<int>(i)) % (whole + 1));
            const auto divisor = simd::Bytes::all(static_cast<std::uint8_t>(whole));
            const simd::Ratio ratio = simd::ratio_of<Bits>(simd::Bytes::load(part.data()), divisor);
            ratio.quotient.store(quotient.data());
            ratio.rest.store(rest.data());
            for (std::size_t i = 0; i < lanes; ++i) {
                const int product = part[i] * ((1 << Bits) - 1);
                ASSERT_EQ(quotient[i], product / whole) << int{part[i]} << " of " << whole;
                ASSERT_EQ(rest[i], product % whole) << int{part[i]} << " of " << whole;
            }
            if (Bits == 8) continue;
            const simd::Ratio doubled = twice(ratio, divisor);
            doubled.quotient.store(quotient.data());
            doubled.rest.store(rest.data());
            for (std::size_t i = 0; i < lanes; ++i) {
                const int product = 2 * part[i] * ((1 << Bits) - 1);
                ASSERT_EQ(quotient[i], product / whole) << int{part[i]} << " of " << whole;
                ASSERT_EQ(rest[i], product % whole) << int{part[i]} << " of " << whole;
            }
        }
}

TEST(Ratio, IsExactForEveryPartOfEveryWhole) {
    check_every_pair<1>();
    check_every_pair<4>();
    check_every_pair<5>();
    check_every_pair<7>();
    check_every_pair<8>();
}

}  // namespace
}  // namespace fovea::test
