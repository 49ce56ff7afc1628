#include "replication/verdict.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "errors/invalid_value.hpp"

namespace replication {

namespace {

double monte_carlo_error_95(const PValue& p) {
  return 1.96 * p.standard_error;
}

}  // namespace

double rounding_half_width(const std::string& printed) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(printed.data(), printed.data() + printed.size(), value);
  if (error != std::errc() || end != printed.data() + printed.size() || !std::isfinite(value)) {
    throw errors::InvalidValue("printed value", printed, "a decimal number");
  }
  const auto exponent_at = printed.find_first_of("eE");
  const std::string mantissa = printed.substr(0, exponent_at);
  const auto point = mantissa.find('.');
  int exponent = point == std::string::npos ? 0 : -static_cast<int>(mantissa.size() - point - 1);
  if (exponent_at != std::string::npos) {
    exponent += std::stoi(printed.substr(exponent_at + 1));
  }
  const std::string unit = "5e" + std::to_string(exponent - 1);
  double half = 0.0;
  std::from_chars(unit.data(), unit.data() + unit.size(), half);
  return half;
}

const std::string& name_of(Verdict verdict) {
  static const std::vector<std::string> names = {"holds",
                                                 "true, and uninformative",
                                                 "holds in part",
                                                 "not supported",
                                                 "does not follow",
                                                 "contradicted",
                                                 "not rejected",
                                                 "off by one?",
                                                 "internally contradictory",
                                                 "cannot be tested"};
  return names[static_cast<std::size_t>(verdict)];
}

const std::string& name_of(Compatibility compatibility) {
  static const std::vector<std::string> names = {"compatible", "not compatible", "undecided"};
  return names[static_cast<std::size_t>(compatibility)];
}

Compatibility judge_number(const PValue& p) {
  const double error = monte_carlo_error_95(p);
  if (p.value - error >= strict_significance) {
    return Compatibility::compatible;
  }
  return p.value + error < strict_significance ? Compatibility::not_compatible : Compatibility::undecided;
}

const std::string& name_of(Chance chance) {
  static const std::vector<std::string> names = {"ordinary by chance", "unlikely by chance",
                                                 "very unlikely by chance", "undecided"};
  return names[static_cast<std::size_t>(chance)];
}

Chance judge_chance(const PValue& p) {
  const double error = monte_carlo_error_95(p);
  if (p.value - error >= significance_level) {
    return Chance::ordinary;
  }
  if (p.value + error < strict_significance) {
    return Chance::very_unlikely;
  }
  return p.value + error < significance_level ? Chance::unlikely : Chance::undecided;
}

Verdict judge_contrast(const Equivalence& replicated) {
  if (replicated.equivalent) {
    return Verdict::contradicted;
  }
  if (replicated.different) {
    return replicated.ratio > 1.0 ? Verdict::holds : Verdict::contradicted;
  }
  return Verdict::not_supported;
}

}  // namespace replication
