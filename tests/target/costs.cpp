// SPDX-License-Identifier: MIT
//
// What operators cost on a chip: each runs once over a picture of 320x240 between two marks, and
// count_instructions.cpp counts what the processor does there.
//
// A source file of its own: in one with the golden vectors, each new vector changes what the compiler
// inlines.
#include "costs.hpp"

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/catalogue/catalogue.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/morphology/bit_morphology.hpp>
#include <fovea/pixelwise/bits.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/statistics/binary_moments.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/projection.hpp>
#include <fovea/statistics/reductions.hpp>
#include <fovea/stream/stream.hpp>

extern "C" {
[[gnu::noinline]] void fovea_region_begin() { __asm volatile(""); }
[[gnu::noinline]] void fovea_region_end() { __asm volatile(""); }
}

namespace fovea::target {
namespace {

/// The memory of all costs, used by one after the other.
struct CostRoom {
    static constexpr Size size{320, 240};
    /// An integral image has a row and a column more.
    static constexpr int image_bytes = 4 * (size.width + 1) * (size.height + 1) + 12;

    alignas(16) std::uint8_t image[3][image_bytes];
    alignas(16) std::uint8_t scratch[600 * 1024];
    List<Region, 32> regions;
    List<Hole, 32> holes;
    Histogram histogram;

    template <class Pixel>
    ImageView<Pixel> view(int number) {
        return {reinterpret_cast<Pixel*>(image[number]), size,
                std::ptrdiff_t{size.width} * static_cast<int>(sizeof(Pixel))};
    }
};

/// Four bright discs on a darker ground, with noise of four bits. As binary image: the discs alone.
void put_discs(ImageView<Gray8> image, bool binary) {
    Random random(7);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const int dx = x % 160 - 80;
            const int dy = y % 120 - 60;
            const bool disc = dx * dx + dy * dy < 40 * 40;
            const int noise = static_cast<int>(random.next() >> 28);
            image(x, y) = static_cast<Gray8>(binary ? (disc ? 255 : 0) : (disc ? 160 : 60) + noise);
        }
}

/// run() between the marks, with its name told to tell(name) unless it refuses.
template <class Run>
void cost_of(const char* name, TellCost tell, Run run) {
    fovea_region_begin();
    const bool done = run();
    fovea_region_end();
    tell(name, done);
}

/// An entry of the catalogue; the first values in place of its presets.
void cost_of_operator(CostRoom& room, const Operator& op, const char* name, Span<const int> values,
                      TellCost tell) {
    OperatorCall call;
    for (int i = 0; i < op.parameter_count(); ++i)
        call.values[i] = i < values.size() ? values[i] : op.parameters[i].preset;
    for (int i = 0; i < op.input_count(); ++i) {
        const int bytes = bytes_of(op.inputs[i]);
        call.inputs[i] = {room.image[i], room.size, std::ptrdiff_t{room.size.width} * bytes};
        put_discs({room.image[i], {room.size.width * bytes, room.size.height}, call.inputs[i].stride_bytes},
                  false);
    }
    const Size out = op.size_for(room.size, call.values);
    const std::int64_t scratch = op.scratch_for(room.size, call.values);
    if (out.empty() || out.area() * bytes_of(op.output) > room.image_bytes ||
        scratch > static_cast<std::int64_t>(sizeof room.scratch))
        return;
    call.output = {room.image[2], out, std::ptrdiff_t{out.width} * bytes_of(op.output)};
    call.scratch = Span<std::uint8_t>(room.scratch).first(scratch);
    cost_of(name, tell, [&] { return run_operator(op, call) == Status::ok; });
}

/// What the catalogue does not have: from an image to something else.
void costs_of_answers(CostRoom& room, TellCost tell) {
    const ImageView<Gray8> gray = room.view<Gray8>(0);
    const ImageView<Gray8> binary = room.view<Gray8>(1);
    const Span<std::uint8_t> scratch = room.scratch;
    put_discs(gray, false);
    put_discs(binary, true);
    const auto ok = [](Status status) { return status == Status::ok; };
    cost_of("histogram", tell, [&] { return ok(histogram_of(gray, room.histogram)); });
    cost_of("otsu of a histogram", tell, [&] { return otsu(room.histogram).ok(); });
    cost_of("mean and variance", tell, [&] { return mean_and_variance(gray).ok(); });
    cost_of("moments of a binary image", tell, [&] { return moments_of(binary).ok(); });
    cost_of("connected components, 4 discs", tell,
            [&] { return ok(connected_components(binary, {}, scratch, room.regions, room.holes)); });
    cost_of("project columns", tell, [&] {
        return ok(project_columns(gray, {reinterpret_cast<std::uint32_t*>(room.scratch), room.size.width}));
    });

    const std::int64_t stride = room.size.width / 32;
    const auto bits = [&](int number) {
        return *bit_view_over<BitWord>({reinterpret_cast<BitWord*>(room.image[number]),
                                        static_cast<std::ptrdiff_t>(stride * room.size.height)},
                                       room.size, static_cast<std::ptrdiff_t>(stride));
    };
    const BitView<BitWord> packed = bits(1);
    const Span<BitWord> words(reinterpret_cast<BitWord*>(room.scratch),
                              static_cast<std::ptrdiff_t>(bit_erode_scratch(room.size)));
    cost_of("pack_bits", tell, [&] { return ok(pack_bits(gray, 128, packed)); });
    cost_of("erode bits 3x3", tell, [&] { return ok(erode(packed, {3, 3}, words, bits(2))); });
    cost_of("dilate bits 3x3", tell, [&] { return ok(dilate(packed, {3, 3}, words, bits(2))); });

    BinaryMoments moments;
    auto program =
        stream(stages::gaussian_3x3, stages::sobel_magnitude, stages::threshold{40}, into(moments));
    cost_of("stream: gaussian_3x3, sobel_magnitude, threshold, moments", tell,
            [&] { return ok(program.run(gray, Border::replicate, scratch)); });
}

CostRoom room;

}  // namespace

void for_each_cost(TellCost tell) {
    for (const OperatorFamily& family : operator_families)
        for (const Operator& op : family.operators) cost_of_operator(room, op, op.name, {}, tell);
    struct Variant {
        const char* op;
        const char* name;
        int values[2];
    };
    constexpr Variant variants[] = {
        {"erode", "erode 5x5", {5, 5}},
        {"erode", "erode 11x11", {11, 11}},
        {"bilateral", "bilateral, radius 1", {1}},
        {"adaptive_threshold", "adaptive_threshold 3x3", {3, 5}},
        {"resize_bilinear", "resize_bilinear to half", {160, 120}},
        {"resize_area", "resize_area to half", {160, 120}},
    };
    for (const Variant& variant : variants)
        if (const Operator* op = find_operator(operator_families, variant.op); op != nullptr)
            cost_of_operator(room, *op, variant.name, {variant.values, variant.values[1] == 0 ? 1 : 2}, tell);
    costs_of_answers(room, tell);
}

}  // namespace fovea::target
