#include "friction/observations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "errors/invalid_value.hpp"
#include "friction/angle.hpp"
#include "friction/response.hpp"

namespace friction {

namespace {

[[noreturn]] void reject(const char* field, std::size_t row, double value, const char* expected) {
  throw errors::InvalidValue(std::string(field) + "[" + std::to_string(row) + "]", value, expected);
}

}  // namespace

void Observations::validate() const {
  const std::size_t n = nominal_ratio.size();
  if (n == 0) {
    throw errors::InvalidValue("observations", "", "at least one row");
  }
  if (measured_ratio.size() != n || driving_frequency_hz.size() != n || phase_deg.size() != n) {
    throw errors::InvalidValue("observations", "", "columns of the same length");
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto positive = [i](const char* field, double value) {
      if (!(value > 0.0) || !std::isfinite(value)) {
        reject(field, i, value, "a positive finite number");
      }
    };
    positive("nominal_ratio", nominal_ratio[i]);
    positive("measured_ratio", measured_ratio[i]);
    positive("driving_frequency_hz", driving_frequency_hz[i]);
    if (!(std::fabs(phase_deg[i]) <= largest_phase_deg)) {
      reject("phase_deg", i, phase_deg[i], "an angle from -360 to 360 degrees");
    }
    if (is_singular_ratio(measured_ratio[i])) {
      reject("measured_ratio", i, measured_ratio[i],
             "a ratio other than 1, 1/3, 1/5, ..., where the response is unbounded");
    }
  }
}

std::string doubtful_unit_or_sign(const std::vector<double>& phase_deg) {
  constexpr std::size_t several = 3;
  const auto all = [&](auto holds) { return std::all_of(phase_deg.begin(), phase_deg.end(), holds); };
  if (phase_deg.size() < several || all([](double phase) { return phase == 0.0; })) {
    return "";
  }
  const bool radians = all([](double phase) { return std::fabs(phase) <= 2.0 * std::numbers::pi; });
  const bool leads = all([](double phase) { return phase < 0.0; });
  std::string doubt;
  if (radians) {
    doubt = "no phase exceeds 2 pi; they are taken as degrees, not as radians";
  }
  if (leads) {
    doubt += doubt.empty() ? "" : "; ";
    doubt += "every phase is negative; a positive phase is taken as the lag of the response";
  }
  return doubt;
}

}  // namespace friction
