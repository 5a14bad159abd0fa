// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
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
Bytes bytes_of(const std::string& text) { return Bytes(text.begin(), text.end()); }

Result<BitView<BitWord>> encode(const std::string& text, const QrEncodeOptions& options, Modules& modules) {
    Bytes bytes = bytes_of(text);
    Bytes scratch(static_cast<std::size_t>(qr_encode_scratch(static_cast<std::int64_t>(bytes.size()))));
    return qr_encode(span_of(bytes), options, span_of(scratch), modules.view());
}
std::string picture(BitView<const BitWord> modules) {
    std::string lines;
    for (int y = 0; y < modules.height(); ++y) {
        for (int x = 0; x < modules.width(); ++x) lines += modules(x, y) ? '#' : '.';
        lines += '\n';
    }
    return lines;
}
std::string decoded(BitView<const BitWord> modules, QrSymbol& symbol) {
    Bytes room(8000);
    Bytes scratch(static_cast<std::size_t>(qr_decode_scratch()));
    CodeText text{span_of(room)};
    const Result<QrSymbol> result = qr_decode(modules, span_of(scratch), text);
    EXPECT_EQ(result.status(), Status::ok);
    if (!result) return "";
    symbol = *result;
    return std::string(text.bytes().begin(), text.bytes().end());
}

// ISO/IEC 18004, annex I: "01234567" as 1-M with mask 2, figure I.2.
TEST(QrEncode, WritesTheSymbolOfTheStandard) {
    Modules modules;
    QrEncodeOptions options;
    options.mask = 2;
    const auto symbol = encode("01234567", options, modules);
    ASSERT_TRUE(symbol.ok());
    EXPECT_EQ(picture(*symbol),
              "#######..#.##.#######\n#.....#..####.#.....#\n#.###.#.#.....#.###.#\n#.###.#.##....#.###.#\n"
              "#.###.#.#.###.#.###.#\n#.....#.#...#.#.....#\n#######.#.#.#.#######\n........#..##........\n"
              "#.#####..#..#.#####..\n...#.#.##.#.#..#.##..\n..#...##.#.#.#..#####\n....#....#.....####..\n"
              "...######..#.#..#....\n........#.#####..##..\n#######..##.#.##.....\n#.....#.#.#####...#.#\n"
              "#.###.#.#...#..#.##..\n#.###.#.##..#..#.....\n#.###.#.#.##.#..#.#..\n#.....#........##.##.\n"
              "#######.####.#..#.#..\n");
}

TEST(QrEncode, EveryVersionAndLevelIsReadBack) {
    Random random(111);
    Modules modules;
    for (int version = 1; version <= max_qr_version; ++version) {
        for (int level = 0; level < 4; ++level) {
            QrEncodeOptions options;
            options.level = static_cast<QrLevel>(level);
            options.min_version = version;
            options.mask = (version + level) % 8;
            const int data = detail::qr_blocks(version, options.level).data_codewords();
            std::string text;
            for (int i = 0; i < data - 3; ++i) text += static_cast<char>(random.between(0, 255));
            const auto symbol = encode(text, options, modules);
            ASSERT_TRUE(symbol.ok());
            ASSERT_EQ(symbol->width(), qr_size(version)) << version << ' ' << level;
            QrSymbol told;
            EXPECT_EQ(decoded(*symbol, told), text);
            EXPECT_EQ(told.version, version);
            EXPECT_EQ(told.level, options.level);
            EXPECT_EQ(told.mask, options.mask);
            EXPECT_EQ(told.corrected_errors, 0);
            EXPECT_EQ(told.unused_correction, 100);
        }
    }
}

TEST(QrEncode, MixedTextsAreReadBackInFewBits) {
    Random random(112);
    Modules modules;
    const std::string kinds[3] = {"0123456789", "ABCXYZ $%*+-./:", "abcxyz\xE4\xFF\n"};
    for (int round = 0; round < 400; ++round) {
        std::string text;
        const int runs = random.between(1, 8);
        for (int run = 0; run < runs; ++run) {
            const std::string& kind = kinds[random.between(0, 2)];
            const int length = random.between(1, 30);
            for (int i = 0; i < length; ++i)
                text += kind[static_cast<std::size_t>(random.between(0, static_cast<int>(kind.size()) - 1))];
        }
        QrEncodeOptions options;
        options.level = static_cast<QrLevel>(random.between(0, 3));
        if (round % 3 == 0) options.eci = 26;
        const auto symbol = encode(text, options, modules);
        ASSERT_TRUE(symbol.ok());
        QrSymbol told;
        EXPECT_EQ(decoded(*symbol, told), text) << round;
        EXPECT_EQ(told.aim_digit, round % 3 == 0 ? '2' : '1');
    }
}

// A change of mode costs a header of 12 to 14 bits, which digits and the 45 characters must save.
TEST(QrEncode, ChangesModesWhereThatIsShorter) {
    const auto modes = [](const std::string& text, int version) {
        Bytes bytes = bytes_of(text);
        Bytes ways(bytes.size());
        const detail::QrSegmentation segments(span_of(bytes), span_of(ways), version);
        std::string result;
        for (std::size_t i = 0; i < text.size(); ++i)
            result += "NAB"[static_cast<int>(segments.mode(static_cast<std::ptrdiff_t>(i)))];
        return result;
    };
    EXPECT_EQ(modes("0123456789", 1), "NNNNNNNNNN");
    EXPECT_EQ(modes("AB12", 1), "AAAA");
    EXPECT_EQ(modes("abc12", 1), "BBBBB");
    EXPECT_EQ(modes("a1234567890", 1), "BNNNNNNNNNN");
    EXPECT_EQ(modes("ABCDEFGHIJKLMNOP/abc", 1), "AAAAAAAAAAAAAAAAABBB");
}

TEST(QrEncode, TakesTheMaskOfTheFewestPoints) {
    Modules best;
    Modules other;
    const auto symbol = encode("HTTPS://EXAMPLE.ORG/", {}, best);
    const int points = detail::qr_mask_penalty(*symbol);
    for (int mask = 0; mask < 8; ++mask) {
        QrEncodeOptions options;
        options.mask = mask;
        EXPECT_GE(detail::qr_mask_penalty(*encode("HTTPS://EXAMPLE.ORG/", options, other)), points);
    }
}

TEST(QrEncode, AnEmptyTextIsASymbolToo) {
    Modules modules;
    QrSymbol told;
    EXPECT_EQ(decoded(*encode("", {}, modules), told), "");
    EXPECT_EQ(told.version, 1);
}

TEST(QrEncode, HoldsAsMuchAsTheStandardSays) {
    Modules modules;
    QrEncodeOptions options;
    options.mask = 0;
    const struct {
        QrLevel level;
        int digits, characters, bytes;
    } most[] = {{QrLevel::low, 7089, 4296, 2953},
                {QrLevel::medium, 5596, 3391, 2331},
                {QrLevel::quartile, 3993, 2420, 1663},
                {QrLevel::high, 3057, 1852, 1273}};
    for (const auto& m : most) {
        options.level = m.level;
        for (const auto& [count, sign] : {std::pair(m.digits, '7'), {m.characters, 'A'}, {m.bytes, 'a'}}) {
            EXPECT_TRUE(encode(std::string(static_cast<std::size_t>(count), sign), options, modules).ok());
            if (count == max_qr_text) continue;
            EXPECT_EQ(
                encode(std::string(static_cast<std::size_t>(count) + 1, sign), options, modules).status(),
                Status::capacity_exceeded);
        }
    }
}

TEST(QrEncode, SaysWhatIsWrong) {
    Modules modules;
    QrEncodeOptions options;
    const auto with = [&](auto change) {
        QrEncodeOptions changed;
        change(changed);
        return encode("A", changed, modules).status();
    };
    EXPECT_EQ(with([](auto& o) { o.min_version = 0; }), Status::bad_argument);
    EXPECT_EQ(with([](auto& o) { o.min_version = 41; }), Status::bad_argument);
    EXPECT_EQ(with([](auto& o) { o.mask = 8; }), Status::bad_argument);
    EXPECT_EQ(with([](auto& o) { o.mask = -2; }), Status::bad_argument);
    EXPECT_EQ(with([](auto& o) { o.eci = 1000000; }), Status::bad_argument);
    EXPECT_EQ(with([](auto& o) { o.level = static_cast<QrLevel>(4); }), Status::bad_argument);
    EXPECT_EQ(encode(std::string(7090, '1'), options, modules).status(), Status::bad_argument);
    Bytes text = {'A'};
    Bytes scratch(static_cast<std::size_t>(qr_encode_scratch(1)));
    EXPECT_EQ(qr_encode(span_of(text), options, span_of(scratch).from(1), modules.view()).status(),
              Status::scratch_too_small);
    BitStorage<21, 20> small;
    EXPECT_EQ(qr_encode(span_of(text), options, span_of(scratch), small.view()).status(),
              Status::buffer_too_small);
    EXPECT_EQ(picture(small.view()).find('#'), std::string::npos);
    EXPECT_EQ(picture(modules.view()).find('#'), std::string::npos);
}

}  // namespace
}  // namespace fovea::test
