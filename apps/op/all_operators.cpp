// SPDX-License-Identifier: MIT
#include <op/all_operators.hpp>

#include <fovea/catalogue/catalogue.hpp>

namespace fovea::apps {

Span<const OperatorFamily> all_operators() { return operator_families; }

}  // namespace fovea::apps
