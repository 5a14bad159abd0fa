// SPDX-License-Identifier: MIT
#include <fovea/catalogue/arithmetic.hpp>
#include <op/all_operators.hpp>

namespace fovea::apps {

Span<const Operator> arithmetic_operators() { return catalogue::arithmetic; }

}  // namespace fovea::apps
