// SPDX-License-Identifier: MIT
//
// Bar fields: where an image is full of parallel edges, and how they lie.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A rectangle at any angle that parallel edges fill.
struct BarField {
    SubPixelPoint centre;
    FineAngle across;  ///< the direction across the bars, in which they are read: within a quarter turn
                       ///< of +x
    int length = 0;    ///< across the bars, in pixels
    int height = 0;    ///< along the bars, in pixels
    std::int64_t weight = 0;  ///< of its edges
};

/// Scratch bytes of find_bar_fields().
constexpr std::int64_t bar_fields_scratch(Size size);

/// Finds the fields of parallel edges that are 40 px long or longer, the weightiest first, as many as the
/// list holds.
///
/// The image is cut into blocks of 16x16 pixels. Where the structure tensor of a block has one clear
/// direction it joins the neighbours of about that direction.
///
/// Errors  empty_image, scratch_too_small; not_found
/// Source  Bigun and Granlund, "Optimal orientation detection of linear symmetry", ICCV 1987; the gradient of
///         Jaehne, Scharr and Koerkel, "Principles of filter design", Handbook of Computer Vision, 1999
inline Status find_bar_fields(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                              ListView<BarField> fields);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int field_block = 16;

/// No code has fewer than forty modules of a pixel; what is shorter is a single edge.
inline constexpr int shortest_field = 40;

/// The structure tensor of a block: its direction in the doubled angle.
struct FieldBlock {
    std::int32_t energy = 0;  ///< sum of squared gradients, 0 where there is no clear direction
    std::int16_t cosine = 0;  ///< of the doubled angle, in 1/256
    std::int16_t sine = 0;
    std::int16_t taken = 0;
};

/// Squared gradients a pixel below which a block is empty: differences of five levels over two pixels.
inline constexpr std::int32_t least_field_energy = 25 * 16;

inline FieldBlock field_block_of(ImageView<const Gray8> src, int left, int top) {
    const int right = minimum(left + field_block, src.width() - 1);
    const int bottom = minimum(top + field_block, src.height() - 1);
    std::int32_t xx = 0;
    std::int32_t yy = 0;
    std::int32_t xy = 0;
    std::int32_t count = 0;
    // Every second row is enough. Scharr's weights tell the direction of narrow bars to a fraction of a
    // degree, where plain differences err by three. 8 * 16 squares of 1020 are below 2^27.
    for (int y = maximum(top, 1); y < bottom; y += 2) {
        const Gray8* row = src.row(y);
        const Gray8* above = src.row(y - 1);
        const Gray8* below = src.row(y + 1);
        for (int x = maximum(left, 1); x < right; ++x) {
            const std::int32_t falling = below[x + 1] - above[x - 1];
            const std::int32_t rising = above[x + 1] - below[x - 1];
            const std::int32_t gx = (3 * (falling + rising) + 10 * (row[x + 1] - row[x - 1])) >> 2;
            const std::int32_t gy = (3 * (falling - rising) + 10 * (below[x] - above[x])) >> 2;
            xx += gx * gx;
            yy += gy * gy;
            xy += gx * gy;
        }
        count += right - maximum(left, 1);
    }
    FieldBlock block;
    const std::int32_t energy = xx + yy;
    if (count <= 0 || energy < least_field_energy * count) return block;
    const std::int64_t cosine = xx - yy;
    const std::int64_t sine = 2 * std::int64_t{xy};
    const std::int64_t norm = hypotenuse(cosine, sine);
    if (norm * 2 < energy) return block;
    block.energy = energy;
    block.cosine = static_cast<std::int16_t>(cosine * 256 / norm);
    block.sine = static_cast<std::int16_t>(sine * 256 / norm);
    return block;
}

/// The field of the blocks in the list, which lie on a grid of so many columns.
inline BarField field_of(Span<const FieldBlock> blocks, Span<const std::int32_t> members, int columns) {
    std::int64_t cosine = 0;
    std::int64_t sine = 0;
    BarField field;
    for (const std::int32_t member : members) {
        const FieldBlock& block = blocks[member];
        cosine += std::int64_t{block.energy} * block.cosine;
        sine += std::int64_t{block.energy} * block.sine;
        field.weight += block.energy;
    }
    // The half of a doubled angle of within a half turn is within a quarter turn.
    field.across = FineAngle::from_raw(static_cast<std::uint32_t>(angle_of(cosine, sine).signed_raw() >> 1));
    const UnitVector along = unit_vector(field.across);
    std::int64_t low_u = 0;
    std::int64_t high_u = 0;
    std::int64_t low_v = 0;
    std::int64_t high_v = 0;
    bool first = true;
    for (const std::int32_t member : members) {
        const std::int64_t x = member % columns * field_block + field_block / 2;
        const std::int64_t y = member / columns * field_block + field_block / 2;
        const std::int64_t u = (x * along.x.raw() + y * along.y.raw()) >> 22;
        const std::int64_t v = (y * along.x.raw() - x * along.y.raw()) >> 22;
        low_u = first ? u : minimum(low_u, u);
        high_u = first ? u : maximum(high_u, u);
        low_v = first ? v : minimum(low_v, v);
        high_v = first ? v : maximum(high_v, v);
        first = false;
    }
    const std::int64_t u = (low_u + high_u) / 2;
    const std::int64_t v = (low_v + high_v) / 2;
    field.centre.x =
        SubPixel::from_raw(static_cast<std::int32_t>((u * along.x.raw() - v * along.y.raw()) >> 30));
    field.centre.y =
        SubPixel::from_raw(static_cast<std::int32_t>((u * along.y.raw() + v * along.x.raw()) >> 30));
    field.length = static_cast<int>((high_u - low_u) >> 8) + field_block;
    field.height = static_cast<int>((high_v - low_v) >> 8) + field_block;
    return field;
}

/// Keeps the weightiest fields in falling order.
inline void insert_field(ListView<BarField> fields, const BarField& field) {
    int at = fields.size();
    if (fields.full()) {
        if (at == 0 || fields[at - 1].weight >= field.weight) return;
        --at;
    } else {
        static_cast<void>(fields.push(field));
    }
    for (; at > 0 && fields[at - 1].weight < field.weight; --at) fields[at] = fields[at - 1];
    fields[at] = field;
}

}  // namespace detail

constexpr std::int64_t bar_fields_scratch(Size size) {
    const std::int64_t blocks = (std::int64_t{size.width} / detail::field_block + 1) *
                                (std::int64_t{size.height} / detail::field_block + 1);
    return arena_bytes<detail::FieldBlock>(blocks) + arena_bytes<std::int32_t>(blocks);
}

inline Status find_bar_fields(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                              ListView<BarField> fields) {
    if (src.empty()) return Status::empty_image;
    if (scratch.size() < bar_fields_scratch(src.size())) return Status::scratch_too_small;
    const int columns = (src.width() + detail::field_block - 1) / detail::field_block;
    const int rows = (src.height() + detail::field_block - 1) / detail::field_block;
    Arena arena(scratch);
    const auto blocks = arena.take_unset<detail::FieldBlock>(std::int64_t{columns} * rows);
    const auto queue = arena.take_unset<std::int32_t>(std::int64_t{columns} * rows);
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            blocks[std::ptrdiff_t{y} * columns + x] =
                detail::field_block_of(src, x * detail::field_block, y * detail::field_block);
        }
    }
    fields.clear();
    for (int seed = 0; seed < columns * rows; ++seed) {
        if (blocks[seed].energy == 0 || blocks[seed].taken != 0) continue;
        int count = 0;
        queue[count++] = seed;
        blocks[seed].taken = 1;
        for (int next = 0; next < count; ++next) {
            const int x = queue[next] % columns;
            const int y = queue[next] / columns;
            const detail::FieldBlock& own = blocks[queue[next]];
            for (int ny = maximum(y - 1, 0); ny <= minimum(y + 1, rows - 1); ++ny) {
                for (int nx = maximum(x - 1, 0); nx <= minimum(x + 1, columns - 1); ++nx) {
                    detail::FieldBlock& near = blocks[std::ptrdiff_t{ny} * columns + nx];
                    if (near.energy == 0 || near.taken != 0) continue;
                    // Doubled angles within 30 degrees: 0.87 * 256^2.
                    if (own.cosine * near.cosine + own.sine * near.sine < 57000) continue;
                    near.taken = 1;
                    queue[count++] = ny * columns + nx;
                }
            }
        }
        const BarField field = detail::field_of(blocks, {queue.data(), count}, columns);
        if (field.length >= detail::shortest_field) detail::insert_field(fields, field);
    }
    return fields.empty() ? Status::not_found : Status::ok;
}

}  // namespace fovea
