// SPDX-License-Identifier: MIT
#include <fovea/catalogue/pixelwise.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const Operator> pixelwise_operators() { return catalogue::pixelwise; }

}  // namespace fovea::apps
