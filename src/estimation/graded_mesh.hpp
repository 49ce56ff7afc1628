/// \file
/// Breakpoints for the integration of densities with narrow modes at known places.
#pragma once

#include <functional>
#include <vector>

namespace estimation {

/// Breakpoints between lower and upper whose spacing is graded in powers of two around every mode.
/// \param modes  ascending, inside [lower, upper], at least one
/// \param separators  ascending, one between each mode and the next
/// \param drop  drop(mode, x) >= 0: the largest fall of the log-density from mode to x. The panels
///        next to a mode are halved until the log-density falls by at most 1 over them.
[[nodiscard]] std::vector<double> graded_mesh(double lower, double upper, const std::vector<double>& modes,
                                              const std::vector<double>& separators,
                                              const std::function<double(double, double)>& drop);

}  // namespace estimation
