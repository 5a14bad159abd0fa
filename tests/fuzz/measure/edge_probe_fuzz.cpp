// SPDX-License-Identifier: MIT
//
// Any probe on any picture, down to one pixel and up to the longest row: edges lie on the probe, in order,
// and their straightness is a number.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fovea/measure/edge_probe.hpp>
#include <fovea/measure/edge_straightness.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

struct Input {
    std::uint8_t width, height, levels[8];
    std::int32_t from_x, from_y, to_x, to_y, across_x, across_y;
    std::int32_t strength_min;
    std::uint8_t lines, smoothing, room, near;
};

/// One of the numbers that fit this picture, or any.
std::int32_t coordinate(const Input& input, std::int32_t value, int side) {
    return input.near % 2 == 0 ? static_cast<std::int32_t>(
                                     magnitude(value) % (static_cast<std::uint32_t>(side) * FinePixel::one))
                               : value;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input input{};
    if (size < sizeof input) return 0;
    std::memcpy(&input, data, sizeof input);
    const bool long_row = input.near >= 250;
    const Size picture_size =
        long_row ? Size{max_image_side, 1} : Size{1 + input.width % 64, 1 + input.height % 64};
    std::vector<Gray8> pixels(static_cast<std::size_t>(picture_size.area()));
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = input.levels[i * 5 / 8 % 8];
    const ImageView<const Gray8> image(pixels.data(), picture_size, picture_size.width);

    const auto fine = [&](std::int32_t x, std::int32_t y) {
        return FinePoint{FinePixel::from_raw(coordinate(input, x, picture_size.width)),
                         FinePixel::from_raw(coordinate(input, y, picture_size.height))};
    };
    const EdgeProbe probe{fine(input.from_x, input.from_y),
                          fine(input.to_x, input.to_y),
                          {FinePixel::from_raw(input.near % 4 < 2 ? input.across_x >> 12 : input.across_x),
                           FinePixel::from_raw(input.near % 4 < 2 ? input.across_y >> 12 : input.across_y)},
                          input.lines,
                          input.smoothing % 20};
    std::vector<std::uint16_t> scratch(static_cast<std::size_t>(edge_probe_scratch(picture_size)));
    Edge edges[8];
    int count = 0;
    const Status status = edge_probe(image, probe, GrayLevel::from_raw(input.strength_min),
                                     {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                                     ListView<Edge>(edges, 1 + input.room % 8, &count));
    require(status == Status::ok || status == Status::bad_argument || status == Status::out_of_range ||
            status == Status::capacity_exceeded);
    require(status == Status::ok || status == Status::capacity_exceeded || count == 0);
    for (int i = 0; i < count; ++i) {
        require(edges[i].share.raw() >= 0 && edges[i].share.raw() <= Unit::one && edges[i].blur.raw() >= 0);
        require(i == 0 || edges[i - 1].share <= edges[i].share);
        require(can_sample(picture_size, edges[i].place));
        require(magnitude(edges[i].strength.raw()) >= magnitude(input.strength_min));
    }
    if (count == 0) return 0;
    const Result<FinePixel> stray = edge_straightness(
        image, probe, edges[0], {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
        ListView<Edge>(edges, 1 + input.room % 8, &count));
    require(stray.ok() && stray->raw() >= 0 && (probe.lines > 2 || stray->raw() == 0));
    return 0;
}
