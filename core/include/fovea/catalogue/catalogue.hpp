// SPDX-License-Identifier: MIT
//
// The catalogue: every operator from images to an image, family by family.
#pragma once

#include <fovea/base/span.hpp>
#include <fovea/catalogue/adaptive.hpp>
#include <fovea/catalogue/arithmetic.hpp>
#include <fovea/catalogue/colour.hpp>
#include <fovea/catalogue/feature.hpp>
#include <fovea/catalogue/filter.hpp>
#include <fovea/catalogue/morphology.hpp>
#include <fovea/catalogue/operator.hpp>
#include <fovea/catalogue/pixelwise.hpp>
#include <fovea/catalogue/statistics.hpp>
#include <fovea/catalogue/warp.hpp>

namespace fovea {

inline namespace FOVEA_ISA {

/// All families, in the order of core/layers.txt.
// clang-format off
inline constexpr OperatorFamily operator_families[] = {
    {"pixelwise", catalogue::pixelwise},
    {"arithmetic", catalogue::arithmetic},
    {"colour", catalogue::colour},
    {"statistics", catalogue::statistics},
    {"filter", catalogue::filter},
    {"morphology", catalogue::morphology},
    {"warp", catalogue::warp},
    {"segment", catalogue::adaptive},
    {"feature", catalogue::feature},
};
// clang-format on

/// The operator of a name; null if there is none.
constexpr const Operator* find_operator(const char* name) { return find_operator(operator_families, name); }

}  // namespace FOVEA_ISA
}  // namespace fovea
