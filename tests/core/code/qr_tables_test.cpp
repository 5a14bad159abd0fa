// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/code/qr_tables.hpp>

namespace fovea::test {
namespace {

using namespace fovea::detail;

// ISO/IEC 18004, table 1.
TEST(QrTables, CountCodewordsAsTheStandard) {
    EXPECT_EQ(qr_codewords(1), 26);
    EXPECT_EQ(qr_codewords(2), 44);
    EXPECT_EQ(qr_codewords(7), 196);
    EXPECT_EQ(qr_codewords(14), 581);
    EXPECT_EQ(qr_codewords(21), 1156);
    EXPECT_EQ(qr_codewords(40), 3706);
}

TEST(QrTables, BlocksFillTheSymbolEachPlaceOnce) {
    for (int version = 1; version <= max_qr_version; ++version) {
        for (int level = 0; level < 4; ++level) {
            const QrBlocks blocks = qr_blocks(version, static_cast<QrLevel>(level));
            std::vector<int> taken(static_cast<std::size_t>(qr_codewords(version)));
            for (int b = 0; b < blocks.blocks; ++b)
                for (int i = 0; i < blocks.data(b) + blocks.parity; ++i)
                    ++taken.at(static_cast<std::size_t>(blocks.place(b, i)));
            EXPECT_EQ(taken, std::vector<int>(taken.size(), 1)) << version << ' ' << level;
        }
    }
}

// Table 9, versions 5-H and 32-Q.
TEST(QrTables, BlocksAreThoseOfTheStandard) {
    const QrBlocks five = qr_blocks(5, QrLevel::high);
    EXPECT_EQ(five.blocks, 4);
    EXPECT_EQ(five.short_blocks, 2);
    EXPECT_EQ(five.short_data, 11);
    EXPECT_EQ(five.parity, 22);
    const QrBlocks large = qr_blocks(32, QrLevel::quartile);
    EXPECT_EQ(large.blocks, 45);
    EXPECT_EQ(large.short_blocks, 10);
    EXPECT_EQ(large.short_data, 24);
    EXPECT_EQ(large.parity, 30);
    EXPECT_EQ(qr_misdecode_reserve(1, QrLevel::low), 3);
    EXPECT_EQ(qr_misdecode_reserve(1, QrLevel::medium), 2);
    EXPECT_EQ(qr_misdecode_reserve(1, QrLevel::high), 1);
    EXPECT_EQ(qr_misdecode_reserve(2, QrLevel::low), 2);
    EXPECT_EQ(qr_misdecode_reserve(3, QrLevel::low), 1);
    EXPECT_EQ(qr_misdecode_reserve(2, QrLevel::medium), 0);
}

// Annex E.
TEST(QrTables, AlignmentLinesAreThoseOfTheStandard) {
    const auto lines = [](int version) {
        std::vector<int> result;
        for (int i = 0; i < qr_alignment_lines(version); ++i) result.push_back(qr_alignment_line(version, i));
        return result;
    };
    EXPECT_EQ(lines(1), std::vector<int>());
    EXPECT_EQ(lines(2), (std::vector<int>{6, 18}));
    EXPECT_EQ(lines(7), (std::vector<int>{6, 22, 38}));
    EXPECT_EQ(lines(16), (std::vector<int>{6, 26, 50, 74}));
    EXPECT_EQ(lines(22), (std::vector<int>{6, 26, 50, 74, 98}));
    EXPECT_EQ(lines(32), (std::vector<int>{6, 34, 60, 86, 112, 138}));
    EXPECT_EQ(lines(36), (std::vector<int>{6, 24, 50, 76, 102, 128, 154}));
    EXPECT_EQ(lines(40), (std::vector<int>{6, 30, 58, 86, 114, 142, 170}));
}

// Annexes C and D: format M with mask 5, version 7.
TEST(QrTables, WordsAreThoseOfTheStandard) {
    EXPECT_EQ(qr_format_word({QrLevel::medium, 5}), 0x40CEU);
    EXPECT_EQ(qr_version_word(7), 0x07C94U);
}

TEST(QrTables, ThreeWrongBitsOfAWordAreMended) {
    for (int format = 0; format < 32; ++format) {
        const unsigned word = qr_format_word({static_cast<QrLevel>(format / 8), format % 8});
        for (int a = 0; a < 15; ++a)
            for (int b = 0; b < 15; ++b)
                EXPECT_EQ(nearest_qr_format(word ^ (1U << a | 1U << b | 1U << 7)), format);
    }
    for (int version = min_told_qr_version; version <= max_qr_version; ++version)
        for (int a = 0; a < 18; ++a)
            EXPECT_EQ(nearest_qr_version(qr_version_word(version) ^ (1U << a | 1U << 3 | 1U << 11)), version);
    // Eight apart, so that four wrong bits may be as near to another one, or to none.
    EXPECT_EQ(nearest_qr_version(qr_version_word(7) ^ 0xFU), 0);
}

}  // namespace
}  // namespace fovea::test
