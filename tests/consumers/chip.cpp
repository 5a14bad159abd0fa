// SPDX-License-Identifier: MIT
//
// A first program on a chip: a header of the core, one of hal, and a call that must work.
#include <fovea/hal/byte_stream.hpp>
#include <fovea/number/integer.hpp>

static_assert(!fovea::hal::is_byte_stream_v<int>);

int main() { return fovea::round_divide(7, 2) == 4 ? 0 : 1; }
