// SPDX-License-Identifier: MIT
#include <fovea/catalogue/warp.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const Operator> warp_operators() { return catalogue::warp; }

}  // namespace fovea::apps
