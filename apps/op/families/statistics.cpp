// SPDX-License-Identifier: MIT
#include <fovea/catalogue/statistics.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const Operator> statistics_operators() { return catalogue::statistics; }

}  // namespace fovea::apps
