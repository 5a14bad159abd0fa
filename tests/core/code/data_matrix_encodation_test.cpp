// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/code/data_matrix_encodation.hpp>

namespace fovea::test {
namespace {

/// The codewords of a text in a symbol that has room for so many; none if it does not fit.
std::vector<int> codewords_of(const std::string& text, int room) {
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(data_matrix_encodation_scratch(static_cast<std::int64_t>(text.size()))));
    std::vector<std::uint8_t> codewords(static_cast<std::size_t>(room));
    const DataMatrixEncodation encodation(
        {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())}, false,
        {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
    if (encodation.write(0, {codewords.data(), room}) != Status::ok) return {};
    return {codewords.begin(), codewords.end()};
}

TEST(DataMatrixEncodation, WritesTheExamplesOfTheStandard) {
    EXPECT_EQ(codewords_of("123456", 3), (std::vector<int>{142, 164, 186}));
    EXPECT_EQ(codewords_of("AIMAIMAIM", 8), (std::vector<int>{230, 91, 11, 91, 11, 91, 11, 254}));
    // Without an unlatch where the symbol is full.
    EXPECT_EQ(codewords_of("AIMAIMAIM", 7), (std::vector<int>{230, 91, 11, 91, 11, 91, 11}));
    // The last character as ASCII, or the first: one codeword more.
    EXPECT_FALSE(codewords_of("AIMAIMAIMA", 8).empty());
    EXPECT_TRUE(codewords_of("AIMAIMAIMA", 7).empty());
}

TEST(DataMatrixEncodation, PadsWithNoise) {
    // ISO/IEC 16022, annex B.1: 129 at first; at place 4 149 * 4 = 596 is 90 by 253, 129 + 91 = 220; at place
    // 5 745 is 239, and 129 + 240 = 369 less 254.
    EXPECT_EQ(codewords_of("AB", 5), (std::vector<int>{66, 67, 129, 220, 115}));
}

TEST(DataMatrixEncodation, DoesNotFitIntoLess) {
    EXPECT_TRUE(codewords_of("123456", 2).empty());
    EXPECT_TRUE(codewords_of("AIMAIMAIM", 6).empty());
}

}  // namespace
}  // namespace fovea::test
