// SPDX-License-Identifier: MIT
//
// Golden vectors of the catalogue: every operator from images to an image, by its entry alone.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/catalogue/operator.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

/// Random bytes, the same on every machine, pixel by pixel.
inline AnyImage operator_input(Workspace& work, int number, Size size, PixelKind kind, bool part,
                               Random& random) {
    const std::ptrdiff_t row_bytes = std::ptrdiff_t{size.width} * bytes_of(kind);
    auto* first = work.image[number];
    FOVEA_ASSERT(row_bytes * size.height <= Workspace::image_bytes);
    for (int y = 0; y < size.height; ++y)
        for (std::ptrdiff_t i = 0; i < row_bytes; ++i) {
            // A smooth shape with a little noise, or noise alone.
            const auto smooth = static_cast<std::uint8_t>((y * 5 / 3 + i * 2) & 127);
            first[y * row_bytes + i] =
                part ? static_cast<std::uint8_t>(smooth + (random_byte(random) & 15)) : random_byte(random);
        }
    if (part && kind == PixelKind::gray8 && size == Workspace::picture_size)
        put_part(work, ImageView<Gray8>(first, size, row_bytes));
    return {first, size, row_bytes};
}

/// The bytes of an image in an order that does not depend on the machine's.
inline void put_image(Digest& digest, const AnyImage& image, PixelKind kind) {
    digest.add(image.size);
    const int bytes = bytes_of(kind);
    const bool wide = kind == PixelKind::gray16 || kind == PixelKind::gradient16 ||
                      kind == PixelKind::rgb565 || kind == PixelKind::sum32 || kind == PixelKind::response32;
    constexpr bool big = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    for (int y = 0; y < image.size.height; ++y) {
        const auto* row = static_cast<const std::uint8_t*>(image.first) + y * image.stride_bytes;
        for (int x = 0; x < image.size.width; ++x)
            for (int i = 0; i < bytes; ++i)
                digest.add_byte(row[x * bytes + (wide && big ? bytes - 1 - i : i)]);
    }
}

/// Wide inputs hold numbers of a machine: written as such.
inline void to_machine_order(const AnyImage& image, PixelKind kind) {
    const bool wide = kind == PixelKind::gray16 || kind == PixelKind::gradient16 ||
                      kind == PixelKind::rgb565 || kind == PixelKind::sum32 || kind == PixelKind::response32;
    if (__BYTE_ORDER__ != __ORDER_BIG_ENDIAN__ || !wide) return;
    auto* bytes = static_cast<std::uint8_t*>(image.first);
    const int count = bytes_of(kind);
    for (std::int64_t i = 0; i < image.size.area(); ++i)
        for (int low = 0; low < count / 2; ++low) {
            std::uint8_t* pixel = bytes + count * i;
            const std::uint8_t kept = pixel[low];
            pixel[low] = pixel[count - 1 - low];
            pixel[count - 1 - low] = kept;
        }
}

/// One run of an operator, if the workspace has room for it.
inline void run_vector(const Operator& op, Workspace& work, Size size, bool part, const int* values,
                       Digest& digest) {
    OperatorCall call;
    Random random(2026);
    for (int i = 0; i < op.parameter_count(); ++i) call.values[i] = values[i];
    for (int i = 0; i < op.input_count(); ++i) {
        if (size.area() * bytes_of(op.inputs[i]) > Workspace::image_bytes) return;
        call.inputs[i] = operator_input(work, i, size, op.inputs[i], part, random);
        to_machine_order(call.inputs[i], op.inputs[i]);
    }
    const Size out = op.size_for(size, call.values);
    const std::int64_t out_bytes = out.empty() ? 0 : out.area() * bytes_of(op.output);
    const std::int64_t scratch = op.scratch_for(size, call.values);
    if (out_bytes > Workspace::image_bytes || scratch > static_cast<std::int64_t>(sizeof work.scratch))
        return;
    for (std::int64_t i = 0; i < out_bytes; ++i) work.image[2][i] = 0;
    call.output = {work.image[2], out, std::ptrdiff_t{out.width} * bytes_of(op.output)};
    call.scratch = work.scratch_span().first(static_cast<std::ptrdiff_t>(scratch));
    const Status status = run_operator(op, call);
    digest.add(status);
    if (status == Status::ok) put_image(digest, call.output, op.output);
}

/// Every size with the presets and two draws of the parameters, and the picture of a part.
inline void operator_vector(const Operator& op, Workspace& work, Digest& digest) {
    int presets[max_operator_parameters] = {};
    for (int i = 0; i < op.parameter_count(); ++i) presets[i] = op.parameters[i].preset;
    // Operators that differ in their pixels alone have the same numbers.
    digest.add(op.inputs[0], op.output);
    Random random(17);
    for (int round = 0; round < 3; ++round) {
        int values[max_operator_parameters] = {};
        for (int i = 0; i < op.parameter_count(); ++i) {
            const OperatorParameter& parameter = op.parameters[i];
            const int steps = (parameter.most - parameter.least) / parameter.step;
            values[i] = round == 0 ? presets[i] : parameter.least + random.between(0, steps) * parameter.step;
        }
        for (const Size size : sizes) run_vector(op, work, size, size.width > 60, values, digest);
        run_vector(op, work, {53, 39}, true, values, digest);
        run_vector(op, work, Workspace::picture_size, true, values, digest);
    }
}

}  // namespace fovea::golden
