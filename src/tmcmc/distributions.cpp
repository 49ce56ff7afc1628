#include "tmcmc/distributions.hpp"

#include <algorithm>

#include "errors/invalid_value.hpp"

namespace tmcmc {

namespace {

using Arguments = std::span<const double>;

const std::vector<Distribution>& table() {
  static const std::vector<Distribution> rows = {
      {"uniform", {"lower", "upper"}, [](Arguments a) { return Marginal::uniform(a[0], a[1]); }},
      {"log_uniform", {"lower", "upper"}, [](Arguments a) { return Marginal::log_uniform(a[0], a[1]); }},
      {"normal", {"mean", "sd"}, [](Arguments a) { return Marginal::normal(a[0], a[1]); }},
      {"truncated_normal",
       {"mean", "sd", "lower", "upper"},
       [](Arguments a) { return Marginal::truncated_normal(a[0], a[1], a[2], a[3]); }},
      {"half_normal", {"sd"}, [](Arguments a) { return Marginal::half_normal(a[0]); }},
      {"log_normal", {"mu", "sigma"}, [](Arguments a) { return Marginal::log_normal(a[0], a[1]); }},
      {"log_normal", {"mean", "sd"}, [](Arguments a) { return Marginal::log_normal_of_mean(a[0], a[1]); }},
      {"log_normal",
       {"median", "cov"},
       [](Arguments a) { return Marginal::log_normal_of_median(a[0], a[1]); }},
      {"exponential", {"rate"}, [](Arguments a) { return Marginal::exponential(a[0]); }},
      {"gamma", {"shape", "rate"}, [](Arguments a) { return Marginal::gamma(a[0], a[1]); }},
      {"inverse_gamma", {"shape", "scale"}, [](Arguments a) { return Marginal::inverse_gamma(a[0], a[1]); }},
      {"beta", {"alpha", "beta"}, [](Arguments a) { return Marginal::beta(a[0], a[1]); }},
      {"beta",
       {"alpha", "beta", "lower", "upper"},
       [](Arguments a) { return Marginal::beta(a[0], a[1], a[2], a[3]); }},
      {"weibull", {"shape", "scale"}, [](Arguments a) { return Marginal::weibull(a[0], a[1]); }},
      {"gumbel", {"location", "scale"}, [](Arguments a) { return Marginal::gumbel(a[0], a[1]); }},
      {"student_t",
       {"degrees_of_freedom", "location", "scale"},
       [](Arguments a) { return Marginal::student_t(a[0], a[1], a[2]); }},
      {"triangular", {"lower", "mode", "upper"}, [](Arguments a) {
         return Marginal::triangular(a[0], a[1], a[2]);
       }}};
  return rows;
}

}  // namespace

std::span<const Distribution> distributions() {
  return table();
}

std::string distribution_names() {
  std::vector<std::string_view> names;
  for (const Distribution& row : table()) {
    if (names.empty() || names.back() != row.name) {
      names.push_back(row.name);
    }
  }
  std::string text(names.front());
  for (std::size_t i = 1; i < names.size(); ++i) {
    text.append(i + 1 == names.size() ? " or " : ", ").append(names[i]);
  }
  return text;
}

std::string argument_names(std::string_view distribution) {
  std::string text;
  for (const Distribution& row : table()) {
    if (row.name == distribution) {
      text += text.empty() ? "" : "; or ";
      for (std::size_t i = 0; i < row.arguments.size(); ++i) {
        text.append(i == 0 ? "" : ", ").append(row.arguments[i]);
      }
    }
  }
  return text;
}

Marginal make_marginal(std::string_view distribution,
                       const std::map<std::string, double, std::less<>>& arguments) {
  const std::string forms = argument_names(distribution);
  if (forms.empty()) {
    throw errors::InvalidValue("distribution", std::string(distribution), distribution_names());
  }
  for (const Distribution& row : table()) {
    const bool fits = row.name == distribution && row.arguments.size() == arguments.size() &&
                      std::all_of(row.arguments.begin(), row.arguments.end(),
                                  [&](std::string_view name) { return arguments.contains(name); });
    if (fits) {
      std::vector<double> values;
      for (const std::string_view name : row.arguments) {
        values.push_back(arguments.find(name)->second);
      }
      return row.make(values);
    }
  }
  std::string given;
  for (const auto& [name, value] : arguments) {
    given.append(given.empty() ? "" : ", ").append(name);
  }
  throw errors::InvalidValue(
      "distribution", std::string(distribution),
      "the arguments " + forms + (given.empty() ? ", and there are none" : ", not " + given));
}

}  // namespace tmcmc
