// SPDX-License-Identifier: MIT
//
// Pipelines of every stage, drawn by lot, against the whole-frame functions one after the other.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <core/stream/stage_parts.hpp>
#include <fovea/base/random.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
Scratch span_of(Bytes& bytes) { return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}; }
Bytes bytes_of(std::int64_t count) { return Bytes(static_cast<std::size_t>(count), 0xee); }

/// What a stage takes and makes.
template <class Function>
struct FormOf;
template <class In, class Out>
struct FormOf<Status (*)(const Drawn&, ImageView<const In>, Border, Scratch, ImageView<Out>)> {
    using Input = In;
    using Output = Out;
};
template <class Part>
using InputOf = typename FormOf<decltype(&Part::frame)>::Input;
template <class Part>
using OutputOf = typename FormOf<decltype(&Part::frame)>::Output;

/// The images that three stages make.
template <class First, class Second, class Third>
struct Images {
    GuardedImage<OutputOf<First>> first;
    GuardedImage<OutputOf<Second>> second;
    GuardedImage<OutputOf<Third>> third;

    explicit Images(Size size) : first(size), second(size), third(size) {}
    bool operator==(const Images& other) const {
        return equal(first.view(), other.first.view()) && equal(second.view(), other.second.view()) &&
               equal(third.view(), other.third.view());
    }
    void wipe(Random& random) {
        first.fill(random);
        second.fill(random);
        third.fill(random);
    }
};

/// Sizes of every kind: smaller than windows, one row, one column, odd ones up to a few vectors.
Size draw_size(Random& random, int round) {
    switch (round % 6) {
        case 0: return {random.between(1, 9), 1};
        case 1: return {1, random.between(1, 12)};
        case 2: return {random.between(2, 7), random.between(2, 7)};
        case 3: return {random.between(30, 140), random.between(1, 5)};
        case 4: return {2 * random.between(15, 40) + 1, random.between(9, 24)};
        default: return {random.between(10, 70), random.between(6, 17)};
    }
}

/// The pipeline by frames, whole, in one to five strips, and row by row from one buffer that is written over.
template <class First, class Second, class Third>
void expect_same(std::uint32_t seed) {
    SCOPED_TRACE(seed);
    using Made = Images<First, Second, Third>;
    using Input = InputOf<First>;
    Random random(seed);
    for (int round = 0; round < 18; ++round) {
        const Size size = draw_size(random, round);
        const auto border = static_cast<Border>(round / 6);
        GuardedImage<Input> source(size);
        GuardedImage<Gray8> other(size);
        source.fill(random);
        other.fill(random);
        const ImageView<const Input> src = source.view();
        const Drawn drawn(random, other.view());

        Made expected(size);
        Bytes work = bytes_of(1 << 17);
        ASSERT_EQ(First::frame(drawn, src, border, span_of(work), expected.first.view()), Status::ok);
        ASSERT_EQ(Second::frame(drawn, expected.first.view(), border, span_of(work), expected.second.view()),
                  Status::ok);
        ASSERT_EQ(Third::frame(drawn, expected.second.view(), border, span_of(work), expected.third.view()),
                  Status::ok);

        Made made(size);
        const auto make = [&] {
            return stream(First::stage(drawn), tap(made.first.view()), Second::stage(drawn),
                          tap(made.second.view()), Third::stage(drawn), into(made.third.view()));
        };
        const auto expect_all = [&](const char* form) {
            ASSERT_TRUE(made == expected)
                << form << " " << size.width << "x" << size.height << " border " << static_cast<int>(border);
            made.wipe(random);
        };
        auto program = make();
        Bytes scratch = bytes_of(program.scratch(size.width));
        ASSERT_EQ(program.run(src, border, span_of(scratch)), Status::ok);
        expect_all("whole");

        const int strips = minimum(random.between(1, 5), size.height);
        for (int i = 0; i < strips; ++i) {
            auto strip = make();
            ASSERT_EQ(strip.run_strip(src, border, size.height * i / strips,
                                      size.height * (i + 1) / strips - 1, span_of(scratch)),
                      Status::ok);
        }
        expect_all("strips");

        ASSERT_EQ(program.start(size, border, span_of(scratch)), Status::ok);
        // Nothing in a stream points to the stream itself.
        auto camera = program;
        std::vector<Input> line(static_cast<std::size_t>(size.width));
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) line[static_cast<std::size_t>(x)] = source(x, y);
            ASSERT_EQ(camera.push(line.data()), Status::ok);
        }
        ASSERT_TRUE(camera.complete());
        expect_all("rows");
    }
}

template <class Parts, std::size_t Index>
using PartAt = std::tuple_element_t<Index % std::tuple_size_v<Parts>, Parts>;

/// Pipelines that hold every part of the list: the lot is a step through it that has no factor in common with
/// its length.
template <std::size_t Step, std::size_t... Pipeline>
void expect_gray(std::index_sequence<Pipeline...>) {
    (expect_same<PartAt<GrayParts, 3 * Pipeline * Step>, PartAt<GrayParts, (3 * Pipeline + 1) * Step>,
                 PartAt<GrayParts, (3 * Pipeline + 2) * Step>>(
         static_cast<std::uint32_t>(100 * Step + Pipeline)),
     ...);
}
template <std::size_t... Pipeline>
void expect_heads_and_tails(std::index_sequence<Pipeline...>) {
    (expect_same<PartAt<HeadParts, Pipeline>, PartAt<GrayParts, 7 * Pipeline + 1>,
                 PartAt<TailParts, Pipeline>>(static_cast<std::uint32_t>(1000 + Pipeline)),
     ...);
}
template <class... Parts>
void expect_chain(std::tuple<Parts...>*, std::uint32_t seed) {
    expect_same<Parts...>(seed);
}
template <class Chain>
void expect_chain(std::uint32_t seed) {
    expect_chain(static_cast<Chain*>(nullptr), seed);
}

constexpr std::size_t gray_parts = std::tuple_size_v<GrayParts>;
static_assert(gray_parts % 3 == 0 && gray_parts % 7 != 0 && gray_parts % 2 != 0);
static_assert(std::tuple_size_v<HeadParts> == std::tuple_size_v<TailParts>);

TEST(RandomStreams, OfGrayStagesGiveTheBitsOfWholeFramesInEveryForm) {
    expect_gray<1>(std::make_index_sequence<gray_parts / 3>());
}
TEST(RandomStreams, BeginAndEndWithPixelsOfEveryKind) {
    expect_heads_and_tails(std::make_index_sequence<std::tuple_size_v<HeadParts>>());
}
TEST(RandomStreams, GoFromOneKindOfPixelsToTheNext) {
    expect_chain<Rgb565ToHues>(1);
    expect_chain<YuyvToGray>(2);
    expect_chain<UyvyToGray>(3);
    expect_chain<EdgesToGray>(4);
    expect_chain<WidthAndBack>(5);
}

}  // namespace
}  // namespace fovea::test
