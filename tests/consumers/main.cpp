// SPDX-License-Identifier: MIT
//
// A user's first program: one header of every library, and a call that must work.
#include <fovea/hal/storage.hpp>
#include <fovea/linux/file_storage.hpp>
#include <fovea/number/integer.hpp>

int main() { return fovea::round_divide(7, 2) == 4 ? 0 : 1; }
