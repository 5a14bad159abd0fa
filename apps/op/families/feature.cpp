// SPDX-License-Identifier: MIT
#include <fovea/catalogue/feature.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const Operator> feature_operators() { return catalogue::feature; }

}  // namespace fovea::apps
