// SPDX-License-Identifier: MIT
//
// Pictures of codes, drawn onto a light ground.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/image/image_view.hpp>

#include <make_code/code_modules.hpp>

namespace fovea::test {

/// A picture on which codes are drawn.
class CodeScene {
public:
    explicit CodeScene(Size size)
        : size_(size), pixels_(static_cast<std::size_t>(size.area()), std::uint8_t{220}) {}

    /// Draws a code with its quiet zone at (x, y), in modules of so many pixels; bars are so high in pixels.
    CodeScene& draw(const std::string& text, Symbology symbology, int x, int y, int module, int bars_px = 40,
                    Code128Kind kind = Code128Kind::plain) {
        apps::CodeDesign design;
        design.symbology = symbology;
        design.code_128 = kind;
        return draw(text, design, x, y, module, bars_px);
    }
    CodeScene& draw(const std::string& text, const apps::CodeDesign& design, int x, int y, int module,
                    int bars_px = 40) {
        apps::CodeModules modules;
        EXPECT_EQ(apps::modules_of(text, design, modules), "");
        const int rows = modules.bars ? bars_px : modules.size.height * module;
        EXPECT_LE(x + (modules.size.width + 2 * modules.quiet) * module, size_.width);
        EXPECT_LE(y + rows + 2 * modules.quiet * module, size_.height);
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < modules.size.width * module; ++column)
                if (modules.is_dark(column / module, modules.bars ? 0 : row / module))
                    pixel(x + modules.quiet * module + column, y + modules.quiet * module + row) = 30;
        return *this;
    }

    std::uint8_t& pixel(int x, int y) { return pixels_[static_cast<std::size_t>(y * size_.width + x)]; }
    ImageView<const Gray8> view() const { return {pixels_.data(), size_, size_.width}; }
    const std::vector<std::uint8_t>& pixels() const { return pixels_; }
    std::string pgm() const {
        return "P5\n" + std::to_string(size_.width) + " " + std::to_string(size_.height) + "\n255\n" +
               std::string(pixels_.begin(), pixels_.end());
    }

private:
    Size size_;
    std::vector<std::uint8_t> pixels_;
};

}  // namespace fovea::test
