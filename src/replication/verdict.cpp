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
  static const std::vector<std::string> names = {
      "reproduced",   "consistent with chance",   "not supported",
      "contradicted", "internally contradictory", "cannot be tested",
      "undecided"};
  return names[static_cast<std::size_t>(verdict)];
}

const std::string& name_of(Typicality typicality) {
  static const std::vector<std::string> names = {"reproduced", "untypical", "not reproduced", "undecided"};
  return names[static_cast<std::size_t>(typicality)];
}

Typicality judge_number(const PValue& p) {
  const double error = monte_carlo_error_95(p);
  if (p.value - error >= significance_level) {
    return Typicality::reproduced;
  }
  if (p.value + error < strict_significance) {
    return Typicality::not_reproduced;
  }
  return p.value + error < significance_level ? Typicality::untypical : Typicality::undecided;
}

Verdict judge_contrast(const PValue& printed, const Equivalence& replicated) {
  if (replicated.equivalent) {
    if (std::fabs(printed.value - significance_level) <= monte_carlo_error_95(printed)) {
      return Verdict::undecided;
    }
    return printed.value >= significance_level ? Verdict::consistent_with_chance : Verdict::not_supported;
  }
  if (replicated.different) {
    return replicated.ratio > 1.0 ? Verdict::reproduced : Verdict::contradicted;
  }
  return Verdict::not_supported;
}

}  // namespace replication
