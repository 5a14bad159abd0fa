// SPDX-License-Identifier: MIT
//
// What operators cost on a chip, for count_instructions.cpp to count.
#pragma once

namespace fovea::target {

/// Is told the name of each, and whether it was done.
using TellCost = void (*)(const char* name, bool done);

/// Runs each operator once between two marks.
void for_each_cost(TellCost tell);

}  // namespace fovea::target
