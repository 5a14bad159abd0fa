// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <make_part/part_scene.hpp>
#include <support/commands.hpp>
#include <support/json.hpp>
#include <support/parts.hpp>
#include <support/plate_scene.hpp>
#include <support/test_io.hpp>

namespace fovea::test {

using apps::ExitCode;
using apps::gauge_command;
using apps::Picture;
using Words = std::vector<std::string>;

/// A plate that lies aslant in 260 x 160.
inline apps::PartScene scene() {
    apps::PartScene scene = small_plate({260, 160});
    scene.angle = FineAngle::from_microdegrees(9000000);
    scene.noise = 2000000;
    return scene;
}

/// Measures the plate: its length, where the hole count stands in line 12.
inline const std::string recipe =
    "format = 1\n"
    "[locate]\n"
    "area_min = 2000\n"
    "orientation = \"symmetric\"\n"
    "[[feature]]\n"
    "name = \"height\"\n"
    "kind = \"width\"\n"
    "from = [0, -60]\n"
    "to = [0, 60]\n"
    "nominal = 70\nminus = 0.5\nplus = 0.5\n"
    "[[feature]]\n"
    "name = \"holes\"\n"
    "kind = \"hole_count\"\n"
    "nominal = 2\nminus = 0\nplus = 0\n";

class GaugeCommand : public ::testing::Test {
protected:
    GaugeCommand() {
        io.put("r.toml", recipe);
        io.put("good.pgm", pgm_of(render(scene())));
        apps::PartScene other = scene();
        other.holes.clear();
        io.put("bad.pgm", pgm_of(render(other)));
        Picture<Gray8> white({50, 40});
        std::fill(white.pixels.begin(), white.pixels.end(), Gray8{200});
        io.put("white.pgm", pgm_of(white));
    }
    ExitCode run(const Words& words) {
        io.hush();
        return gauge_command(io, words);
    }
    /// Runs and expects exit code 2 with one line of complaint and nothing else.
    void refuses(const Words& words, const std::string& complaint) {
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), complaint + "\n");
        EXPECT_EQ(io.out, "");
    }
    std::vector<Json> json_of(const Words& words) {
        run(words);
        std::vector<Json> objects;
        for (const std::string& line : lines_of(io.out)) {
            const auto json = parse_json(line);
            EXPECT_TRUE(json.has_value()) << line;
            objects.push_back(json.value_or(Json()));
        }
        return objects;
    }

    TestIo io;
};

}  // namespace fovea::test
