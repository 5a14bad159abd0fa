// SPDX-License-Identifier: MIT
//
// The vector width and the name of the instruction set: chosen once, when the program is compiled.
#pragma once

/// FOVEA_BYTES is the width of a vector in bytes: 8, 16, 32 or 64, or 4 for plain 32-bit words, which is also
/// the scalar reference. 32 is the default even where 64 exist: point operators on unaligned rows get slower
/// with 64.
#if !defined(FOVEA_BYTES)
#if defined(__AVX2__)
#define FOVEA_BYTES 32
#elif defined(__SSE2__) || defined(__ARM_NEON) || defined(__ALTIVEC__) || \
    (defined(__s390x__) && defined(__VEC__))
#define FOVEA_BYTES 16
#elif defined(__ARM_FEATURE_MVE)
#define FOVEA_BYTES 16
#else
#define FOVEA_BYTES 4
#endif
#endif

#if FOVEA_BYTES != 4 && FOVEA_BYTES != 8 && FOVEA_BYTES != 16 && FOVEA_BYTES != 32 && FOVEA_BYTES != 64
#error "FOVEA_BYTES must be 4, 8, 16, 32 or 64"
#endif

// Everything that is compiled differently for different instruction sets lives in the inline namespace
// FOVEA_ISA, so that objects built for different ones can be linked: without it the linker might keep the
// copy that the older processor cannot run. These macros are the price; nothing outside simd/ and the kernels
// needs them.
#if defined(__AVX512BW__)
#define FOVEA_ISA_FAMILY avx512_
#elif defined(__AVX2__)
#define FOVEA_ISA_FAMILY avx2_
#elif defined(__SSE4_1__)
#define FOVEA_ISA_FAMILY sse4_
#elif defined(__ARM_NEON)
#define FOVEA_ISA_FAMILY neon_
#elif defined(__ARM_FEATURE_MVE)
#define FOVEA_ISA_FAMILY helium_
#elif defined(__ARM_FEATURE_SIMD32)
#define FOVEA_ISA_FAMILY dsp_
#else
#define FOVEA_ISA_FAMILY base_
#endif
#define FOVEA_ISA_JOIN_NOW(family, bytes) family##bytes
#define FOVEA_ISA_JOIN(family, bytes) FOVEA_ISA_JOIN_NOW(family, bytes)
#define FOVEA_ISA FOVEA_ISA_JOIN(FOVEA_ISA_FAMILY, FOVEA_BYTES)
