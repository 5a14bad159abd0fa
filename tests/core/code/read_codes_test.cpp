// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/code/read_codes.hpp>
#include <make_code/make_code_command.hpp>

namespace fovea::test {
namespace {

/// A light picture.
struct Sheet {
    Size size;
    std::vector<Gray8> pixels;

    explicit Sheet(Size s) : size(s), pixels(static_cast<std::size_t>(s.area()), 230) {}
    ImageView<const Gray8> view() const { return {pixels.data(), size, size.width}; }
    /// Draws a text as a code with its upper left corner at a place.
    void draw(Point at, Symbology symbology, const std::string& text, int module) {
        apps::CodeDesign design;
        design.symbology = symbology;
        apps::CodeModules modules;
        ASSERT_EQ(apps::modules_of(text, design, modules), "");
        const apps::Picture<Gray8> picture = apps::detail::picture_of(modules, 40, module, false);
        for (int y = 0; y < picture.size.height; ++y) {
            for (int x = 0; x < picture.size.width; ++x) {
                pixels[static_cast<std::size_t>((at.y + y) * size.width + at.x + x)] =
                    static_cast<Gray8>(picture.view()(x, y) == 0 ? 30 : 230);
            }
        }
    }
};

struct Read {
    Status status = Status::ok;
    std::vector<Code> codes;
    std::vector<std::string> texts;
};
Read read(const Sheet& sheet, const ReadCodesOptions& options = {}, int capacity = 32) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_codes_scratch(sheet.size)));
    std::vector<std::uint8_t> room(4096);
    CodeText text({room.data(), 4096});
    Read result;
    result.codes.resize(static_cast<std::size_t>(capacity));
    int count = 0;
    result.status =
        read_codes(sheet.view(), options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, text,
                   ListView<Code>(result.codes.data(), capacity, &count));
    result.codes.resize(static_cast<std::size_t>(count));
    for (const Code& code : result.codes) {
        result.texts.emplace_back(room.begin() + code.text_first,
                                  room.begin() + code.text_first + code.text_size);
    }
    return result;
}

Sheet all_kinds() {
    Sheet sheet({700, 520});
    sheet.draw({10, 10}, Symbology::ean_13, "9780905705712", 2);
    sheet.draw({350, 10}, Symbology::code_128, "LOT-42", 2);
    sheet.draw({10, 200}, Symbology::qr, "https://fovea.example/1", 5);
    sheet.draw({350, 200}, Symbology::data_matrix, "part 4711", 6);
    return sheet;
}

TEST(ReadCodes, ReadsBarsAndMatricesOfOneImage) {
    const Read result = read(all_kinds());
    EXPECT_EQ(result.status, Status::ok);
    std::vector<std::string> texts = result.texts;
    std::sort(texts.begin(), texts.end());
    EXPECT_EQ(texts,
              (std::vector<std::string>{"9780905705712", "LOT-42", "https://fovea.example/1", "part 4711"}));
}

TEST(ReadCodes, LooksForWhatIsAskedForAlone) {
    ReadCodesOptions options;
    options.symbologies = Symbology::data_matrix;
    EXPECT_EQ(read(all_kinds(), options).texts, std::vector<std::string>{"part 4711"});
    options.symbologies = SymbologySet(Symbology::ean_8) | Symbology::codabar;
    EXPECT_EQ(read(all_kinds(), options).status, Status::not_found);
}

TEST(ReadCodes, EndsWithTheCodesThatWereAskedFor) {
    ReadCodesOptions options;
    options.most_codes = 2;
    EXPECT_EQ(read(all_kinds(), options).codes.size(), 2U);
    EXPECT_EQ(read(all_kinds(), {}, 1).status, Status::capacity_exceeded);
}

TEST(ReadCodes, TellsWhereACodeIsAndWhatItIs) {
    Sheet sheet({300, 200});
    sheet.draw({20, 30}, Symbology::data_matrix, "X", 6);
    const Read result = read(sheet);
    ASSERT_EQ(result.codes.size(), 1U);
    const Code& code = result.codes[0];
    EXPECT_EQ(code.symbology, Symbology::data_matrix);
    EXPECT_EQ(code.aim_digit, '1');
    // A module of margin, then 10 modules of 6 px from (26, 36).
    const int corners[4][2] = {{26, 36}, {86, 36}, {86, 96}, {26, 96}};
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(code.corners[i].x.raw() / 256.0, corners[i][0] - 0.5, 1.5) << i;
        EXPECT_NEAR(code.corners[i].y.raw() / 256.0, corners[i][1] - 0.5, 1.5) << i;
    }
}

TEST(ReadCodes, SaysWhatIsWrong) {
    const Sheet sheet({64, 64});
    EXPECT_EQ(read(sheet).status, Status::not_found);
    ReadCodesOptions options;
    options.symbologies = SymbologySet();
    EXPECT_EQ(read(sheet, options).status, Status::bad_argument);
    options = {};
    options.most_codes = 0;
    EXPECT_EQ(read(sheet, options).status, Status::bad_argument);
    std::uint8_t byte[1] = {};
    CodeText text({byte, 1});
    List<Code, 1> codes;
    EXPECT_EQ(read_codes({}, {}, {}, text, codes.view()), Status::empty_image);
    EXPECT_EQ(read_codes(sheet.view(), {}, {byte, 1}, text, codes.view()), Status::scratch_too_small);
    EXPECT_EQ(text.size(), 0);
    EXPECT_EQ(codes.size(), 0);
}

TEST(ReadCodes, LooksForASmallMatrixBeforeBarsWhereEdgesCross) {
    Sheet sheet({170, 190});
    sheet.draw({4, 110}, Symbology::data_matrix, "part 4711", 4);
    EXPECT_TRUE(detail::small_matrix_likely(sheet.view()));
    for (int y = 60; y < 68; ++y)
        for (int x = 4; x < 8; ++x) sheet.pixels[static_cast<std::size_t>(y * 170 + x)] = 30;
    ReadCodesOptions options;
    options.most_codes = 1;
    EXPECT_EQ(read(sheet, options).texts, std::vector<std::string>{"part 4711"});
    // Bars lie one way, at any angle, and edges of large images are not asked.
    for (int turn = 0; turn < 8; ++turn) {
        Sheet bars({160, 120});
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x)
                if ((x * (4 - turn) + y * turn) / 13 % 2 == 0)
                    bars.pixels[static_cast<std::size_t>(y * 160 + x)] = 30;
        EXPECT_FALSE(detail::small_matrix_likely(bars.view())) << turn;
    }
    EXPECT_FALSE(detail::small_matrix_likely(all_kinds().view()));
    // Modules of any size, at any place.
    for (int module = 1; module < 9; ++module)
        for (int shift = 0; shift < 4; ++shift) {
            Sheet modules({120, 100});
            modules.draw({shift, shift % 3}, Symbology::data_matrix, "9", module);
            EXPECT_TRUE(detail::small_matrix_likely(modules.view())) << module << ' ' << shift;
        }
}

TEST(ReadCodes, OfASmallImageWithBothTellsTheMatrixFirst) {
    Sheet sheet({220, 140});
    sheet.draw({4, 2}, Symbology::ean_8, "96385074", 1);
    sheet.draw({90, 2}, Symbology::data_matrix, "lot 4711 and 4712 and 4713", 5);
    ASSERT_TRUE(detail::small_matrix_likely(sheet.view()));
    EXPECT_EQ(read(sheet).codes.size(), 2U);
    ReadCodesOptions options;
    options.most_codes = 1;
    EXPECT_EQ(read(sheet, options).texts, std::vector<std::string>{"lot 4711 and 4712 and 4713"});
}

}  // namespace
}  // namespace fovea::test
