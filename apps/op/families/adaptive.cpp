// SPDX-License-Identifier: MIT
#include <fovea/catalogue/adaptive.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const Operator> adaptive_operators() { return catalogue::adaptive; }

}  // namespace fovea::apps
