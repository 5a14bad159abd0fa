// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <make_code/make_code_command.hpp>
#include <read/read_command.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using Words = std::vector<std::string>;

class MakeCodeCommand : public ::testing::Test {
protected:
    ExitCode run(Words words) {
        io.hush();
        return apps::make_code_command(io, words);
    }
    void refuses(const Words& words, const std::string& problem) {
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), "fovea make-code: " + problem + "\n");
        EXPECT_EQ(io.out, "");
        EXPECT_FALSE(io.has("refused.png"));
    }
    /// What `fovea read` reads of the code that the words make.
    std::string read_back(Words words) {
        words.insert(words.begin(), {"--out", "c.png"});
        EXPECT_EQ(run(words), apps::exit_ok) << io.errors();
        io.hush();
        EXPECT_EQ(apps::read_command(io, {"c.png"}), apps::exit_ok) << io.errors();
        return io.out;
    }

    TestIo io;
};

TEST_F(MakeCodeCommand, WritesEverySymbologySoThatItIsReadBack) {
    EXPECT_EQ(read_back({"--symbology", "ean-13", "978090570571"}), "EAN-13 9780905705712\n");
    EXPECT_EQ(read_back({"--symbology", "ean-8", "9638507"}), "EAN-8 96385074\n");
    EXPECT_EQ(read_back({"--symbology", "upc-a", "03600029145"}), "UPC-A 036000291452\n");
    EXPECT_EQ(read_back({"--symbology", "upc-e", "0123456"}), "UPC-E 01234565\n");
    EXPECT_EQ(read_back({"--symbology", "code-128", "Lot 42/7"}), "Code 128 Lot 42/7\n");
    EXPECT_EQ(read_back({"--symbology", "code-39", "ABC-12"}), "Code 39 ABC-12\n");
    EXPECT_EQ(read_back({"--symbology", "interleaved-2-of-5", "12345678"}), "Interleaved 2 of 5 12345678\n");
    EXPECT_EQ(read_back({"--symbology", "codabar", "A1234567B"}).substr(0, 8), "Codabar ");
    EXPECT_EQ(read_back({"part 4711"}), "QR part 4711\n");
    EXPECT_EQ(read_back({"--symbology", "data-matrix", "part 4711"}), "Data Matrix part 4711\n");
    EXPECT_EQ(read_back({"--symbology", "data-matrix", "--size", "8x32", "AB12"}), "Data Matrix AB12\n");
}

TEST_F(MakeCodeCommand, MakesBytesOfWhatFollowsABackslash) {
    EXPECT_EQ(read_back({"a\\tb\\\\c\\x41"}), "QR a\\tb\\cA\n");
    EXPECT_EQ(read_back({"--inverted", "light"}), "QR light\n");
    refuses({"--out", "refused.png", "a\\x4"},
            "\\ in a text is followed by n, r, t, x and two hexadecimal digits, or \\");
    refuses({"--out", "refused.png", "a\\"},
            "\\ in a text is followed by n, r, t, x and two hexadecimal digits, or \\");
}

TEST_F(MakeCodeCommand, SaysWhatItWroteAndHowLargeItIs) {
    EXPECT_EQ(run({"--out", "c.png", "--symbology", "ean-8", "9638507"}), apps::exit_ok);
    EXPECT_EQ(io.out, "wrote c.png: EAN-8, 67x50 modules\n");
    EXPECT_EQ(run({"--out", "c.pgm", "--module", "1", "hello"}), apps::exit_ok);
    EXPECT_EQ(io.out, "wrote c.pgm: QR, 21x21 modules\n");
    EXPECT_EQ(io.text("c.pgm").substr(0, 9), "P5\n29 29\n");
}

TEST_F(MakeCodeCommand, DrawsOneRectangleForARunOfModules) {
    EXPECT_EQ(run({"--out", "c.svg", "--symbology", "ean-8", "--height", "30", "9638507"}), apps::exit_ok);
    const std::string svg = io.text("c.svg");
    EXPECT_EQ(svg.find("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 81 44\""), 0U);
    // The guard: two bars of a module, a module apart, behind the quiet zone of seven.
    EXPECT_NE(svg.find("M7 7h1v30h-1zM9 7h1v30h-1z"), std::string::npos) << svg;
    std::size_t runs = 0;
    for (std::size_t at = svg.find('M', svg.find("#000")); at != std::string::npos;
         at = svg.find('M', at + 1))
        ++runs;
    EXPECT_EQ(runs, 22U);
}

TEST_F(MakeCodeCommand, SaysWhatIsWrong) {
    refuses({"hello"}, "where to? give --out PICTURE");
    refuses({"--out", "refused.png"}, "which text? give TEXT");
    refuses({"--out", "refused.png", "a", "b"}, "one text at a time; put it in quotes");
    refuses({"--out", "refused.png", "--symbology", "bars", "a"}, "--symbology takes one of them");
    refuses({"--out", "refused.png", "--symbology", "ean-13", "9780905705713"},
            "'9780905705713' is no text for ean-13, which takes 12 digits, or 13 with a right check digit");
    refuses({"--out", "refused.png", "--level", "X", "a"}, "--level takes L, M, Q or H, not 'X'");
    refuses({"--out", "refused.png", "--size", "16", "a"},
            "--size takes rows and columns such as 16x48, not '16'");
    refuses({"--out", "refused.png", "--module", "65", "a"},
            "--module takes a whole number from 1 to 64, not '65'");
    EXPECT_EQ(run({"--out", "c.jpg", "a"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "c.jpg: fovea writes PNG, PGM and PPM; name it .png\n");
    refuses({"--out", "refused.png", "--symbology", "data-matrix", "--size", "8x33", "a"},
            "'a' is no text for data-matrix, which takes a text that fits 144x144 modules, or the size asked "
            "for");
    EXPECT_EQ(run({"--help"}), apps::exit_ok);
    EXPECT_EQ(io.out, apps::help_of(apps::make_code_help()));
}

}  // namespace
}  // namespace fovea::test
