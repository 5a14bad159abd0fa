// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/decision/compiled_recipe.hpp>

#include <gauge/compile_command.hpp>
#include <gauge/recipe_file.hpp>
#include <support/recipes.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using Words = std::vector<std::string>;

class CompileCommand : public ::testing::Test {
protected:
    CompileCommand() { io.put("part.toml", apps::write_recipe(recipe)); }
    apps::ExitCode run(const Words& words) {
        io.hush();
        return apps::compile_command(io, words);
    }
    void refuses(const Words& words, const std::string& complaint) {
        const auto before = io.files.files;
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), complaint + "\n");
        EXPECT_EQ(io.out, "");
        EXPECT_EQ(io.files.files, before);
    }

    Random random{903};
    Recipe recipe = random_recipe(random);
    TestIo io;
};

TEST_F(CompileCommand, WritesWhatAChipReads) {
    EXPECT_EQ(run({"part.toml", "--out", "part.bin"}), apps::exit_ok);
    const std::vector<std::uint8_t>& bytes = io.files.files["part.bin"];
    EXPECT_EQ(io.out, "wrote part.bin: " + std::to_string(bytes.size()) + " bytes, " +
                          std::to_string(recipe.features.size()) + " features\n");
    const auto back = std::make_unique<Recipe>();
    ASSERT_EQ(decode_recipe({bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}, *back), Status::ok);
    EXPECT_EQ(apps::write_recipe(*back), apps::write_recipe(recipe));
}

TEST_F(CompileCommand, WritesAHeaderWithTheSameBytes) {
    EXPECT_EQ(run({"part.toml", "--out", "part.bin"}), apps::exit_ok);
    EXPECT_EQ(run({"part.toml", "--out", "part.hpp"}), apps::exit_ok);
    const std::string text = io.text("part.hpp");
    EXPECT_EQ(text.rfind("// part.toml, made by `fovea compile`\n#pragma once\n", 0), 0u);
    std::string numbers;
    for (const std::uint8_t byte : io.files.files["part.bin"]) numbers += std::to_string(byte) + ",";
    std::string found;
    for (const char letter : text.substr(text.find('{') + 1))
        if ((letter >= '0' && letter <= '9') || letter == ',') found += letter;
    EXPECT_EQ(found + ",", numbers);
}

TEST_F(CompileCommand, RefusesWhatItCannotDoAndSaysWhy) {
    refuses({}, "fovea compile: which recipe? give one RECIPE; `fovea teach` makes one");
    refuses({"a", "b", "--out", "c"},
            "fovea compile: which recipe? give one RECIPE; `fovea teach` makes one");
    refuses({"part.toml"}, "fovea compile: where to? give --out FILE");
    refuses({"part.toml", "--out", "part.toml"},
            "fovea compile: --out would overwrite part.toml; give another name");
    refuses({"none.toml", "--out", "x"}, "none.toml: simulated fault");
    io.put("bad.toml", "format = 1\nwhat = 2\n");
    refuses({"bad.toml", "--out", "x"}, "bad.toml:2:1: unknown key what");
    io.put("picture.pgm", "P5 1 1 255\n.");
    refuses({"picture.pgm", "--out", "x"},
            "picture.pgm: a picture, not a recipe; `fovea compile` takes the file that `fovea teach` wrote");
    io.files.refused = "full.bin";
    refuses({"part.toml", "--out", "full.bin"}, "full.bin: simulated fault");
}

TEST_F(CompileCommand, HasHelp) {
    EXPECT_EQ(run({"--help"}), apps::exit_ok);
    EXPECT_NE(io.out.find("usage: fovea compile [options] RECIPE"), std::string::npos);
}

}  // namespace
}  // namespace fovea::test
