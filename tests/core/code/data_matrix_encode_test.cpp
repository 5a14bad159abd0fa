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

Span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())};
}
Result<Size> encode(const std::string& text, const DataMatrixOptions& options, Modules& modules) {
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(data_matrix_encode_scratch(static_cast<std::int64_t>(text.size()))));
    return data_matrix_encode(bytes_of(text), options,
                              {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, modules.view());
}
struct Read {
    Status status = Status::ok;
    DataMatrixReading reading;
    std::string text;
    std::vector<TextSegment> segments;
};
Read decode(const Modules& modules, Size size) {
    std::vector<std::uint8_t> room(4000);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(data_matrix_decode_scratch));
    CodeText text({room.data(), static_cast<std::ptrdiff_t>(room.size())});
    const BitView<const BitWord> view = modules.view();
    const auto reading =
        data_matrix_decode({view.first(), size, view.stride_words()},
                           {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, text);
    Read read;
    read.status = reading.status();
    if (reading) read.reading = *reading;
    read.text.assign(reinterpret_cast<const char*>(text.bytes().data()),
                     static_cast<std::size_t>(text.size()));
    for (const TextSegment segment : text.segments()) read.segments.push_back(segment);
    return read;
}
TEST(DataMatrixEncode, GivesTheCodewordsOfTheExample) {
    // ISO/IEC 16022, annex O: "123456" is 142 164 186 and 114 25 5 88 102.
    Modules modules;
    const Result<Size> size = encode("123456", {}, modules);
    ASSERT_TRUE(size.ok());
    EXPECT_EQ(*size, (Size{10, 10}));
    const BitView<BitWord> view = modules.view();
    std::vector<BitWord> words(data_matrix_placement_scratch);
    std::uint8_t codewords[8] = {};
    ASSERT_EQ(data_matrix_codewords(BitView<const BitWord>(view.first(), *size, view.stride_words()),
                                    data_matrix_sizes[0],
                                    {words.data(), static_cast<std::ptrdiff_t>(words.size())}, codewords),
              Status::ok);
    const std::uint8_t standard[8] = {142, 164, 186, 114, 25, 5, 88, 102};
    for (int i = 0; i < 8; ++i) EXPECT_EQ(codewords[i], standard[i]) << i;
}

TEST(DataMatrixEncode, EverySizeReadsBackFullAndNearlyEmpty) {
    Random random(17);
    for (const DataMatrixSize& size : data_matrix_sizes) {
        for (const int length : {1, size.data / 2, size.data - 3, 2 * size.data}) {
            if (length < 1) continue;
            std::string text;
            for (int i = 0; i < length; ++i)
                text += static_cast<char>(length == 2 * size.data ? random.between('0', '9')
                                                                  : random.between(0, 127));
            DataMatrixOptions options;
            options.size = {size.columns, size.rows};
            Modules modules;
            const Result<Size> made = encode(text, options, modules);
            ASSERT_TRUE(made.ok()) << int{size.rows} << "x" << int{size.columns} << " " << length;
            const Read read = decode(modules, *made);
            ASSERT_EQ(read.status, Status::ok) << int{size.rows} << "x" << int{size.columns};
            EXPECT_EQ(read.text, text);
            EXPECT_EQ(read.reading.corrected_errors, 0);
        }
    }
}

TEST(DataMatrixEncode, EveryMixtureOfSchemesReadsBack) {
    Random random(18);
    const std::string alphabets[] = {"0123456789",
                                     "ABCDEFGHIJKLMNOPQRSTUVWXYZ 0123456789",
                                     "abcdefghijklmnopqrstuvwxyz 0123456789",
                                     "ABC*>\r 123",
                                     "ABC!\"#$%&'()*+,-./:;<=>?@[\\]^1",
                                     "\x01\x1d\x7f`{}~_^",
                                     "\xe4\xf6\xfc\xc4\xff\x80"};
    for (int round = 0; round < 6000; ++round) {
        std::string text;
        const int pieces = random.between(1, 5);
        for (int piece = 0; piece < pieces; ++piece) {
            const std::string& alphabet = alphabets[random.between(0, 6)];
            const int length = random.between(1, random.between(1, round % 50 == 0 ? 600 : 20));
            for (int i = 0; i < length; ++i)
                text += alphabet[static_cast<std::size_t>(
                    random.between(0, static_cast<int>(alphabet.size()) - 1))];
        }
        DataMatrixOptions options;
        options.shape = static_cast<DataMatrixShape>(random.between(0, 2));
        options.extended = random.between(0, 1) != 0;
        options.gs1 = random.between(0, 3) == 0;
        if (random.between(0, 3) == 0) options.eci = random.between(0, 999999);
        Modules modules;
        const Result<Size> made = encode(text, options, modules);
        if (!made) {
            EXPECT_EQ(made.status(), Status::capacity_exceeded);
            continue;
        }
        const Read read = decode(modules, *made);
        ASSERT_EQ(read.status, Status::ok) << round << " " << text;
        ASSERT_EQ(read.text, text) << round;
        const int fnc1 = options.gs1 ? 1 : 0;
        EXPECT_EQ(read.reading.message.aim_digit, static_cast<char>('1' + fnc1 + (options.eci >= 0 ? 3 : 0)));
        if (options.eci >= 0) {
            ASSERT_EQ(read.segments.size(), 1U);
            EXPECT_EQ(read.segments[0].eci, options.eci);
        }
    }
}

TEST(DataMatrixEncode, TakesTheSchemeWithTheFewestCodewords) {
    const auto size_for = [](const std::string& text) {
        Modules modules;
        return encode(text, {}, modules)->width;
    };
    EXPECT_EQ(size_for("123456"), 10);                        // digits in pairs: 3
    EXPECT_EQ(size_for("ABCDEF"), 12);                        // C40: latch and 4, no unlatch: 5
    EXPECT_EQ(size_for("abcdef"), 12);                        // Text
    EXPECT_EQ(size_for("A*B>C\r"), 12);                       // X12
    EXPECT_EQ(size_for("AIMAIMAIMAIM"), 16);                  // C40: 9
    EXPECT_EQ(size_for("\xe4\xf6\xfc\xe4\xf6"), 14);          // Base 256: latch, length and 5
    EXPECT_EQ(size_for(".A.C1.3.DATA.123DATA.123DATA"), 20);  // EDIFACT
}

TEST(DataMatrixEncode, SaysWhatIsWrongAndDrawsNothing) {
    Modules modules;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(data_matrix_encode_scratch(4000)));
    const Span<std::uint8_t> all(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    const std::string letters = "ABC";
    const std::string more_letters = "ABCDEFGHIJ";
    const auto text = bytes_of(letters);
    DataMatrixOptions odd_size;
    odd_size.size = {11, 11};
    DataMatrixOptions far_eci;
    far_eci.eci = 1000000;
    DataMatrixOptions small;
    small.size = {10, 10};
    EXPECT_EQ(data_matrix_encode(text, {}, all, {}).status(), Status::empty_image);
    EXPECT_EQ(data_matrix_encode({}, {}, all, modules.view()).status(), Status::bad_argument);
    EXPECT_EQ(data_matrix_encode(text, odd_size, all, modules.view()).status(), Status::bad_argument);
    EXPECT_EQ(data_matrix_encode(text, far_eci, all, modules.view()).status(), Status::bad_argument);
    EXPECT_EQ(data_matrix_encode(text, {}, all.first(100), modules.view()).status(),
              Status::scratch_too_small);
    EXPECT_EQ(data_matrix_encode(bytes_of(more_letters), small, all, modules.view()).status(),
              Status::capacity_exceeded);
    const std::string long_text(max_data_matrix_text + 1, '1');
    EXPECT_EQ(data_matrix_encode(bytes_of(long_text), {}, all, modules.view()).status(),
              Status::capacity_exceeded);
    BitStorage<9, 40> narrow;
    EXPECT_EQ(data_matrix_encode(text, {}, all, narrow.view()).status(), Status::buffer_too_small);
    for (int y = 0; y < max_data_matrix_side; ++y)
        for (int x = 0; x < max_data_matrix_side; ++x) ASSERT_FALSE(modules.view()(x, y));
}

}  // namespace
}  // namespace fovea::test
