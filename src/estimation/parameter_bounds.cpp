#include "estimation/parameter_bounds.hpp"

#include <cmath>
#include <string>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"

namespace estimation {

namespace {

void require(bool condition, int parameter, const char* side, double value, const char* expected) {
  if (!condition) {
    throw errors::InvalidValue(std::string(name_of(static_cast<friction::Parameter>(parameter))) + '.' + side,
                               value, expected);
  }
}

}  // namespace

const char* name_of(friction::Parameter parameter) {
  constexpr std::array<const char*, friction::parameter_count> names = {
      "friction_force", "natural_frequency", "phase_noise", "frequency_ratio_noise"};
  return names.at(static_cast<std::size_t>(parameter));
}

void validate(const ParameterBounds& bounds) {
  for (int p = 0; p < friction::parameter_count; ++p) {
    const Interval& interval = bounds[static_cast<std::size_t>(p)];
    require(std::isfinite(interval.lower), p, "lower", interval.lower, "a finite number");
    require(std::isfinite(interval.upper), p, "upper", interval.upper, "a finite number");
    if (p == friction::friction_force) {
      require(interval.lower >= 0.0, p, "lower", interval.lower, "a number not below 0");
    } else {
      require(interval.lower > 0.0, p, "lower", interval.lower, "a positive number");
    }
    require(interval.lower < interval.upper, p, "upper", interval.upper, "more than the lower bound");
  }
}

double log_volume(const ParameterBounds& bounds) {
  double sum = 0.0;
  for (const Interval& interval : bounds) {
    sum += portable_math::log(interval.width());
  }
  return sum;
}

}  // namespace estimation
