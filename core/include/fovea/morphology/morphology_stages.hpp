// SPDX-License-Identifier: MIT
//
// Erosion, dilation, opening and closing as stages of a stream.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace stages {

/// The extreme under an element, odd by odd, 1x1 to 63x63. Its columns repeat the outermost pixels whatever
/// the stream's border is; its rows do as the border says.
template <class Extreme>
struct ExtremeStage {
    using Kernel = kernels::ExtremeRow<Extreme>;
    using Input = Gray8;
    using Output = Gray8;
    Size element;

    constexpr bool valid() const { return kernels::is_rectangle(element); }
    constexpr int rows() const { return element.height; }
    static constexpr std::int64_t scratch(int width) { return byte_line_scratch(width); }
    static constexpr Border border(Border) { return Border::replicate; }
    Kernel kernel(Border, Span<std::uint8_t> bytes, int width) const { return Kernel(element, bytes, width); }
};
using erode = ExtremeStage<kernels::Lowest>;
using dilate = ExtremeStage<kernels::Highest>;

}  // namespace stages
}  // namespace FOVEA_ISA
}  // namespace fovea
