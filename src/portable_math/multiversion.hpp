/// \file
/// PORTABLE_MATH_MULTIVERSION before a function compiles it for the baseline and for AVX2; the program takes
/// the one that the processor has. Without contraction both compute the same bits.
#pragma once

#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_THREAD__) &&                     \
    !defined(__SANITIZE_ADDRESS__) && !defined(PORTABLE_MATH_NO_MULTIVERSION) && defined(__GNUC__) && \
    !defined(__clang__)
#define PORTABLE_MATH_MULTIVERSION [[gnu::target_clones("default", "avx2")]]
#else
#define PORTABLE_MATH_MULTIVERSION
#endif
