/// \file
/// Observations with known truth (Eqs. 22-23).
#pragma once

#include <vector>

#include "friction/observations.hpp"
#include "friction/response.hpp"
#include "tmcmc/random.hpp"

namespace replication {

/// Truth of synthetic data; the defaults are the values stated in the paper.
struct Truth {
  /// F_mu, N.
  double friction_force_n = 1.086;
  /// omega_n, Hz.
  double natural_frequency_hz = 3.086;
  /// sigma_phase, deg (Eq. 23).
  double phase_noise_deg = 2.0;
  /// sigma_r, dimensionless (Eq. 22).
  double frequency_ratio_noise = 0.01;
};

/// The nominal frequency ratios of Table 1: k/14 for odd k = 9 ... 27, to three decimals.
[[nodiscard]] std::vector<double> nominal_ratios();

/// Synthetic observations r = r_nom + e_r, omega_b = r omega_n, phase = M_phase(r, F_mu) + e with
/// Normal errors. Row i uses draw i of the seed. A phase beyond one turn is reduced to the same
/// angle from -180 to 180 deg.
/// \throws errors::InvalidValue for a truth out of range, or where a drawn ratio has no continuous
///         motion.
[[nodiscard]] friction::Observations generate_observations(const Truth& truth,
                                                           const std::vector<double>& nominal_ratio,
                                                           const friction::Physics& physics,
                                                           std::uint64_t seed);

}  // namespace replication
