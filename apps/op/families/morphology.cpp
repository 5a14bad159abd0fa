// SPDX-License-Identifier: MIT
#include <fovea/catalogue/morphology.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const Operator> morphology_operators() { return catalogue::morphology; }

}  // namespace fovea::apps
