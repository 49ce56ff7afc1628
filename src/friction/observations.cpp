#include "friction/observations.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "friction/response.hpp"

namespace friction {

namespace {

[[noreturn]] void reject(const char* field, std::size_t row, double value, const char* expected) {
  throw std::invalid_argument(std::string(field) + "[" + std::to_string(row) +
                              "] = " + std::to_string(value) + ": expected " + expected);
}

}  // namespace

void Observations::validate() const {
  const std::size_t n = nominal_ratio.size();
  if (n == 0) {
    throw std::invalid_argument("observations are empty: expected at least one row");
  }
  if (measured_ratio.size() != n || driving_frequency_hz.size() != n || phase_deg.size() != n) {
    throw std::invalid_argument("the columns of the observations differ in length");
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
    if (!std::isfinite(phase_deg[i])) {
      reject("phase_deg", i, phase_deg[i], "a finite number");
    }
    if (is_singular_ratio(measured_ratio[i])) {
      reject("measured_ratio", i, measured_ratio[i],
             "a ratio other than 1, 1/3, 1/5, ..., where the response is unbounded");
    }
  }
}

}  // namespace friction
