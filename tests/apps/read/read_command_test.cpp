// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <make_code/make_code_command.hpp>
#include <read/read_command.hpp>
#include <support/json.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using Words = std::vector<std::string>;

class ReadCommand : public ::testing::Test {
protected:
    ReadCommand() {
        make({"--out", "ean.png", "--symbology", "ean-13", "978090570571"});
        make({"--out", "qr.png", "two\\nlines"});
        apps::Picture<Gray8> blank({64, 64});
        std::string problem;
        EXPECT_TRUE(apps::save_picture(io.storage(), "blank.png", blank, problem));
        io.put("broken.png", "no picture");
        io.put("allowed.txt", "9780905705712\r\n\nother\n");
    }
    void make(const Words& words) {
        EXPECT_EQ(apps::make_code_command(io, words), apps::exit_ok) << io.errors();
    }
    ExitCode run(const Words& words) {
        io.hush();
        return apps::read_command(io, words);
    }
    void refuses(const Words& words, const std::string& problem) {
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), "fovea read: " + problem + "\n");
        EXPECT_EQ(io.out, "");
    }

    TestIo io;
};

TEST_F(ReadCommand, PrintsALineACode) {
    EXPECT_EQ(run({"ean.png"}), apps::exit_ok);
    EXPECT_EQ(io.out, "EAN-13 9780905705712\n");
    EXPECT_EQ(io.errors(), "");
    EXPECT_EQ(run({"ean.png", "qr.png"}), apps::exit_ok);
    EXPECT_EQ(io.out, "ean.png: EAN-13 9780905705712\nqr.png: QR two\\nlines\n");
}

TEST_F(ReadCommand, SaysWhenNothingIsThereAndEndsWithOne) {
    EXPECT_EQ(run({"blank.png", "ean.png"}), apps::exit_not_ok);
    EXPECT_EQ(io.errors(),
              "blank.png: no code was read; is it sharp, lit evenly and whole, with its quiet zone?\n");
    EXPECT_EQ(io.out, "ean.png: EAN-13 9780905705712\n");
    EXPECT_EQ(run({"broken.png", "ean.png"}), apps::exit_failed);
    EXPECT_EQ(run({"missing.png"}), apps::exit_failed);
    EXPECT_EQ(run({"--symbology", "qr", "ean.png"}), apps::exit_not_ok);
    EXPECT_EQ(run({"--quick", "blank.png"}), apps::exit_not_ok);
}

TEST_F(ReadCommand, JudgesTextsThatAreAllowed) {
    EXPECT_EQ(run({"--allowed", "9780905705712", "ean.png"}), apps::exit_ok);
    EXPECT_EQ(io.out, "OK EAN-13 9780905705712\n");
    EXPECT_EQ(run({"--allowed-file", "allowed.txt", "ean.png", "qr.png"}), apps::exit_not_ok);
    EXPECT_EQ(io.out, "ean.png: OK EAN-13 9780905705712\nqr.png: NG QR two\\nlines\n");
}

TEST_F(ReadCommand, JudgesTextsByAPattern) {
    EXPECT_EQ(run({"--pattern", "978##########", "ean.png"}), apps::exit_ok);
    EXPECT_EQ(io.out, "OK EAN-13 9780905705712\n");
    EXPECT_EQ(run({"--pattern", "979*", "ean.png"}), apps::exit_not_ok);
    EXPECT_EQ(run({"--pattern", "two*", "--allowed", "9780905705712", "ean.png", "qr.png"}), apps::exit_ok);
    refuses({"--pattern", "a\\", "ean.png"}, "--pattern: after \\ comes one of n r t xNN \\ # @ ? *");
}

TEST_F(ReadCommand, JudgesByTheJobOfADaemon) {
    const std::string top = "format = 1\nname = \"label\"\n[codes]\nsymbologies = [\"ean-13\", \"qr\"]\n";
    io.put("label.toml", top + "patterns = [\"97*\"]\n");
    EXPECT_EQ(run({"--job", "label.toml", "ean.png"}), apps::exit_ok);
    EXPECT_EQ(io.out, "OK EAN-13 9780905705712\n");
    EXPECT_EQ(run({"--job", "label.toml", "ean.png", "qr.png"}), apps::exit_not_ok);
    EXPECT_EQ(io.out, "ean.png: OK EAN-13 9780905705712\nqr.png: NG QR two\\nlines\n");
    EXPECT_EQ(io.errors(), "qr.png: wrong_code\n");
    EXPECT_EQ(run({"--json", "--job", "label.toml", "blank.png"}), apps::exit_not_ok);
    EXPECT_EQ(io.out, "{\"schema\":1,\"image\":\"blank.png\",\"code\":null,\"error\":\"no_code\"}\n");
    io.put("region.toml", top + "region = [0, 0, 5000, 10]\n");
    EXPECT_EQ(run({"--job", "region.toml", "ean.png"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "ean.png: region_outside\n");
    io.put("once.toml", top + "unlike_last = true\n");
    EXPECT_EQ(run({"--job", "once.toml", "ean.png", "ean.png"}), apps::exit_not_ok);
    EXPECT_EQ(io.errors(), "ean.png: repeated_code\n");
    io.put("taught.toml", top + "taught = true\n");
    io.put("recipe.toml", "format = 1\nname = \"a\"\n[locate]\n");
    refuses({"--job", "taught.toml", "ean.png"},
            "--job taught.toml: with taught = true only fovead knows what is allowed");
    refuses({"--job", "recipe.toml", "ean.png"}, "--job recipe.toml: there is no [codes] in it");
    refuses({"--job", "label.toml", "--quick", "ean.png"},
            "--quick has no meaning beside --job, which says it");
    io.put("wrong.toml", top + "cuont = 2\n");
    refuses({"--job", "wrong.toml", "ean.png"},
            "--job wrong.toml:5:1: unknown key cuont in [codes]; did you mean count?");
}

TEST_F(ReadCommand, LetsNoCodeEndItsLine) {
    make({"--out", "forged.png",
          "a\xc2\x85"
          "b\xe2\x80\xa8"
          "c\x1d"});
    EXPECT_EQ(run({"forged.png"}), apps::exit_ok);
    EXPECT_EQ(io.out,
              "QR a\\xc2\\x85"
              "b\\xe2\\x80\\xa8"
              "c\\x1d\n");
    EXPECT_EQ(run({"--json", "forged.png"}), apps::exit_ok);
    EXPECT_NE(io.out.find("\"text\":\"a\\u0085b\\u2028c\\u001d\""), std::string::npos) << io.out;
}

TEST_F(ReadCommand, TellsACodeOnceOfSeveralPictures) {
    EXPECT_EQ(run({"--unique", "ean.png", "ean.png", "qr.png"}), apps::exit_ok);
    EXPECT_EQ(io.out, "ean.png: EAN-13 9780905705712\nqr.png: QR two\\nlines\n");
}

TEST_F(ReadCommand, GivesBytesWithWhatStandsAroundThem) {
    EXPECT_EQ(run({"--raw", "qr.png"}), apps::exit_ok);
    EXPECT_EQ(io.out, "two\nlines\n");
    EXPECT_EQ(run({"--prefix", "<", "--suffix", ">", "ean.png"}), apps::exit_ok);
    EXPECT_EQ(io.out, "EAN-13 <9780905705712>\n");
}

TEST_F(ReadCommand, PrintsJsonWithCornersAndGrade) {
    EXPECT_EQ(run({"--json", "qr.png", "blank.png", "broken.png"}), apps::exit_failed);
    const std::vector<std::string> lines = lines_of(io.out);
    ASSERT_EQ(lines.size(), 3U);
    const std::string begins =
        "{\"schema\":1,\"image\":\"qr.png\",\"code\":0,\"symbology\":\"QR\",\"text\":\"two\\u000alines\","
        "\"bytes_hex\":"
        "\"74776f0a6c696e6573\",\"aim\":\"]Q1\",\"corners_px\":[[";
    EXPECT_EQ(lines[0].substr(0, begins.size()), begins);
    EXPECT_NE(lines[0].find("\"grade\":{\"overall\":"), std::string::npos);
    EXPECT_EQ(
        lines[1].find("{\"schema\":1,\"image\":\"blank.png\",\"code\":null,\"error\":\"no code was read"),
        0U);
    EXPECT_EQ(lines[2].find("{\"schema\":1,\"image\":\"broken.png\",\"code\":null,\"error\":\"not a picture"),
              0U);
}

TEST_F(ReadCommand, DrawsAFrameAroundWhatWasRead) {
    EXPECT_EQ(run({"--explain", "seen.png", "ean.png"}), apps::exit_ok);
    apps::Picture<Rgb888> picture;
    std::string problem;
    ASSERT_TRUE(apps::load_picture(io.storage(), "seen.png", 4096, picture, problem)) << problem;
    int coloured = 0;
    for (const Rgb888 pixel : picture.pixels) coloured += pixel.red != pixel.green ? 1 : 0;
    EXPECT_GT(coloured, 400);
    EXPECT_EQ(run({"--explain", "n.png", "ean.png", "qr.png"}), apps::exit_ok);
    EXPECT_TRUE(io.has("n-0.png") && io.has("n-1.png"));
}

TEST_F(ReadCommand, SaysWhatIsWrong) {
    refuses({}, "which picture? give at least one IMAGE");
    refuses({"--symbology", "qrr", "ean.png"},
            "there is no symbology 'qrr'; did you mean qr?; there are all, bars, matrices, retail, ean-13, "
            "ean-8, upc-a, "
            "upc-e, code-128, code-39, interleaved-2-of-5, codabar, qr and data-matrix");
    refuses({"--json", "--raw", "ean.png"}, "--json and --raw are two ways to say it; give one");
    refuses({"--most", "0", "ean.png"}, "--most takes a whole number from 1 to 1000, not '0'");
    refuses({"--digits", "7", "ean.png"}, "--digits takes even numbers from 2 to 96 such as 14, not '7'");
    refuses({"--allowed-file", "blank.txt", "ean.png"}, "--allowed-file blank.txt: simulated fault");
    refuses({"--explain", "-", "ean.png"}, "--explain writes a file; the standard output has the results");
    refuses({"--explain", "ean.png", "ean.png"}, "--explain would overwrite ean.png; give another name");
    EXPECT_EQ(run({"--help"}), apps::exit_ok);
    EXPECT_EQ(io.out, apps::help_of(apps::read_help()));
}

}  // namespace
}  // namespace fovea::test
