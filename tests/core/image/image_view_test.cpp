// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <climits>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <fovea/image/image_view.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

/// Six rows of ten pixels, each 10 y + x.
GuardedImage<Gray8> numbered() {
    GuardedImage<Gray8> image({10, 6});
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 10; ++x) image(x, y) = static_cast<Gray8>(10 * y + x);
    return image;
}

TEST(ImageView, IsEmptyAtFirst) {
    const ImageView<Gray8> none;
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(none.size(), Size());
    EXPECT_EQ(none.first(), nullptr);
    EXPECT_FALSE(none.contains({0, 0}));
    EXPECT_TRUE((ImageView<Gray8>(nullptr, {0, 7}, 3).empty()));
    EXPECT_TRUE((ImageView<Gray8>(nullptr, {7, 0}, 3).empty()));
}

TEST(ImageView, FindsPixelsByTheirStride) {
    GuardedImage<Gray8> image = numbered();
    const ImageView<Gray8> view = image.view();
    EXPECT_EQ(view.width(), 10);
    EXPECT_EQ(view.height(), 6);
    EXPECT_EQ(view.row(2)[3], 23);
    EXPECT_EQ(view(3, 2), 23);
    EXPECT_EQ(view.row(1) - view.row(0), view.stride_bytes());
    view(3, 2) = 99;
    EXPECT_EQ(image(3, 2), 99);
}

TEST(ImageView, CountsItsStrideInBytesForWidePixelsToo) {
    std::uint16_t pixels[] = {1, 2, 3, 4, 5, 6};
    const ImageView<Gray16> view(pixels, {2, 2}, 6);
    EXPECT_EQ(view(0, 1), 4);
    EXPECT_EQ(view(1, 1), 5);
    // Rows may overlap, and run upwards, where nobody writes.
    const ImageView<const Gray16> overlapping(pixels, {4, 3}, 2);
    EXPECT_EQ(overlapping(3, 2), 6);
    const ImageView<const Gray16> upwards(pixels + 3, {3, 2}, -6);
    EXPECT_EQ(upwards(0, 0), 4);
    EXPECT_EQ(upwards(2, 1), 3);
}

TEST(ImageView, ContainsItsOutermostPixelsAndNoneBeyond) {
    GuardedImage<Gray8> image({4, 3});
    const ImageView<const Gray8> view = image.view();
    for (int y = -2; y < 6; ++y)
        for (int x = -2; x < 7; ++x)
            EXPECT_EQ(view.contains({x, y}), x >= 0 && x < 4 && y >= 0 && y < 3) << x << " " << y;
    EXPECT_FALSE(view.contains({INT_MAX, 0}));
    EXPECT_FALSE(view.contains({0, INT_MIN}));
}

TEST(ImageView, BecomesReadOnlyButNeverWritable) {
    static_assert(std::is_convertible_v<ImageView<Gray8>, ImageView<const Gray8>>);
    static_assert(!std::is_convertible_v<ImageView<const Gray8>, ImageView<Gray8>>);
    static_assert(!std::is_convertible_v<ImageView<Gray8>, ImageView<const Gradient16>>);
    static_assert(std::is_same_v<ImageView<const Gray8>::value_type, Gray8>);
    GuardedImage<Gray8> image = numbered();
    const ImageView<const Gray8> view = image.view();
    EXPECT_EQ(view.first(), image.view().first());
    EXPECT_EQ(view.size(), image.view().size());
    EXPECT_EQ(view.stride_bytes(), image.view().stride_bytes());
}

TEST(Crop, ShowsTheSamePixels) {
    GuardedImage<Gray8> image = numbered();
    const Result<ImageView<Gray8>> part = image.view().crop({2, 1, 5, 3});
    ASSERT_TRUE(part.ok());
    EXPECT_EQ(part->size(), (Size{5, 3}));
    EXPECT_EQ((*part)(0, 0), 12);
    EXPECT_EQ((*part)(4, 2), 36);
    (*part)(4, 2) = 0;
    EXPECT_EQ(image(6, 3), 0);
    const Result<ImageView<Gray8>> again = part->crop({1, 1, 2, 1});
    ASSERT_TRUE(again.ok());
    EXPECT_EQ((*again)(0, 0), 23);
    const Result<ImageView<Gray8>> whole = image.view().crop({0, 0, 10, 6});
    ASSERT_TRUE(whole.ok());
    EXPECT_EQ(whole->first(), image.view().first());
    EXPECT_TRUE(image.view().crop({9, 5, 1, 1}).ok());
}

TEST(Crop, RefusesWhatIsNotWhollyInside) {
    GuardedImage<Gray8> image({10, 6});
    const ImageView<Gray8> view = image.view();
    for (const Rectangle area : {Rectangle{-1, 0, 3, 3}, Rectangle{0, -1, 3, 3}, Rectangle{8, 0, 3, 3},
                                 Rectangle{0, 4, 3, 3}, Rectangle{10, 0, 1, 1}, Rectangle{0, 6, 1, 1},
                                 Rectangle{0, 0, 11, 6}, Rectangle{0, 0, 10, 7}, Rectangle{INT_MAX, 0, 1, 1},
                                 Rectangle{1, 0, INT_MAX, 1}, Rectangle{INT_MAX, INT_MAX, INT_MAX, INT_MAX},
                                 Rectangle{INT_MIN, 0, 1, 1}, Rectangle{0, INT_MIN, INT_MAX, INT_MAX}})
        EXPECT_EQ(view.crop(area).status(), Status::out_of_range) << area.x << " " << area.y;
    EXPECT_EQ(view.crop({0, 0, 0, 3}).status(), Status::empty_image);
    EXPECT_EQ(view.crop({0, 0, 3, -1}).status(), Status::empty_image);
    EXPECT_EQ(view.crop({INT_MIN, INT_MIN, INT_MIN, INT_MIN}).status(), Status::empty_image);
    EXPECT_EQ(ImageView<Gray8>().crop({0, 0, 1, 1}).status(), Status::out_of_range);
}

TEST(ViewOver, TakesMemoryWhoseLastRowEndsWithItsPixels) {
    std::vector<std::uint8_t> bytes(8 + 8 + 5);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);
    const auto view = view_over<Gray8>(span_of(bytes), {5, 3}, 8);
    ASSERT_TRUE(view.ok());
    EXPECT_EQ(view->size(), (Size{5, 3}));
    EXPECT_EQ(view->stride_bytes(), 8);
    EXPECT_EQ((*view)(4, 2), 20);
    EXPECT_EQ(view_over<Gray8>(span_of(bytes).first(20), {5, 3}, 8).status(), Status::truncated);
    EXPECT_TRUE(view_over<Gray8>(span_of(bytes).first(5), {5, 1}, 5).ok());
    EXPECT_TRUE(view_over<Rgb888>(span_of(bytes), {7, 1}, 21).ok());
    EXPECT_TRUE(view_over<Rgb888>(span_of(bytes), {3, 2}, 11).ok()) << "packed pixels need no alignment";
}

TEST(ViewOver, ReadsConstantMemoryThroughReadOnlyPixels) {
    const std::vector<std::uint8_t> bytes = {1, 2, 3, 4};
    const auto view = view_over<const Gray8>(Span<const std::uint8_t>(bytes.data(), 4), {2, 2}, 2);
    ASSERT_TRUE(view.ok());
    EXPECT_EQ((*view)(1, 1), 4);
    std::vector<std::uint8_t> writable = bytes;
    EXPECT_TRUE(view_over<const Gray8>(span_of(writable), {2, 2}, 2).ok());
}

TEST(ViewOver, TellsEveryErrorInTheOrderOfItsChecks) {
    alignas(8) std::uint8_t memory[64] = {};
    const Span<std::uint8_t> bytes(memory);
    const auto status = [](Span<std::uint8_t> over, Size size, std::ptrdiff_t stride) {
        return view_over<Gray16>(over, size, stride).status();
    };
    EXPECT_EQ(status({}, {0, 0}, -1), Status::empty_image);
    EXPECT_EQ(status(bytes, {3, 0}, 6), Status::empty_image);
    EXPECT_EQ(status(bytes, {-3, 2}, 6), Status::empty_image);
    EXPECT_EQ(status(bytes, {INT_MIN, INT_MIN}, 6), Status::empty_image);
    EXPECT_EQ(status(bytes, {max_image_side + 1, 1}, 1), Status::image_too_large);
    EXPECT_EQ(status(bytes, {1, max_image_side + 1}, 1), Status::image_too_large);
    EXPECT_EQ(status(bytes.from(1), {INT_MAX, INT_MAX}, -1), Status::image_too_large);
    EXPECT_EQ(status(bytes, {3, 2}, 5), Status::bad_argument) << "shorter than a row";
    EXPECT_EQ(status(bytes, {3, 2}, 7), Status::bad_argument) << "odd";
    EXPECT_EQ(status(bytes, {3, 1}, 0), Status::bad_argument);
    EXPECT_EQ(status(bytes, {3, 2}, -6), Status::bad_argument);
    EXPECT_EQ(status(bytes.from(1), {3, 2}, 7), Status::bad_argument);
    EXPECT_EQ(status(bytes.from(1), {3, 2}, 6), Status::misaligned);
    EXPECT_EQ(status(bytes.from(1).first(3), {3, 2}, 6), Status::misaligned);
    EXPECT_EQ(status(bytes.first(11), {3, 2}, 6), Status::truncated);
    EXPECT_EQ(status({}, {3, 2}, 6), Status::truncated);
    EXPECT_EQ(status(bytes.first(12), {3, 2}, 6), Status::ok);
    EXPECT_EQ(status(bytes.from(2), {3, 2}, 6), Status::ok);
}

TEST(ViewOver, IsNotFooledByStridesAndSizesThatOverflow) {
    std::vector<std::uint8_t> bytes(64);
    const auto status = [&](Size size, std::ptrdiff_t stride) {
        return view_over<Gray8>(span_of(bytes), size, stride).status();
    };
    constexpr std::ptrdiff_t most = PTRDIFF_MAX;
    EXPECT_EQ(status({1, 2}, most), Status::truncated);
    EXPECT_EQ(status({64, max_image_side}, most), Status::truncated);
    EXPECT_EQ(status({1, 3}, most / 2 + 1), Status::truncated) << "twice the stride is 2^63";
    EXPECT_EQ(status({1, 5}, most / 4 + 1), Status::truncated) << "four times the stride is 2^63";
    EXPECT_EQ(status({8, max_image_side}, most / (max_image_side - 1) + 1), Status::truncated);
    EXPECT_EQ(status({1, 2}, PTRDIFF_MIN), Status::bad_argument);
    EXPECT_EQ(status({max_image_side, max_image_side}, max_image_side), Status::truncated);
    // One row needs no stride, however long it is said to be.
    EXPECT_EQ(status({64, 1}, most), Status::ok);
    EXPECT_EQ(status({65, 1}, most), Status::truncated);
}

TEST(ViewOver, AgreesWithTheSumOfItsRowsOnEverySmallSize) {
    std::vector<std::uint8_t> bytes(40);
    for (int height = 1; height <= 6; ++height)
        for (int width = 1; width <= 6; ++width)
            for (std::ptrdiff_t stride = 0; stride <= 10; ++stride)
                for (std::ptrdiff_t count = 0; count <= 40; ++count) {
                    const Status expected = stride < width                          ? Status::bad_argument
                                            : (height - 1) * stride + width > count ? Status::truncated
                                                                                    : Status::ok;
                    ASSERT_EQ(view_over<Gray8>(span_of(bytes).first(count), {width, height}, stride).status(),
                              expected)
                        << width << "x" << height << " stride " << stride << " in " << count;
                }
}

#if !defined(NDEBUG)
TEST(ImageViewDeathTest, StopsAtPixelsOutsideWhileDebugging) {
    GuardedImage<Gray8> image({4, 3});
    const ImageView<Gray8> view = image.view();
    EXPECT_DEATH(static_cast<void>(view(4, 0)), "");
    EXPECT_DEATH(static_cast<void>(view(-1, 0)), "");
    EXPECT_DEATH(static_cast<void>(view.row(3)), "");
    EXPECT_DEATH(static_cast<void>(view.row(-1)), "");
}
#endif

}  // namespace
}  // namespace fovea::test
