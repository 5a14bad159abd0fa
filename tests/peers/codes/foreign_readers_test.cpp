// SPDX-License-Identifier: MIT
//
// What `fovea make-code` draws, read by the readers that others have written. Built where one of them is
// installed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>

#include <make_code/make_code_command.hpp>
#include <support/foreign_readers.hpp>

namespace fovea::test {
namespace {

/// A text as it is written, and as it is to be read.
struct Label {
    apps::CodeDesign design;
    std::string text;
    std::string read;
};

std::string random_text(Random& random, const std::string& letters, int length) {
    std::string text;
    for (int i = 0; i < length; ++i)
        text += letters[random.below(static_cast<std::uint32_t>(letters.size()))];
    return text;
}
const std::string digits = "0123456789";
const std::string capitals = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ-.$/+%";
const std::string ascii =
    "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ!\"#&'()*,:;<=>?@[]_{|}~-./ ";

/// What a foreign reader should say of a text: with the check digit that the encoder has added.
std::string with_check_digit(const std::string& text) {
    std::vector<std::uint8_t> values;
    for (const char c : text) values.push_back(static_cast<std::uint8_t>(c - '0'));
    return text + static_cast<char>(
                      '0' + ean_check_digit({values.data(), static_cast<std::ptrdiff_t>(values.size())}));
}

Label label(Symbology symbology, const std::string& text, const std::string& read) {
    Label result;
    result.design.symbology = symbology;
    result.text = text;
    result.read = read;
    return result;
}

std::vector<Label> retail_labels() {
    Random random(7101);
    std::vector<Label> labels;
    for (int i = 0; i < 20; ++i) {
        // Every leading digit, which the parities of the left half say.
        const std::string ean_13 = std::to_string(1 + i % 9) + random_text(random, digits, 11);
        labels.push_back(label(Symbology::ean_13, ean_13, with_check_digit(ean_13)));
        const std::string ean_8 = random_text(random, digits, 7);
        labels.push_back(label(Symbology::ean_8, ean_8, with_check_digit(ean_8)));
        const std::string upc_a = random_text(random, digits, 11);
        labels.push_back(label(Symbology::upc_a, upc_a, with_check_digit(upc_a)));
    }
    return labels;
}
/// Every last digit, by which the zeros are placed that are left out.
std::vector<Label> upc_e_labels() {
    const char* const known[][2] = {{"0123450", "01234505"}, {"0425261", "04252614"}, {"0123452", "01234523"},
                                    {"0123453", "01234531"}, {"0123454", "01234543"}, {"0123455", "01234558"},
                                    {"0123456", "01234565"}, {"0123457", "01234572"}, {"0123458", "01234589"},
                                    {"0123459", "01234596"}};
    std::vector<Label> labels;
    for (const auto& pair : known) labels.push_back(label(Symbology::upc_e, pair[0], pair[1]));
    return labels;
}

std::vector<Label> text_labels() {
    Random random(7102);
    std::vector<Label> labels;
    for (int i = 0; i < 20; ++i) {
        // Runs of digits between letters: all three sets of Code 128.
        const std::string mixed = random_text(random, ascii, random.between(1, 6)) +
                                  random_text(random, digits, random.between(0, 9)) + "x";
        labels.push_back(label(Symbology::code_128, mixed, mixed));
        const std::string plain = random_text(random, capitals, random.between(2, 12));
        labels.push_back(label(Symbology::code_39, plain, plain));
        const std::string pairs = random_text(random, digits, 2 * random.between(3, 10));
        labels.push_back(label(Symbology::interleaved_2_of_5, pairs, pairs));
    }
    return labels;
}

std::vector<Label> qr_labels() {
    Random random(7103);
    std::vector<Label> labels;
    for (int version = 1; version <= 40; ++version) {
        Label one =
            label(Symbology::qr, random_text(random, version % 3 == 0 ? digits : ascii, 5 + version), "");
        one.read = one.text;
        one.design.qr.min_version = version;
        one.design.qr.level = static_cast<QrLevel>(version % 4);
        one.design.qr.mask = version % 8;
        labels.push_back(one);
    }
    labels.push_back(label(Symbology::qr, "Gr\xc3\xbc\xc3\x9f Gott", "Gr\xc3\xbc\xc3\x9f Gott"));
    return labels;
}

/// Of each size that is asked for, its text nearly filling it.
std::vector<Label> data_matrix_labels(int first, int sizes) {
    Random random(7104);
    std::vector<Label> labels;
    for (int i = first; i < first + sizes; ++i) {
        const DataMatrixSize& size = data_matrix_sizes[i];
        // Two digits a codeword, one letter a codeword or more of them.
        for (const bool numbers : {true, false}) {
            const int length = numbers ? 2 * size.data : size.data * 2 / 3;
            const std::string text = random_text(random, numbers ? digits : ascii, length);
            Label one = label(Symbology::data_matrix, text, text);
            one.design.data_matrix.size = {size.columns, size.rows};
            one.design.data_matrix.extended = true;
            labels.push_back(one);
        }
    }
    return labels;
}

/// Draws labels as the tool does, with modules of so many pixels.
void expect_read(const CodeReader& reader, const std::vector<Label>& labels, std::vector<int> module_px) {
    for (const Label& one : labels) {
        apps::CodeModules modules;
        ASSERT_EQ(apps::modules_of(one.text, one.design, modules), "");
        for (const int module : module_px) {
            const Texts texts =
                reader.read(apps::detail::picture_of(modules, one.design.bar_height, module, false));
            EXPECT_EQ(texts, Texts{one.read})
                << reader.name << ", " << name(one.design.symbology) << ", " << modules.size.width << "x"
                << modules.size.height << " modules of " << module << " px";
        }
    }
}

/// Codabar is told without its start and stop by some, and with them by others.
std::vector<Label> codabar_labels(bool with_ends) {
    Random random(7105);
    std::vector<Label> labels;
    for (int i = 0; i < 20; ++i) {
        const std::string text = random_text(random, "0123456789-$:/.+", random.between(5, 12));
        const char first = "ABCD"[i % 4];
        const char last = "ABCD"[i / 4 % 4];
        labels.push_back(
            label(Symbology::codabar, first + text + last, with_ends ? first + text + last : text));
    }
    return labels;
}

/// The same with their check characters, and what a pair of characters of Code 39 stands for.
std::vector<Label> checked_labels() {
    std::vector<Label> labels = {label(Symbology::interleaved_2_of_5, "3071234500001", "30712345000010"),
                                 label(Symbology::code_39, "CODE 39", "CODE 39R")};
    for (Label& one : labels) one.design.check = true;
    labels.push_back(label(Symbology::code_39, "a1B", "+A1B"));
    labels.back().design.code_39 = Code39Text::full_ascii;
    return labels;
}

#ifdef FOVEA_HAVE_ZXING
const CodeReader zxing = {"zxing-cpp", read_one_with_zxing};
TEST(ZxingReads, RetailCodes) {
    expect_read(zxing, retail_labels(), {1, 2, 3});
    expect_read(zxing, upc_e_labels(), {1, 2, 3});
}
TEST(ZxingReads, BarsOfTexts) {
    expect_read(zxing, text_labels(), {2, 3});
    expect_read(zxing, codabar_labels(false), {2, 3});
    expect_read(zxing, checked_labels(), {2, 3});
}
// Of version 40 with modules of 2 px it finds no grid.
TEST(ZxingReads, EveryVersionOfQr) { expect_read(zxing, qr_labels(), {3, 5}); }
TEST(ZxingReads, EverySizeOfDataMatrix) {
    expect_read(zxing, data_matrix_labels(0, data_matrix_size_count), {2, 5});
}
// GS1 element strings, with FNC1 in front and between them.
TEST(ZxingReads, Gs1) {
    for (const Symbology symbology : {Symbology::code_128, Symbology::data_matrix}) {
        Label one = label(symbology,
                          "0195012345678903\x1d"
                          "10LOT42\x1d"
                          "2112",
                          "");
        one.read = one.text;
        one.design.code_128 = Code128Kind::gs1;
        one.design.data_matrix.gs1 = true;
        expect_read(zxing, {one}, {2, 3});
    }
}
#endif

#ifdef FOVEA_HAVE_ZBAR
// Modules of a pixel are too small for it.
TEST(ZbarReads, RetailCodes) {
    expect_read(zbar_reader("zbar"), retail_labels(), {2, 3});
    expect_read(zbar_reader("zbar"), upc_e_labels(), {2, 3});
}
TEST(ZbarReads, BarsOfTexts) {
    expect_read(zbar_reader("zbar"), text_labels(), {2, 3});
    expect_read(zbar_reader("zbar"), codabar_labels(true), {2, 3});
    expect_read(zbar_reader("zbar"), checked_labels(), {2, 3});
}
TEST(ZbarReads, EveryVersionOfQr) { expect_read(zbar_reader("zbar"), qr_labels(), {3}); }
#endif

#ifdef FOVEA_HAVE_DMTX
// It does not know the rectangles of the extension. 144x144, whose blocks are not alike, it orders otherwise:
// zxing-cpp reads ours and not what dmtxwrite draws, dmtxread the other way round.
TEST(DmtxReads, EverySizeOfDataMatrix) {
    const CodeReader dmtx = {"libdmtx", [](const auto& picture) { return read_with_dmtx(picture, 10000); }};
    const int rectangles = data_matrix_plain_sizes - data_matrix_squares;
    expect_read(dmtx, data_matrix_labels(0, data_matrix_squares - 1), {5});
    expect_read(dmtx, data_matrix_labels(data_matrix_squares, rectangles), {5});
}
#endif

}  // namespace
}  // namespace fovea::test
