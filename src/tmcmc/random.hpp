/// \file
/// Random numbers as a function of where they are used (Salmon et al. 2011, Philox 4x64-10): no
/// generator state is carried along, so neither threads nor the order of work can change a draw.
#pragma once

#include <array>
#include <cstdint>

#include "portable_math/elementary.hpp"

namespace tmcmc {

/// Identifies one run. Runs that differ in any field have independent streams.
struct StreamKey {
  /// Seed of all streams.
  std::uint64_t seed = 0;
  /// Number of the study among its replications.
  std::uint32_t study = 0;
  /// Index of the sampler among those that a study compares; below 2^24.
  std::uint32_t arm = 0;
  /// Number of the run within the study.
  std::uint32_t run = 0;
};

/// Purpose of a draw; separates the draws of one stage. `statistics`: draws for the analysis of
/// completed runs; `reference`: draws from a density that was fitted to a population.
enum class Purpose : std::uint32_t { prior, resampling, move, data, statistics, reference };

/// Place of a block of four random words within a run.
struct DrawId {
  /// What the draw is for.
  Purpose purpose = Purpose::prior;
  /// Stage of the sampler, 0 for the prior.
  std::uint32_t stage = 0;
  /// Row of the population.
  std::uint64_t row = 0;
  /// Step of a move.
  std::uint32_t draw = 0;
  /// Repetition of a draw that was discarded.
  std::uint32_t attempt = 0;
  /// Block, if one draw needs more than four words.
  std::uint32_t block = 0;
};

/// Output of one call of the generator.
using Words = std::array<std::uint64_t, 4>;

/// Four independent uniform 64-bit words. The counter is (stage | arm, purpose), row, (draw,
/// attempt), block; the key is seed and (study, run).
[[nodiscard]] Words random_words(const StreamKey& key, const DrawId& id);

/// Uniform on the open interval (0, 1): (k + 1/2) 2^-52 with k the upper 52 bits.
PORTABLE_MATH_INLINE double uniform_open(std::uint64_t word) {
  return std::bit_cast<double>((word >> 12U) | 0x3ff0000000000000U) - 0.99999999999999988898;
}

/// Uniform in [0, 1) from 32 bits.
PORTABLE_MATH_INLINE double uniform_32(std::uint64_t bits) {
  return (std::bit_cast<double>((bits & 0xffffffffU) | 0x4330000000000000U) - 4503599627370496.0) * 0x1p-32;
}

/// Two independent standard normal numbers.
struct NormalPair {
  /// Radius times cosine.
  double first;
  /// Radius times sine.
  double second;
};

/// Two independent standard normals (Box and Muller 1958): radius from 52 bits of a word, angle
/// from 32 bits.
PORTABLE_MATH_INLINE NormalPair normal_pair(std::uint64_t radius_word, std::uint64_t angle_bits) {
  const double radius = std::sqrt(-2.0 * portable_math::log_positive(uniform_open(radius_word)));
  const auto angle = portable_math::sin_cos_turns(uniform_32(angle_bits));
  return {radius * angle.cos, radius * angle.sin};
}

}  // namespace tmcmc
