// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include <fovea/base/random.hpp>
#include <fovea/simd/weighed_words.hpp>

namespace fovea::test {
namespace {

#if FOVEA_BYTES >= 8

TEST(WeighWords, IsTheMeanOfEveryTriple) {
    constexpr int count = simd::lanes / 2;
    constexpr simd::TripleWeights weights{9797, 19235, 3736};
    Random random(44);
    for (int run = 0; run < 3000; ++run) {
        std::uint16_t values[3][count];
        for (auto& part : values)
            for (std::uint16_t& value : part)
                value = run == 0 ? std::uint16_t{255} : static_cast<std::uint16_t>(random.below(256));
        simd::RawWords part[3];
        std::memcpy(part, values, sizeof part);
        const simd::RawWords means = simd::weigh_words(part[0], part[1], part[2], weights);
        std::uint16_t got[count];
        std::memcpy(got, &means, sizeof got);
        for (int i = 0; i < count; ++i)
            ASSERT_EQ(got[i], weights.mean(static_cast<std::uint8_t>(values[0][i]),
                                           static_cast<std::uint8_t>(values[1][i]),
                                           static_cast<std::uint8_t>(values[2][i])));
    }
}

#endif

}  // namespace
}  // namespace fovea::test
