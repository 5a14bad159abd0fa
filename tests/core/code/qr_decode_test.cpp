// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/qr_decode.hpp>
#include <fovea/code/qr_encode.hpp>

namespace fovea::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Modules = BitStorage<max_qr_size, max_qr_size>;

Span<std::uint8_t> span_of(Bytes& bytes) { return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}; }

/// A text and all that belongs to it.
struct Reading {
    Bytes room = Bytes(8000);
    Bytes scratch = Bytes(static_cast<std::size_t>(qr_decode_scratch()));
    CodeText text{span_of(room)};

    Result<QrSymbol> read(BitView<const BitWord> modules) {
        return qr_decode(modules, span_of(scratch), text);
    }
    std::string bytes() const { return std::string(text.bytes().begin(), text.bytes().end()); }
};

/// Data bits written by hand, put into a symbol of a version.
class Written {
public:
    explicit Written(int version, QrLevel level = QrLevel::medium)
        : version_(version),
          level_(level),
          data_(static_cast<std::size_t>(detail::qr_blocks(version, level).data_codewords())),
          bits_(span_of(data_)) {}

    Written& put(unsigned value, int count) {
        bits_.put(value, count);
        return *this;
    }
    Written& bytes(const std::string& text) {
        put(4, 4).put(static_cast<unsigned>(text.size()), 8);
        for (const char c : text) put(static_cast<unsigned char>(c), 8);
        return *this;
    }
    Written& alphanumeric(const std::string& text) {
        put(2, 4).put(static_cast<unsigned>(text.size()), 9);
        for (std::size_t i = 0; i < text.size(); i += 2) {
            const auto value = [&](std::size_t at) {
                return static_cast<unsigned>(
                    detail::qr_alphanumeric_value(static_cast<std::uint8_t>(text[at])));
            };
            if (i + 1 < text.size())
                put(value(i) * 45 + value(i + 1), 11);
            else
                put(value(i), 6);
        }
        return *this;
    }
    BitView<BitWord> symbol() {
        const int size = qr_size(version_);
        const BitView<BitWord> modules(storage_.view().first(), {size, size}, storage_.view().stride_words());
        Bytes codewords(static_cast<std::size_t>(detail::qr_codewords(version_)));
        EXPECT_EQ(
            detail::protect_qr_data(detail::qr_blocks(version_, level_), span_of(data_), span_of(codewords)),
            Status::ok);
        detail::draw_qr(version_, {level_, 3}, span_of(codewords), modules);
        return modules;
    }
    Result<QrSymbol> read(Reading& reading) { return reading.read(symbol()); }
    Status status() {
        Reading reading;
        const Status status = read(reading).status();
        EXPECT_EQ(reading.text.size(), 0);
        return status;
    }

private:
    int version_;
    QrLevel level_;
    Bytes data_;
    detail::QrBitWriter bits_;
    Modules storage_;
};

TEST(QrDecode, ReadsDigitsInTheirThreeLengths) {
    Reading reading;
    const auto symbol = Written(1).put(1, 4).put(8, 10).put(12, 10).put(345, 10).put(67, 7).read(reading);
    ASSERT_TRUE(symbol.ok());
    EXPECT_EQ(reading.bytes(), "01234567");
    EXPECT_EQ(symbol->aim_digit, '1');
    EXPECT_TRUE(reading.text.segments().empty());
}

TEST(QrDecode, TellsWhatItsBytesMean) {
    Reading reading;
    const auto symbol = Written(2).put(7, 4).put(26, 8).bytes("\xC3\xA9").read(reading);
    ASSERT_TRUE(symbol.ok());
    EXPECT_EQ(symbol->aim_digit, '2');
    ASSERT_EQ(reading.text.segments().size(), 1);
    EXPECT_EQ(reading.text.segments()[0].eci, 26);
    EXPECT_EQ(reading.bytes(), "\xC3\xA9");
}

TEST(QrDecode, ReadsInterpretationsOfTwoAndThreeBytes) {
    Reading reading;
    ASSERT_TRUE(Written(2)
                    .put(7, 4)
                    .put(0x8000 | 899, 16)
                    .bytes("a")
                    .put(7, 4)
                    .put(0xC00000 | 123456, 24)
                    .bytes("b")
                    .read(reading)
                    .ok());
    ASSERT_EQ(reading.text.segments().size(), 2);
    EXPECT_EQ(reading.text.segments()[0].eci, 899);
    EXPECT_EQ(reading.text.segments()[1].eci, 123456);
    EXPECT_EQ(reading.text.segments()[1].first, 1);
}

// Clause 7.4.6: 0x935F and 0xE4AA are 0x0D9F and 0x1AAA.
TEST(QrDecode, ReadsKanjiAsShiftJis) {
    Reading reading;
    ASSERT_TRUE(Written(1).put(8, 4).put(2, 8).put(0x0D9F, 13).put(0x1AAA, 13).read(reading).ok());
    EXPECT_EQ(reading.bytes(), "\x93\x5F\xE4\xAA");
    ASSERT_EQ(reading.text.segments().size(), 1);
    EXPECT_EQ(reading.text.segments()[0].eci, 20);
}

TEST(QrDecode, ReadsChineseCharactersAsGb2312) {
    Reading reading;
    const unsigned value = (0xB0 - 0xA6) * 0x60 + (0xA2 - 0xA1);
    ASSERT_TRUE(Written(1).put(13, 4).put(1, 4).put(1, 8).put(value, 13).read(reading).ok());
    EXPECT_EQ(reading.bytes(), "\xB0\xA2");
    EXPECT_EQ(reading.text.segments()[0].eci, 29);
}

TEST(QrDecode, AsciiAmongKanjiNeedsNoChangeOfMeaning) {
    Reading reading;
    ASSERT_TRUE(Written(2)
                    .put(8, 4)
                    .put(1, 8)
                    .put(0x0D9F, 13)
                    .bytes("a")
                    .put(8, 4)
                    .put(1, 8)
                    .put(0x0D9F, 13)
                    .bytes("\xFF")
                    .read(reading)
                    .ok());
    ASSERT_EQ(reading.text.segments().size(), 2);
    EXPECT_EQ(reading.text.segments()[1].first, 5);
    EXPECT_EQ(reading.text.segments()[1].eci, TextSegment::not_stated);
}

// Clause 7.4.8: with a function character in first position % is GS and %% is %.
TEST(QrDecode, Gs1DataSeparateWithPercentSigns) {
    Reading reading;
    const auto symbol = Written(3).put(5, 4).alphanumeric("10AB%21%%5%").bytes("%").read(reading);
    ASSERT_TRUE(symbol.ok());
    EXPECT_EQ(symbol->aim_digit, '3');
    EXPECT_EQ(reading.bytes(),
              "10AB\x1D"
              "21%5\x1D%");
}

TEST(QrDecode, AnIndustryStandsBeforeItsData) {
    Reading reading;
    EXPECT_EQ(Written(1).put(9, 4).put(37, 8).alphanumeric("AA").read(reading)->aim_digit, '5');
    EXPECT_EQ(reading.bytes(), "37AA");
    Reading letter;
    EXPECT_EQ(
        Written(1).put(7, 4).put(3, 8).put(9, 4).put('a' + 100, 8).alphanumeric("1").read(letter)->aim_digit,
        '6');
    EXPECT_EQ(letter.bytes(), "a1");
}

TEST(QrDecode, TellsWhichPartOfAMessageItIs) {
    Reading reading;
    const auto symbol = Written(1).put(3, 4).put(2, 4).put(4, 4).put(0x5A, 8).bytes("x").read(reading);
    ASSERT_TRUE(symbol.ok());
    EXPECT_EQ(symbol->append.position, 2);
    EXPECT_EQ(symbol->append.total, 5);
    EXPECT_EQ(symbol->append.parity, 0x5A);
}

TEST(QrDecode, RefusesContentsThatAreNone) {
    EXPECT_EQ(Written(1).put(1, 4).put(3, 10).put(1000, 10).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(1, 4).put(1, 10).put(10, 4).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(2, 4).put(2, 9).put(2025, 11).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(2, 4).put(1, 9).put(45, 6).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(4, 4).put(200, 8).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(1, 4).put(900, 10).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(2, 4).put(400, 9).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(8, 4).put(100, 8).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(8, 4).put(1, 8).put(0x3F, 13).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(7, 4).put(0xE0, 8).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(7, 4).put(0xC00000 | 1000000, 24).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(9, 4).put(120, 8).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(5, 4).put(5, 4).status(), Status::malformed);
    EXPECT_EQ(Written(1).put(3, 4).put(5, 4).put(2, 4).put(0, 8).status(), Status::malformed);
    EXPECT_EQ(Written(1).bytes("ab").put(6, 4).status(), Status::unsupported);
    EXPECT_EQ(Written(1).put(13, 4).put(2, 4).put(1, 8).status(), Status::unsupported);
}

TEST(QrDecode, TooManyChangesOfMeaningDoNotFit) {
    Written written(10);
    for (unsigned i = 0; i <= most_text_segments; ++i) {
        written.put(7, 4).put(30 + i, 8).put(4, 4).put(1, 16).put('a', 8);
    }
    EXPECT_EQ(written.status(), Status::capacity_exceeded);
}

TEST(QrDecode, AnotherTextBeforeItKeepsItsMeaning) {
    Reading reading;
    ASSERT_EQ(reading.text.begin_segment(26), Status::ok);
    ASSERT_EQ(reading.text.push('x'), Status::ok);
    ASSERT_TRUE(Written(1).bytes("y").read(reading).ok());
    EXPECT_EQ(reading.bytes(), "xy");
    ASSERT_EQ(reading.text.segments().size(), 2);
    EXPECT_EQ(reading.text.segments()[1].first, 1);
    EXPECT_EQ(reading.text.segments()[1].eci, TextSegment::not_stated);
}

TEST(QrDecode, ATextThatDoesNotFitLeavesTheOldOne) {
    Reading reading;
    reading.text = CodeText(span_of(reading.room).first(3));
    ASSERT_EQ(reading.text.push('x'), Status::ok);
    EXPECT_EQ(Written(1).bytes("abc").read(reading).status(), Status::buffer_too_small);
    EXPECT_EQ(reading.bytes(), "x");
}

TEST(QrDecode, MendsAsManyCodewordsAsTheStandardLets) {
    Random random(121);
    for (int version = 1; version <= 3; ++version) {
        for (int level = 0; level < 4; ++level) {
            const auto correction = static_cast<QrLevel>(level);
            Written written(version, correction);
            written.bytes("mended");
            const detail::QrBlocks blocks = detail::qr_blocks(version, correction);
            const int most = (blocks.parity - detail::qr_misdecode_reserve(version, correction)) / 2;
            for (const int wrong : {most, most + 1}) {
                const BitView<BitWord> modules = written.symbol();
                const int first = random.between(0, blocks.data_codewords());
                const int last_block = blocks.blocks * wrong;
                detail::along_qr_codewords(detail::QrPatterns(version), [&](int x, int y, int index) {
                    const int codeword = index / 8 - first % 3;
                    if (codeword >= 0 && codeword < last_block && index % 8 == 0)
                        modules.set(x, y, !modules(x, y));
                });
                Reading reading;
                const auto symbol = reading.read(modules);
                ASSERT_EQ(symbol.ok(), wrong == most) << version << ' ' << level;
                if (!symbol) {
                    EXPECT_EQ(symbol.status(), Status::undecided);
                    EXPECT_EQ(reading.text.size(), 0);
                    continue;
                }
                EXPECT_EQ(reading.bytes(), "mended");
                EXPECT_EQ(symbol->corrected_errors, last_block);
                EXPECT_LT(symbol->unused_correction, 25);
            }
        }
    }
}

TEST(QrDecode, OneCopyOfTheFormatIsEnough) {
    for (int copy = 0; copy < 2; ++copy) {
        for (int wrong = 0; wrong <= 15; ++wrong) {
            Written written(2);
            written.bytes("format");
            const BitView<BitWord> modules = written.symbol();
            for (int bit = 0; bit < wrong; ++bit) {
                const Point place = detail::qr_format_place(modules.width(), copy, bit);
                modules.set(place.x, place.y, !modules(place.x, place.y));
            }
            Reading reading;
            EXPECT_TRUE(reading.read(modules).ok()) << copy << ' ' << wrong;
        }
    }
}

TEST(QrDecode, ReadsAMirroredSymbol) {
    for (const int version : {1, 8}) {
        Modules modules;
        Bytes text = {'m', 'i', 'r', 'r', 'o', 'r'};
        QrEncodeOptions options;
        options.min_version = version;
        Bytes scratch(static_cast<std::size_t>(qr_encode_scratch(6)));
        const auto symbol = qr_encode(span_of(text), options, span_of(scratch), modules.view());
        ASSERT_TRUE(symbol.ok());
        Modules turned;
        const BitView<BitWord> mirrored(turned.view().first(), symbol->size(), turned.view().stride_words());
        for (int y = 0; y < symbol->height(); ++y)
            for (int x = 0; x < symbol->width(); ++x) mirrored.set(y, x, (*symbol)(x, y));
        Reading reading;
        const auto told = reading.read(mirrored);
        ASSERT_TRUE(told.ok());
        EXPECT_TRUE(told->mirrored);
        EXPECT_EQ(reading.bytes(), "mirror");
    }
}

TEST(QrDecode, ASizeThatContradictsTheVersionIsMalformed) {
    Written written(7);
    written.bytes("v");
    const BitView<BitWord> modules = written.symbol();
    for (int copy = 0; copy < 2; ++copy) {
        for (int bit = 0; bit < 18; ++bit) {
            const Point place = detail::qr_version_place(modules.width(), copy, bit);
            modules.set(place.x, place.y, (detail::qr_version_word(9) >> bit & 1) != 0);
        }
    }
    Reading reading;
    EXPECT_EQ(reading.read(modules).status(), Status::malformed);
}

TEST(QrDecode, NoiseIsNoSymbol) {
    Random random(122);
    Modules modules;
    for (int round = 0; round < 300; ++round) {
        const int size = qr_size(round % max_qr_version + 1);
        const BitView<BitWord> view(modules.view().first(), {size, size}, modules.view().stride_words());
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) view.set(x, y, random.between(0, 1) != 0);
        Reading reading;
        EXPECT_FALSE(reading.read(view).ok());
        EXPECT_EQ(reading.text.size(), 0);
    }
}

TEST(QrDecode, SaysWhatIsWrong) {
    Reading reading;
    Modules modules;
    const auto sized = [&](int width, int height) {
        return reading.read(BitView<const BitWord>(modules.view().first(), {width, height}, 6)).status();
    };
    EXPECT_EQ(sized(0, 0), Status::empty_image);
    EXPECT_EQ(sized(21, 25), Status::size_mismatch);
    EXPECT_EQ(sized(17, 17), Status::size_mismatch);
    EXPECT_EQ(sized(22, 22), Status::size_mismatch);
    EXPECT_EQ(sized(21, 21), Status::not_found);
    EXPECT_EQ(qr_decode(BitView<const BitWord>(modules.view().first(), {21, 21}, 6),
                        span_of(reading.scratch).first(qr_decode_scratch(1) - 1), reading.text)
                  .status(),
              Status::scratch_too_small);
}

}  // namespace
}  // namespace fovea::test
