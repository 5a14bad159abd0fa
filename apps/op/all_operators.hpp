// SPDX-License-Identifier: MIT
//
// The catalogue as the applications see it. It holds every operator of the core, so each family is compiled
// once, in a source file of its own, and several at a time.
#pragma once

#include <fovea/base/span.hpp>
#include <fovea/catalogue/operator.hpp>

namespace fovea::apps {

/// Every family with its operators, as in catalogue/catalogue.hpp.
Span<const OperatorFamily> all_operators();

Span<const Operator> pixelwise_operators();
Span<const Operator> arithmetic_operators();
Span<const Operator> colour_operators();
Span<const Operator> statistics_operators();
Span<const Operator> filter_operators();
Span<const Operator> morphology_operators();
Span<const Operator> warp_operators();
Span<const Operator> adaptive_operators();
Span<const Operator> feature_operators();

}  // namespace fovea::apps
