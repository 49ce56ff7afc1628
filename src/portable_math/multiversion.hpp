/// \file
/// PORTABLE_MATH_MULTIVERSION before a function compiles it for the baseline, for AVX2 and for
/// AVX-512 (x86-64-v4); the program selects the best version that the processor supports. Without
/// contraction all versions compute the same bits.
///
/// Checks and measurements can leave versions out: PORTABLE_MATH_NO_AVX512 leaves out the last one,
/// PORTABLE_MATH_NO_MULTIVERSION all but the version for the compiler's flags.
#pragma once

#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_THREAD__) &&                     \
    !defined(__SANITIZE_ADDRESS__) && !defined(PORTABLE_MATH_NO_MULTIVERSION) && defined(__GNUC__) && \
    !defined(__clang__)
#if defined(PORTABLE_MATH_NO_AVX512)
#define PORTABLE_MATH_MULTIVERSION [[gnu::target_clones("default", "avx2")]]
#else
#define PORTABLE_MATH_MULTIVERSION [[gnu::target_clones("default", "avx2", "arch=x86-64-v4")]]
#endif
#else
#define PORTABLE_MATH_MULTIVERSION
#endif
