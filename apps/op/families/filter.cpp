// SPDX-License-Identifier: MIT
#include <fovea/catalogue/filter.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const Operator> filter_operators() { return catalogue::filter; }

}  // namespace fovea::apps
