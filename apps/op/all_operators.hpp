// SPDX-License-Identifier: MIT
//
// The catalogue as the applications see it. It holds every operator of the core, so it is compiled once, in
// all_operators.cpp.
#pragma once

#include <fovea/base/span.hpp>
#include <fovea/catalogue/operator.hpp>

namespace fovea::apps {

/// Every family with its operators.
Span<const OperatorFamily> all_operators();

}  // namespace fovea::apps
