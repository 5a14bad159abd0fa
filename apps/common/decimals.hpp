// SPDX-License-Identifier: MIT
//
// Places and angles as decimals, in pixels and degrees.
#pragma once

#include <cstdint>

#include <fovea/number/angle.hpp>
#include <fovea/number/decimal.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::apps {

inline Decimal decimal_of(FinePixel value) {
    return {round_shift(std::int64_t{value.raw()} * 1000000, FinePixel::fraction_bits)};
}
inline Decimal decimal_of(SubPixel value) {
    return {round_shift(std::int64_t{value.raw()} * 1000000, SubPixel::fraction_bits)};
}
inline Decimal decimal_of(FineAngle angle) { return {angle.microdegrees()}; }

}  // namespace fovea::apps
