// SPDX-License-Identifier: MIT
//
// Streams against the whole-frame functions of their stages, one after the other.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/filter/box.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/gaussian_sigma.hpp>
#include <fovea/filter/laplacian.hpp>
#include <fovea/filter/median.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/image/image_storage.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/morphology/morphology_stages.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

using View = ImageView<const Gray8>;
using Scratch = Span<std::uint8_t>;
using Bytes = std::vector<std::uint8_t>;

Scratch span_of(Bytes& bytes) { return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}; }
Bytes bytes_of(std::int64_t count) { return Bytes(static_cast<std::size_t>(count), 0xee); }

// ---- Whole frames -------------------------------------------------------------------------

/// A stage of gray pixels and the function that does the same with a frame.
struct Smooth {
    static constexpr auto stage = stages::gaussian_5x5;
    static Status frame(View src, Border b, Scratch s, ImageView<Gray8> dst) {
        return gaussian_5x5(src, b, s, dst);
    }
};
struct Middle {
    static constexpr auto stage = stages::median_3x3;
    static Status frame(View src, Border b, Scratch s, ImageView<Gray8> dst) {
        return median_3x3(src, b, s, dst);
    }
};
struct Mean {
    static constexpr stages::box stage{{7, 9}};
    static Status frame(View src, Border b, Scratch s, ImageView<Gray8> dst) {
        return box(src, {7, 9}, b, s, dst);
    }
};
struct Edges {
    static constexpr auto stage = stages::sobel_magnitude;
    static Status frame(View src, Border b, Scratch s, ImageView<Gray8> dst) {
        return sobel_magnitude(src, b, s, dst);
    }
};
struct Shrunk {
    static constexpr stages::erode stage{{3, 5}};
    static Status frame(View src, Border, Scratch s, ImageView<Gray8> dst) {
        return erode(src, {3, 5}, s, dst);
    }
};
struct Binary {
    static constexpr stages::threshold stage{100};
    static Status frame(View src, Border, Scratch, ImageView<Gray8> dst) { return threshold(src, 100, dst); }
};
using AllParts = std::tuple<Smooth, Middle, Mean, Edges, Shrunk, Binary>;

template <class... Parts>
void whole_frames(GuardedImage<Gray8> image, Border border, std::vector<GuardedImage<Gray8>>& steps) {
    Bytes scratch = bytes_of(1 << 16);
    const auto step = [&](auto frame) {
        GuardedImage<Gray8> dst(image.view().size());
        ASSERT_EQ(frame(std::as_const(image).view(), border, span_of(scratch), dst.view()), Status::ok);
        steps.push_back(dst);
        image = dst;
    };
    (step(Parts::frame), ...);
}

/// The pipeline whole, by strips, and row by row from one buffer that is written over.
template <class First, class Second, class Third>
void expect_same(std::uint32_t seed) {
    for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{5, 4}, Size{33, 7}, Size{67, 23}})
        for (const Border border : {Border::replicate, Border::reflect_101, Border::zero}) {
            Random random(seed);
            GuardedImage<Gray8> src(size), out(size), first(size), second(size);
            src.fill(random);
            std::vector<GuardedImage<Gray8>> steps;
            whole_frames<First, Second, Third>(src, border, steps);

            // One type of stream, whose three images show what every stage made.
            const auto make = [](GuardedImage<Gray8>& a, GuardedImage<Gray8>& b, GuardedImage<Gray8>& c) {
                return stream(First::stage, tap(a.view()), Second::stage, tap(b.view()), Third::stage,
                              into(c.view()));
            };
            const auto expect_steps = [&] {
                EXPECT_TRUE(equal(first.view(), steps[0].view())) << size.width << "x" << size.height;
                EXPECT_TRUE(equal(second.view(), steps[1].view())) << size.width << "x" << size.height;
                EXPECT_TRUE(equal(out.view(), steps[2].view())) << size.width << "x" << size.height;
                for (GuardedImage<Gray8>* image : {&first, &second, &out}) image->fill(Gray8{90});
            };
            auto program = make(first, second, out);
            Bytes scratch = bytes_of(program.scratch(size.width));
            ASSERT_EQ(program.run(std::as_const(src).view(), border, span_of(scratch)), Status::ok);
            ASSERT_TRUE(program.complete());
            expect_steps();

            for (int top = 0; top < size.height;) {
                const int bottom = random.between(top, size.height - 1);
                auto strip = make(first, second, out);
                ASSERT_EQ(strip.run_strip(std::as_const(src).view(), border, top, bottom, span_of(scratch)),
                          Status::ok);
                top = bottom + 1;
            }
            expect_steps();

            auto camera = make(first, second, out);
            ASSERT_EQ(camera.start(size, border, span_of(scratch)), Status::ok);
            std::vector<Gray8> line(static_cast<std::size_t>(size.width));
            for (int y = 0; y < size.height; ++y) {
                ASSERT_FALSE(camera.complete());
                for (int x = 0; x < size.width; ++x) line[static_cast<std::size_t>(x)] = src(x, y);
                ASSERT_EQ(camera.push(line.data()), Status::ok);
            }
            ASSERT_TRUE(camera.complete());
            ASSERT_EQ(camera.push(line.data()), Status::out_of_range);
            expect_steps();
            if (testing::Test::HasFailure()) return;
        }
}

constexpr std::uint32_t mixed(std::uint32_t number) { return (number * 2654435761u + 12345u) >> 9; }
template <std::uint32_t Seed>
using Drawn = std::tuple_element_t<mixed(Seed) % std::tuple_size_v<AllParts>, AllParts>;

template <std::uint32_t Seed>
void expect_drawn() {
    SCOPED_TRACE(Seed);
    expect_same<Drawn<3 * Seed>, Drawn<3 * Seed + 1>, Drawn<3 * Seed + 2>>(Seed);
}
template <std::uint32_t... Seed>
void expect_all(std::integer_sequence<std::uint32_t, Seed...>) {
    (expect_drawn<Seed + 1>(), ...);
}

TEST(Stream, OfStagesDrawnByLotGivesTheBitsOfWholeFramesInEveryForm) {
    expect_all(std::make_integer_sequence<std::uint32_t, 10>());
}

TEST(Stream, TurnsPackedColourIntoEdgesInOnePass) {
    const Size size{45, 17};
    Random random(4);
    GuardedImage<Yuyv> src(size);
    src.fill(random);
    GuardedImage<Gray8> gray(size), smooth(size), edges(size), expected(size), out(size);
    ASSERT_EQ(to_gray(std::as_const(src).view(), gray.view()), Status::ok);
    Bytes scratch = bytes_of(1 << 16);
    ASSERT_EQ(gaussian_5x5(gray.view(), Border::reflect_101, span_of(scratch), smooth.view()), Status::ok);
    ASSERT_EQ(sobel_magnitude(smooth.view(), Border::reflect_101, span_of(scratch), edges.view()),
              Status::ok);
    ASSERT_EQ(threshold(edges.view(), 40, expected.view()), Status::ok);
    auto program = stream(stages::gray_from_yuyv, stages::gaussian_5x5, stages::sobel_magnitude,
                          stages::threshold{40}, into(out.view()));
    Bytes memory = bytes_of(program.scratch(size.width));
    ASSERT_EQ(program.run(std::as_const(src).view(), Border::reflect_101, span_of(memory)), Status::ok);
    EXPECT_TRUE(equal(out.view(), expected.view()));
}

TEST(Stream, BeginsWithEveryFormOfColourAsItsFunctionDoes) {
    const Size size{45, 7};
    Random random(6);
    Bytes memory = bytes_of(1 << 14);
    const auto expect = [&](auto stage, auto src) {
        src.fill(random);
        GuardedImage<Gray8> expected(size), out(size);
        ASSERT_EQ(to_gray(std::as_const(src).view(), expected.view()), Status::ok);
        auto program = stream(stage, into(out.view()));
        ASSERT_EQ(program.run(std::as_const(src).view(), Border::replicate, span_of(memory)), Status::ok);
        EXPECT_TRUE(equal(out.view(), expected.view()));
    };
    expect(stages::gray_from_rgb, GuardedImage<Rgb888>(size));
    expect(stages::gray_from_yuyv, GuardedImage<Yuyv>(size));
    expect(stages::gray_from_uyvy, GuardedImage<Uyvy>(size));
}

TEST(Stream, EndsInPixelsOfAnotherKind) {
    const Size size{40, 9};
    Random random(5);
    GuardedImage<Gray8> src(size), smooth(size);
    GuardedImage<Gradient16> expected(size), out(size);
    src.fill(random);
    Bytes scratch = bytes_of(1 << 16);
    ASSERT_EQ(gaussian_3x3(src.view(), Border::zero, span_of(scratch), smooth.view()), Status::ok);
    ASSERT_EQ(laplacian_4(smooth.view(), Border::zero, span_of(scratch), expected.view()), Status::ok);
    auto program = stream(stages::gaussian_3x3, stages::laplacian_4, into(out.view()));
    Bytes memory = bytes_of(program.scratch(size.width));
    ASSERT_EQ(program.run(std::as_const(src).view(), Border::zero, span_of(memory)), Status::ok);
    EXPECT_TRUE(equal(out.view(), expected.view()));
}

// ---- Accumulators -------------------------------------------------------------------------

/// Remembers which rows came, in which order.
struct RowNumbers {
    using Input = Gray8;
    std::vector<int> rows;
    std::int64_t sum = 0;
    Size size;

    Status begin(Size of) {
        rows.clear();
        sum = 0;
        size = of;
        return of.width > 100 ? Status::image_too_large : Status::ok;
    }
    void add_row(const Gray8* row, int width, int y) {
        rows.push_back(y);
        for (int x = 0; x < width; ++x) sum += row[x];
    }
};

TEST(Stream, ShowsAnAccumulatorEveryRowOnceFromTopToBottom) {
    GuardedImage<Gray8> src({10, 6});
    src.fill(Gray8{3});
    auto program = stream(stages::gaussian_5x5, RowNumbers());
    Bytes memory = bytes_of(program.scratch(10));
    ASSERT_EQ(program.run(src.view(), Border::replicate, span_of(memory)), Status::ok);
    EXPECT_EQ(program.accumulator().rows, (std::vector<int>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(program.accumulator().sum, 180);
    EXPECT_EQ(program.accumulator().size, (Size{10, 6}));
    ASSERT_EQ(program.run_strip(src.view(), Border::replicate, 2, 3, span_of(memory)), Status::ok);
    EXPECT_EQ(program.accumulator().rows, (std::vector<int>{2, 3}));
    RowNumbers elsewhere;
    auto other = stream(tap(elsewhere), stages::gaussian_5x5, RowNumbers());
    ASSERT_EQ(other.run_strip(src.view(), Border::replicate, 2, 3, span_of(memory)), Status::ok);
    EXPECT_EQ(elsewhere.rows, (std::vector<int>{2, 3}));
}

TEST(Stream, OfAnAccumulatorAloneTakesTheRowsAsTheyAre) {
    GuardedImage<Gray8> src({3, 4});
    src.fill(Gray8{7});
    auto program = stream(RowNumbers());
    Bytes memory = bytes_of(program.scratch(3));
    ASSERT_EQ(program.run(src.view(), Border::replicate, span_of(memory)), Status::ok);
    EXPECT_EQ(program.accumulator().sum, 84);
}

TEST(Stream, SaysWhatIsWrong) {
    GuardedImage<Gray8> src({16, 4}), out({16, 4}), other({15, 4});
    src.fill(Gray8{1});
    out.fill(Gray8{77});
    auto program = stream(stages::gaussian_5x5, into(out.view()));
    Bytes memory = bytes_of(program.scratch(16));
    const Scratch scratch = span_of(memory);
    EXPECT_EQ(program.push(src.view().row(0)), Status::out_of_range);
    EXPECT_EQ(program.run({}, Border::replicate, scratch), Status::empty_image);
    EXPECT_EQ(program.start({0, 4}, Border::replicate, scratch), Status::empty_image);
    EXPECT_EQ(program.start({16, 40000}, Border::replicate, scratch), Status::image_too_large);
    EXPECT_EQ(program.run(src.view(), Border::replicate, scratch.first(scratch.size() - 1)),
              Status::scratch_too_small);
    EXPECT_EQ(program.push(src.view().row(0)), Status::out_of_range);
    for (const auto& rows : {std::pair<int, int>{-1, 2}, {2, 1}, {0, 4}})
        EXPECT_EQ(program.run_strip(src.view(), Border::replicate, rows.first, rows.second, scratch),
                  Status::out_of_range);
    auto wrong = stream(stages::gaussian_5x5, into(other.view()));
    EXPECT_EQ(wrong.run(src.view(), Border::replicate, scratch), Status::size_mismatch);
    auto refusing = stream(stages::gaussian_3x3, RowNumbers());
    Bytes large = bytes_of(refusing.scratch(101));
    EXPECT_EQ(refusing.start({101, 1}, Border::replicate, span_of(large)), Status::image_too_large);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_EQ(out(x, y), 77);
}

/// Whatever the stages before it do, it may be reached only by valid ones.
template <class Stage>
void expect_refused(const Stage& stage) {
    GuardedImage<Gray8> src({16, 4}), out({16, 4});
    src.fill(Gray8{1});
    out.fill(Gray8{77});
    auto program = stream(stages::gaussian_5x5, stage, stages::median_3x3, into(out.view()));
    Bytes memory = bytes_of(1 << 16);
    EXPECT_EQ(program.run(src.view(), Border::replicate, span_of(memory)), Status::bad_argument);
    EXPECT_EQ(program.start({16, 4}, Border::zero, span_of(memory)), Status::bad_argument);
    EXPECT_EQ(memory, bytes_of(1 << 16));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_EQ(out(x, y), 77);
}

TEST(Stream, RefusesAStageWhoseOperatorWouldRefuseItsParameters) {
    for (const Size element :
         {Size{2, 3}, Size{3, 2}, Size{65, 3}, Size{3, 65}, Size{0, 0}, Size{3, -3}, Size{-3, 3}}) {
        expect_refused(stages::box{element});
        expect_refused(stages::erode{element});
        expect_refused(stages::dilate{element});
    }
    for (const int reach : {-1, 32, 1 << 30}) {
        GaussianTaps taps;
        taps.reach = reach;
        expect_refused(stages::gaussian{taps});
    }
}

TEST(Stream, KnowsItsScratchWhenItIsCompiled) {
    static ImageStorage<Gray8, 64, 8> out;
    static constexpr std::int64_t bytes =
        Stream(stages::gaussian_5x5, stages::sobel_magnitude, IntoImage<Gray8>(ImageView<Gray8>()))
            .scratch(64);
    auto program = stream(stages::gaussian_5x5, stages::sobel_magnitude, into(out.view()));
    EXPECT_EQ(program.scratch(64), bytes);
    // Two windows of 5 and 3 rows, their lines, zeros and alignment: far less than the frame of a camera.
    EXPECT_LT(bytes, 64 * 48);
}

}  // namespace
}  // namespace fovea::test
