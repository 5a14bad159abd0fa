// SPDX-License-Identifier: MIT
//
// Golden vectors of morphology/ that the catalogue does not make: elements of any shape, images of bits, and
// all passes of thinning.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/morphology/bit_morphology.hpp>
#include <fovea/morphology/hit_or_miss.hpp>
#include <fovea/morphology/shaped_morphology.hpp>
#include <fovea/morphology/structuring_element.hpp>
#include <fovea/morphology/thinning.hpp>
#include <fovea/pixelwise/bits.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const StructuringElement& element) {
    digest.add(element.size(), element.count(), element.empty());
    for (int y = 0; y < element.size().height; ++y) digest.add(element.row(y));
}

inline void morphology_shapes(Workspace& work, Digest& digest) {
    for (const Size size : {Size{1, 1}, Size{3, 5}, Size{31, 7}, Size{2, 3}, Size{33, 1}})
        digest.add(StructuringElement::rectangle(size), StructuringElement::cross(size));
    for (int side = -1; side <= 33; ++side) digest.add(StructuringElement::disc(side));
    for (int x = -16; x <= 16; x += 3)
        for (int y = -16; y <= 16; y += 2) digest.add(StructuringElement::line({x, y}));
    const StructuringElement hook = StructuringElement::from_text("#......\n#.....#\n.######");
    digest.add(hook, hook.reflected(), hook.contains(0, 0), StructuringElement::from_text("##\n#"));
    const auto run = [&](ImageView<const Gray8> src, ImageView<Gray8> dst,
                         const StructuringElement& element) {
        // How much scratch there must be differs by the width of a vector and of a pointer.
        const Span<std::uint8_t> scratch = work.scratch_span();
        digest.add(erode(src, element, scratch.first(erode_scratch(src.size(), element)), dst), dst);
        digest.add(dilate(src, element, scratch.first(dilate_scratch(src.size(), element)), dst), dst);
        digest.add(opening(src, element, scratch.first(opening_scratch(src.size(), element)), dst), dst);
        digest.add(closing(src, element, scratch.first(closing_scratch(src.size(), element)), dst), dst);
    };
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8> dst) {
        for (const StructuringElement& element :
             {hook, StructuringElement::cross({3, 3}), StructuringElement::disc(9), StructuringElement()})
            run(src, dst, element);
    });
}

inline void put(Digest& digest, BitView<BitWord> bits) {
    digest.add(bits.size(), bits.stride_words(), last_bits(bits.width()));
    for (int y = 0; y < bits.height(); ++y)
        for (int i = 0; i < bit_words(bits.width()); ++i) digest.add(bits.row(y)[i]);
}

/// Bits in an arena; their rows are a word apart.
inline BitView<BitWord> arena_bits(Arena& arena, Size size) {
    const std::ptrdiff_t stride = bit_words(size.width) + 1;
    return *bit_view_over<BitWord>(arena.take<BitWord>(stride * size.height), size, stride);
}

inline void morphology_bits(Workspace& work, Digest& digest) {
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8> dst) {
        Arena arena(work.scratch_span());
        const BitView<BitWord> a = arena_bits(arena, src.size());
        const BitView<BitWord> b = arena_bits(arena, src.size());
        const BitView<BitWord> c = arena_bits(arena, src.size());
        const Span<BitWord> scratch = arena.take<BitWord>(bit_erode_scratch(src.size()));
        digest.add(bit_dilate_scratch(src.size()), bit_hit_or_miss_scratch(src.size()));
        digest.add(pack_bits(src, 100, a), a);
        digest.add(pack_bits(src, b), b);
        digest.add(bitwise_xor(a, b, c), c);
        digest.add(bitwise_and_not(b, a, c), c);
        digest.add(bitwise_and(a, b, b), b);
        digest.add(invert(b, b), b);
        digest.add(bitwise_or(a, c, b), b);
        digest.add(count_bits(a), count_bits(b));
        for (const Size element : {Size{3, 3}, Size{1, 7}, Size{33, 5}, Size{4, 3}}) {
            digest.add(erode(a, element, scratch, c), c);
            digest.add(dilate(a, element, scratch, c), c);
            digest.add(erode_cross(a, element, scratch, c), c);
            digest.add(dilate_cross(a, element, scratch, c), c);
        }
        const auto hit = StructuringElement::from_text("...\n.##\n.#.");
        const auto miss = StructuringElement::from_text("##.\n#..\n...");
        digest.add(hit_or_miss(a, hit, miss, scratch, c), c);
        digest.add(unpack_bits(c, dst), dst);
    });
}

inline void morphology_thinning(Workspace& work, Digest& digest) {
    Random random(21);
    const ImageView<Gray8> src = work.view<Gray8>(0, {97, 60});
    const ImageView<Gray8> dst = work.view<Gray8>(1, {97, 60});
    fill_clumps(src, random);
    for (const ThinningRule rule : {ThinningRule::zhang_suen, ThinningRule::guo_hall})
        for (const int passes : {0, 1, 2, most_thinning_passes})
            digest.add(thin(src, rule, passes, work.scratch_span().first(thin_scratch(src.size())), dst),
                       dst);
}

}  // namespace fovea::golden
