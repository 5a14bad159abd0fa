// SPDX-License-Identifier: MIT
//
// FOVEA_ASSERT: stops at our own mistakes. Never used for input; input gets a Status.
#pragma once

#if defined(NDEBUG)
#define FOVEA_ASSERT(condition) static_cast<void>(0)
#else
#define FOVEA_ASSERT(condition) ((condition) ? static_cast<void>(0) : __builtin_trap())
#endif
