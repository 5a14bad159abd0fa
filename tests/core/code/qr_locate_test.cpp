// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/code/qr_locate.hpp>
#include <fovea/code/qr_sample.hpp>

#include "qr_scene.hpp"

namespace fovea::test {
namespace {

using namespace fovea::detail;

/// A scene, its binary image, and the finders where they were drawn.
class Located {
public:
    Located(int version, const QrPose& pose, int side)
        : symbol_("located", of_version(version)),
          scene_(side, side),
          bits_(static_cast<std::size_t>(bit_words(side) * side)) {
        scene_.draw(symbol_, pose);
        pixels_ = scene_.pixels();
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                view().set(x, y, pixels_[static_cast<std::size_t>(y * side + x)] < 125);
        const double size = symbol_.size();
        const double places[3][2] = {{3.5, 3.5}, {size - 3.5, 3.5}, {3.5, size - 3.5}};
        for (int i = 0; i < 3; ++i) {
            double x = places[i][0];
            double y = places[i][1];
            pose.project(symbol_.size(), x, y);
            finders_[i].centre = {std::llround(x * 256), std::llround(y * 256)};
            finders_[i].module = std::llround(pose.module * 256);
        }
    }
    BitView<BitWord> view() { return {bits_.data(), scene_.size(), bit_words(scene_.size().width)}; }
    FinderImage image() { return {view(), false}; }
    ImageView<const Gray8> gray() const { return {pixels_.data(), scene_.size(), scene_.size().width}; }
    const FinderPattern& finder(int index) const { return finders_[index]; }
    const DrawnQr& symbol() const { return symbol_; }

private:
    static QrEncodeOptions of_version(int version) {
        QrEncodeOptions options;
        options.min_version = version;
        return options;
    }

    DrawnQr symbol_;
    QrScene scene_;
    std::vector<BitWord> bits_;
    std::vector<Gray8> pixels_;
    FinderPattern finders_[3];
};

/// Whether planes put the corners of a symbol at the same places.
bool same(const ModulePlane& a, const ModulePlane& b, int size) {
    for (const ModulePoint corner :
         {module_corner(0, 0), module_corner(size, 0), module_corner(size, size)}) {
        if (a(corner).x != b(corner).x || a(corner).y != b(corner).y) return false;
    }
    return true;
}

TEST(QrLocator, TellsTheSizeAndThePlane) {
    for (const int version : {1, 2, 5, 7, 12, 25}) {
        const int side = qr_size(version) * 6 + 60;
        Located located(version, {side / 2.0, side / 2.0, 4, 0.4, 0.04, -0.05, false}, side);
        QrLocator locator(located.image());
        ASSERT_TRUE(locator.begin(located.finder(0), located.finder(1), located.finder(2))) << version;
        bool told = false;
        for (int i = 0; i < locator.sizes(); ++i) told = told || locator.size(i) == qr_size(version);
        ASSERT_TRUE(told) << version;
        ASSERT_GT(locator.find_planes(qr_size(version)), 0);
        ModulePlane plane = locator.plane(0);
        EXPECT_GE(locator.refine(qr_size(version), plane), 950) << version;
        const ModulePlane refined = plane;
        WorkBudget none(0);
        locator.settle(qr_size(version), plane, none);
        EXPECT_TRUE(same(plane, refined, qr_size(version))) << version;
        EXPECT_LT(none.left(), 0);
        WorkBudget work(1 << 20);
        locator.settle(qr_size(version), plane, work);
        // All eight ways at each of three steps, at least.
        EXPECT_LE(work.left(), (1 << 20) + 25 * none.left()) << version;
        QrGrid grid;
        locator.find_grid(qr_size(version), plane, grid);
        ASSERT_TRUE(grid_inside(grid, qr_size(version), {side, side}));
        int wrong = 0;
        BitStorage<max_qr_size, max_qr_size> modules;
        const int size = qr_size(version);
        const BitView<BitWord> view(modules.view().first(), {size, size}, modules.view().stride_words());
        sample_bits(located.image(), grid, view);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) wrong += view(x, y) != located.symbol().dark(x, y) ? 1 : 0;
        EXPECT_LE(wrong, size * size / 200) << version;

        std::vector<std::int16_t> room(static_cast<std::size_t>(size * size));
        GrayModules levels({room.data(), static_cast<std::ptrdiff_t>(room.size())}, size);
        levels.sample(located.gray(), grid, size);
        for (const int sharpen : {0, 8}) {
            levels.decide(sharpen, false, view);
            wrong = 0;
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) wrong += view(x, y) != located.symbol().dark(x, y) ? 1 : 0;
            EXPECT_LE(wrong, size * size / 200) << version;
        }
    }
}

TEST(QrLocator, RefusesFindersThatAreNone) {
    Located located(2, {80, 80, 4, 0, 0, 0, false}, 160);
    FinderPattern nowhere;
    nowhere.centre = pixel_place(5, 5);
    nowhere.module = 1024;
    QrLocator locator(located.image());
    EXPECT_FALSE(locator.begin(located.finder(0), nowhere, located.finder(2)));
    EXPECT_FALSE(locator.begin(located.finder(0), located.finder(0), located.finder(2)));
}

TEST(QrGrid, DeparturesGoEvenlyFromPatternToPattern) {
    QrGrid grid;
    grid.lines = 3;
    grid.line[0] = 6;
    grid.line[1] = 22;
    grid.line[2] = 38;
    grid.departure[1][1] = {160, -320};
    EXPECT_EQ(grid.departure_at(22, 22).x, 160);
    EXPECT_EQ(grid.departure_at(14, 22).x, 80);
    EXPECT_EQ(grid.departure_at(14, 14).y, -80);
    EXPECT_EQ(grid.departure_at(30, 30).x, 40);
    EXPECT_EQ(grid.departure_at(0, 44).x, 0);
    EXPECT_EQ(QrGrid().departure_at(10, 10).x, 0);
}

TEST(Brightness, IsBetweenFourPixels) {
    const Gray8 pixels[4] = {0, 100, 200, 100};
    const ImageView<const Gray8> image(pixels, {2, 2}, 2);
    EXPECT_EQ(brightness(image, {0, 0}), 0);
    EXPECT_EQ(brightness(image, {256, 0}), 100 * 256);
    EXPECT_EQ(brightness(image, {128, 128}), 100 * 256);
    EXPECT_EQ(brightness(image, {-5000, 100000}), 200 * 256);
}

}  // namespace
}  // namespace fovea::test
