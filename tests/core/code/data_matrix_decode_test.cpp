// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/data_matrix_decode.hpp>
#include <fovea/code/data_matrix_encode.hpp>

namespace fovea::test {
namespace {

using Modules = BitStorage<max_data_matrix_side, max_data_matrix_side>;

/// The text of a symbol and what was read of it.
struct Bench {
    Modules modules;
    std::vector<std::uint8_t> scratch = std::vector<std::uint8_t>(60000);
    std::uint8_t room[4000] = {};

    Span<std::uint8_t> all() { return {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}; }
    BitView<BitWord> view(Size size) { return {modules.view().first(), size, modules.view().stride_words()}; }
    Size encode(const std::string& text, Size wanted) {
        DataMatrixOptions options;
        options.size = wanted;
        const auto made = data_matrix_encode(
            {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())},
            options, all(), modules.view());
        EXPECT_TRUE(made.ok());
        return made ? *made : Size{};
    }
    Result<DataMatrixReading> decode(Size size, std::string* text = nullptr) {
        CodeText read(room);
        const auto reading = data_matrix_decode(view(size), all(), read);
        if (text != nullptr)
            text->assign(reinterpret_cast<const char*>(room), static_cast<std::size_t>(read.size()));
        return reading;
    }
};

TEST(DataMatrixDecode, MendsAsManyErrorsAsTheParityAllows) {
    Random random(3);
    for (const DataMatrixSize& size : data_matrix_sizes) {
        Bench bench;
        const Size modules = bench.encode("7", {size.columns, size.rows});
        std::vector<BitWord> words(data_matrix_placement_scratch);
        const Span<BitWord> scratch(words.data(), static_cast<std::ptrdiff_t>(words.size()));
        std::vector<std::uint8_t> codewords(static_cast<std::size_t>(size.codewords()));
        const Span<std::uint8_t> all(codewords.data(), size.codewords());
        ASSERT_EQ(data_matrix_codewords(bench.view(modules), size, scratch, all), Status::ok);
        // Half of the parity of every block, at its beginning or end.
        const int most = size.block_parity() / 2;
        for (int b = 0; b < size.blocks; ++b)
            for (int i = 0; i < most; ++i)
                codewords[static_cast<std::size_t>(b + i * size.blocks)] ^=
                    static_cast<std::uint8_t>(random.between(1, 255));
        ASSERT_EQ(data_matrix_modules(all, size, scratch, bench.view(modules)), Status::ok);
        std::string text;
        const auto reading = bench.decode(modules, &text);
        ASSERT_TRUE(reading.ok()) << int{size.rows} << "x" << int{size.columns};
        EXPECT_EQ(text, "7");
        EXPECT_EQ(reading->corrected_errors, most * size.blocks);
        EXPECT_EQ(reading->unused_correction, 0);
    }
}

TEST(DataMatrixDecode, ForgivesAFifthOfTheBorders) {
    Bench bench;
    const Size size = bench.encode("fovea", {12, 12});
    // 44 modules of border: 8 may be wrong.
    for (int x = 0; x < 8; ++x) bench.modules.view().set(x, 11, false);
    EXPECT_TRUE(bench.decode(size).ok());
    bench.modules.view().set(8, 11, false);
    EXPECT_EQ(bench.decode(size).status(), Status::not_found);
}

TEST(DataMatrixDecode, SaysWhatIsWrongAndLeavesTheText) {
    Bench bench;
    const Size size = bench.encode("fovea", {12, 12});
    std::uint8_t bytes[3] = {};
    CodeText text(bytes);
    EXPECT_EQ(data_matrix_decode({}, bench.all(), text).status(), Status::empty_image);
    EXPECT_EQ(data_matrix_decode(bench.view({12, 13}), bench.all(), text).status(), Status::size_mismatch);
    EXPECT_EQ(data_matrix_decode(bench.view(size), bench.all().first(50), text).status(),
              Status::scratch_too_small);
    EXPECT_EQ(data_matrix_decode(bench.view(size), bench.all(), text).status(), Status::buffer_too_small);
    for (int y = 1; y < 11; ++y)
        for (int x = 1; x < 11; ++x) bench.modules.view().set(x, y, (x * y + x / 2) % 2 == 0);
    EXPECT_EQ(data_matrix_decode(bench.view(size), bench.all(), text).status(), Status::undecided);
    EXPECT_EQ(text.size(), 0);
}

TEST(DataMatrixDecode, EndsWithAStatusWhateverTheModules) {
    Random random(4);
    Bench bench;
    int read = 0;
    for (int round = 0; round < 4000; ++round) {
        const DataMatrixSize& size = data_matrix_sizes[random.between(0, data_matrix_size_count - 1)];
        const bool borders = round % 2 == 0;
        for (int y = 0; y < size.rows; ++y)
            for (int x = 0; x < size.columns; ++x) {
                const DataMatrixModule module = data_matrix_border(size, x, y);
                const bool chance = random.between(0, 1) != 0;
                bench.modules.view().set(
                    x, y,
                    borders && module != DataMatrixModule::data ? module == DataMatrixModule::dark : chance);
            }
        read += bench.decode({size.columns, size.rows}).ok() ? 1 : 0;
    }
    EXPECT_EQ(read, 0);
}

}  // namespace
}  // namespace fovea::test
