// SPDX-License-Identifier: MIT
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const OperatorFamily> all_operators() {
    // clang-format off
    static const OperatorFamily families[] = {
        {"pixelwise", pixelwise_operators()},
        {"arithmetic", arithmetic_operators()},
        {"colour", colour_operators()},
        {"statistics", statistics_operators()},
        {"filter", filter_operators()},
        {"morphology", morphology_operators()},
        {"warp", warp_operators()},
        {"segment", adaptive_operators()},
        {"feature", feature_operators()},
    };
    // clang-format on
    return families;
}

}  // namespace fovea::apps
