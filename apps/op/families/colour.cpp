// SPDX-License-Identifier: MIT
#include <fovea/catalogue/colour.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const Operator> colour_operators() { return catalogue::colour; }

}  // namespace fovea::apps
