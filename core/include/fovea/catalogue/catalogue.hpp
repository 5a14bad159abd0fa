// SPDX-License-Identifier: MIT
//
// The catalogue: every operator from images to an image, family by family.
#pragma once

#include <fovea/base/span.hpp>
#include <fovea/catalogue/feature.hpp>
#include <fovea/catalogue/filter.hpp>
#include <fovea/catalogue/morphology.hpp>
#include <fovea/catalogue/operator.hpp>
#include <fovea/catalogue/pixelwise.hpp>

namespace fovea {

/// A folder of the core and its operators.
struct OperatorFamily {
    const char* name;
    Span<const Operator> operators;
};

inline namespace FOVEA_ISA {

/// All families, in the order of core/layers.txt.
inline constexpr OperatorFamily operator_families[] = {
    {"pixelwise", catalogue::pixelwise},
    {"filter", catalogue::filter},
    {"morphology", catalogue::morphology},
    {"feature", catalogue::feature},
};

/// The operator of a name; null if there is none.
constexpr const Operator* find_operator(const char* name) {
    for (const OperatorFamily& family : operator_families)
        for (const Operator& op : family.operators) {
            const char* a = op.name;
            const char* b = name;
            while (*a != '\0' && *a == *b) {
                ++a;
                ++b;
            }
            if (*a == *b) return &op;
        }
    return nullptr;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
