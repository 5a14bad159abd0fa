// SPDX-License-Identifier: MIT
//
// A command of the tool that reads in.png and writes other pictures, with files in memory.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <common/picture_file.hpp>
#include <support/test_io.hpp>

namespace fovea::test {

class PictureTool : public ::testing::Test {
protected:
    using Words = std::vector<std::string>;
    using Run = apps::ExitCode (*)(TestIo& io, const Words& words);

    /// pixel(x, y) makes in.png.
    template <class Pixel>
    PictureTool(Run command, Size size, Pixel pixel) : source(size), command_(command) {
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) source.view()(x, y) = static_cast<Gray8>(pixel(x, y));
        std::string problem;
        EXPECT_TRUE(apps::save_picture(io.storage(), "in.png", source, problem)) << problem;
    }
    apps::ExitCode run(const Words& words) {
        io.hush();
        return command_(io, words);
    }
    apps::Picture<Gray8> written(const std::string& name) {
        apps::Picture<Gray8> picture;
        std::string problem;
        EXPECT_TRUE(apps::load_gray(io.storage(), name, picture, problem)) << problem;
        return picture;
    }
    /// The command fails with the complaint alone, and writes no out.png.
    void refuses(const Words& words, const std::string& complaint) {
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), complaint + "\n");
        EXPECT_EQ(io.out, "");
        EXPECT_FALSE(io.has("out.png"));
    }

    TestIo io;
    apps::Picture<Gray8> source;

private:
    Run command_;
};

}  // namespace fovea::test
