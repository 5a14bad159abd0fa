// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/reed_solomon.hpp>

namespace fovea::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

Span<std::uint8_t> span_of(Bytes& bytes) { return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}; }
Span<const std::uint8_t> span_of(const Bytes& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

template <class Code>
Bytes encoded(const Bytes& data, int parity) {
    Bytes tail(static_cast<std::size_t>(parity));
    EXPECT_EQ(Code::encode(span_of(data), span_of(tail)), Status::ok);
    Bytes block = data;
    block.insert(block.end(), tail.begin(), tail.end());
    return block;
}
Bytes random_bytes(Random& random, int size) {
    Bytes bytes(static_cast<std::size_t>(size));
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.between(0, 255));
    return bytes;
}
/// Different places of a block, in no order.
Bytes random_places(Random& random, std::size_t block, int count) {
    Bytes places(block);
    for (std::size_t i = 0; i < block; ++i) places[i] = static_cast<std::uint8_t>(i);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        std::swap(places[i], places[static_cast<std::size_t>(
                                 random.between(static_cast<int>(i), static_cast<int>(block) - 1))]);
    }
    places.resize(static_cast<std::size_t>(count));
    return places;
}
void spoil(Random& random, const Bytes& places, Bytes& block) {
    for (const std::uint8_t place : places) {
        block[place] = static_cast<std::uint8_t>(block[place] ^ random.between(1, 255));
    }
}

struct NumberedNames {
    template <class Code>
    static std::string GetName(int index) {
        return std::to_string(index);
    }
};
template <class Code>
class ReedSolomonOf : public testing::Test {};
using Codes = testing::Types<QrReedSolomon, DataMatrixReedSolomon>;
TYPED_TEST_SUITE(ReedSolomonOf, Codes, NumberedNames);

// ISO/IEC 18004, annex I: "01234567" in a symbol of version 1-M.
TEST(ReedSolomon, MakesTheParityOfTheQrStandardsExample) {
    const Bytes data = {0x10, 0x20, 0x0C, 0x56, 0x61, 0x80, 0xEC, 0x11,
                        0xEC, 0x11, 0xEC, 0x11, 0xEC, 0x11, 0xEC, 0x11};
    const Bytes block = encoded<QrReedSolomon>(data, 10);
    EXPECT_EQ(Bytes(block.begin() + 16, block.end()),
              (Bytes{0xA5, 0x24, 0xD4, 0xC1, 0xED, 0x36, 0xC7, 0x87, 0x2C, 0x55}));
}

// ISO/IEC 16022, annex O: "123456" in a symbol of 10x10.
TEST(ReedSolomon, MakesTheParityOfTheDataMatrixStandardsExample) {
    const Bytes block = encoded<DataMatrixReedSolomon>({142, 164, 186}, 5);
    EXPECT_EQ(Bytes(block.begin() + 3, block.end()), (Bytes{114, 25, 5, 88, 102}));
}

TYPED_TEST(ReedSolomonOf, MendsErrorsAndErasuresUpToItsBound) {
    Random random(101);
    for (int round = 0; round < 3000; ++round) {
        const int parity = random.between(1, max_reed_solomon_parity);
        const Bytes good = encoded<TypeParam>(
            random_bytes(random, random.between(1, max_reed_solomon_block - parity)), parity);
        const int reserve = random.between(0, parity);
        const int room = std::min(parity - reserve, static_cast<int>(good.size()));
        const int erased = random.between(0, room);
        const int errors = std::min((room - erased) / 2, static_cast<int>(good.size()) - erased);
        const Bytes places = random_places(random, good.size(), erased + errors);
        Bytes block = good;
        spoil(random, places, block);
        const Bytes erasures(places.begin(), places.begin() + erased);
        const Result<int> mended = TypeParam::decode(span_of(block), parity, span_of(erasures), reserve);
        ASSERT_TRUE(mended.ok()) << round;
        EXPECT_EQ(*mended, erased + errors);
        EXPECT_EQ(block, good);
    }
}

TYPED_TEST(ReedSolomonOf, CountsNoErasureThatWasRight) {
    Random random(102);
    const Bytes good = encoded<TypeParam>(random_bytes(random, 20), 10);
    Bytes block = good;
    block[3] ^= 1;
    EXPECT_EQ(*TypeParam::decode(span_of(block), 10, span_of(Bytes{3, 4, 5})), 1);
    EXPECT_EQ(block, good);
}

TYPED_TEST(ReedSolomonOf, LeavesAloneWhatItCannotMend) {
    Random random(103);
    int refused = 0;
    for (int round = 0; round < 2000; ++round) {
        const Bytes good = encoded<TypeParam>(random_bytes(random, 40), 10);
        Bytes spoiled = good;
        spoil(random, random_places(random, good.size(), 6), spoiled);
        Bytes block = spoiled;
        const Result<int> mended = TypeParam::decode(span_of(block), 10);
        if (mended.ok()) continue;  // another codeword was nearer: 1 of 5! at most
        ++refused;
        EXPECT_EQ(mended.status(), Status::undecided);
        EXPECT_EQ(block, spoiled);
    }
    EXPECT_GT(refused, 1950);
}

// Two codewords differ in 11 places. Up to six errors leave at least five to any other codeword; with a reserve
// of two only four are mended, so none of these blocks is mended wrongly.
TYPED_TEST(ReedSolomonOf, AReserveRefusesWhatIsTooFarFromACodeword) {
    Random random(104);
    for (int round = 0; round < 500; ++round) {
        const Bytes good = encoded<TypeParam>(random_bytes(random, 40), 10);
        for (int errors = 0; errors <= 6; ++errors) {
            Bytes block = good;
            spoil(random, random_places(random, good.size(), errors), block);
            EXPECT_EQ(TypeParam::decode(span_of(block), 10, {}, 2).ok(), errors <= 4);
        }
    }
}

TYPED_TEST(ReedSolomonOf, NoiseIsNoBlock) {
    Random random(105);
    int read = 0;
    for (int round = 0; round < 2000; ++round) {
        Bytes block = random_bytes(random, random.between(70, 255));
        if (TypeParam::decode(span_of(block), random.between(20, 68)).ok()) ++read;
    }
    EXPECT_EQ(read, 0);
}

TYPED_TEST(ReedSolomonOf, SaysWhatIsWrong) {
    Bytes block(255, 1);
    const Bytes before = block;
    const auto decode = [&](int size, int parity, const Bytes& erasures, int reserve) {
        return TypeParam::decode(span_of(block).first(size), parity, span_of(erasures), reserve).status();
    };
    EXPECT_EQ(decode(10, 0, {}, 0), Status::bad_argument);
    EXPECT_EQ(decode(255, 69, {}, 0), Status::bad_argument);
    EXPECT_EQ(decode(10, 10, {}, 0), Status::bad_argument);
    EXPECT_EQ(decode(20, 10, {}, 11), Status::bad_argument);
    EXPECT_EQ(decode(20, 10, {}, -1), Status::bad_argument);
    EXPECT_EQ(decode(20, 10, {20}, 0), Status::bad_argument);
    EXPECT_EQ(decode(20, 10, {2, 2}, 0), Status::bad_argument);
    EXPECT_EQ(decode(20, 2, {2, 3, 4}, 0), Status::undecided);
    Bytes long_block(256);
    EXPECT_EQ(TypeParam::decode(span_of(long_block), 10).status(), Status::bad_argument);
    EXPECT_EQ(block, before);

    Bytes parity(69, 7);
    EXPECT_EQ(TypeParam::encode(span_of(before), span_of(parity).first(1)), Status::bad_argument);
    EXPECT_EQ(TypeParam::encode(span_of(before).first(1), span_of(parity)), Status::bad_argument);
    EXPECT_EQ(TypeParam::encode(span_of(before).first(1), span_of(parity).first(0)), Status::bad_argument);
    EXPECT_EQ(parity, Bytes(69, 7));
}

TEST(ReedSolomon, WorksWhileCompiling) {
    constexpr auto mended = [] {
        std::uint8_t block[6] = {1, 2, 3, 4, 0, 0};
        const Status status = QrReedSolomon::encode({block, 4}, {block + 4, 2});
        block[2] = 200;
        const Result<int> changed = QrReedSolomon::decode({block, 6}, 2);
        return status == Status::ok && changed.ok() && *changed == 1 && block[2] == 3;
    };
    static_assert(mended(), "one error of two parity codewords is mended");
}

}  // namespace
}  // namespace fovea::test
