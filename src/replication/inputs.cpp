#include "replication/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>
#include <vector>

#include "errors/invalid_value.hpp"
#include "friction/response.hpp"
#include "portable_math/normal_quantile.hpp"
#include "problem/prior_file.hpp"
#include "replication/columns.hpp"

namespace replication {

namespace {

const std::vector<std::string> prior_rows = {"friction_force", "natural_frequency", "phase_noise",
                                             "frequency_ratio_noise"};

std::vector<double> ratios(const io::CsvTable& table, const char* column) {
  return checked(
      table, column, table.numbers(column), [](double r) { return r > 1e-4 && r < 1e6; },
      "a ratio between 1e-4 and 1e6");
}

/// A value that is refused, with its place in the file of the prior. What is no regular file cannot
/// be read a second time.
[[noreturn]] void fail_prior(const std::string& path, const errors::InvalidValue& invalid) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) {
    const auto table = io::CsvTable::read(path);
    const auto names = table.text("parameter");
    for (std::size_t row = 0; row < names.size(); ++row) {
      for (const char* side : {"lower", "upper"}) {
        if (table.has(side) && invalid.field() == names[row] + "." + side) {
          table.fail(row, side, invalid.expected());
        }
      }
    }
  }
  throw io::InputError(fmt::format("{}: {}", path, invalid.what()));
}

}  // namespace

friction::Observations read_observations(const std::string& path,
                                         const std::function<void(const std::string&)>& warn) {
  const auto table = io::CsvTable::read(path);
  table.require_columns({"r_nominal", "r_measured", "driving_frequency_hz", "phase_deg"});
  friction::Observations o;
  o.nominal_ratio = ratios(table, "r_nominal");
  o.measured_ratio = ratios(table, "r_measured");
  o.driving_frequency_hz = checked(
      table, "driving_frequency_hz", table.numbers("driving_frequency_hz"),
      [](double f) { return f > 1e-6 && f < 1e9; }, "a frequency between 1e-6 and 1e9 Hz");
  o.phase_deg = table.numbers("phase_deg");
  for (std::size_t row = 0; row < o.size(); ++row) {
    if (friction::is_singular_ratio(o.measured_ratio[row])) {
      table.fail(row, "r_measured", "a ratio other than 1, 1/3, 1/5, ..., where the response is unbounded");
    }
    if (!(o.phase_deg[row] >= -360.0 && o.phase_deg[row] <= 360.0)) {
      table.fail(row, "phase_deg", "an angle between -360 and 360 degrees");
    }
  }
  if (const auto doubt = friction::doubtful_unit_or_sign(o.phase_deg); !doubt.empty()) {
    warn(fmt::format("{}: column 'phase_deg': {}", io::printable(path, 200), doubt));
  }
  return o;
}

tmcmc::Prior read_prior(const std::string& path, const std::string& correlations) {
  return problem::read_prior({path, correlations}, {.names = prior_rows, .nonnegative = true});
}

tmcmc::Prior prior_for(const ProblemFiles& files, const Reading& reading) {
  if (!files.prior.empty()) {
    return read_prior(files.prior, files.prior_correlation);
  }
  const tmcmc::Prior printed = read_prior(files.table2, files.prior_correlation);
  if (!printed.is_box()) {
    return printed;
  }
  std::vector<tmcmc::Parameter> parameters;
  for (std::size_t p = 0; p < printed.names().size(); ++p) {
    parameters.push_back({printed.names()[p], printed.units()[p], printed.marginals()[p]});
  }
  if (reading.natural_frequency_lower_hz) {
    parameters[friction::natural_frequency].marginal = tmcmc::Marginal::uniform(
        *reading.natural_frequency_lower_hz, printed.upper()[friction::natural_frequency]);
  }
  return tmcmc::Prior(std::move(parameters));
}

estimation::ParameterBounds bounds_of(const tmcmc::Prior& prior, std::string_view what) {
  if (!prior.is_box()) {
    throw io::InputError(fmt::format("--prior: {} needs uniform priors, not {}", what, prior.text()));
  }
  estimation::ParameterBounds bounds;
  for (std::size_t p = 0; p < bounds.size(); ++p) {
    const auto j = static_cast<Eigen::Index>(p);
    bounds[p] = {prior.lower()[j], prior.upper()[j]};
  }
  return bounds;
}

estimation::ParameterPriors quadrature_priors(const tmcmc::Prior& prior) {
  if (!prior.is_independent()) {
    throw io::InputError(
        fmt::format("--prior: the exact posterior needs independent parameters, of which F_mu with its noise "
                    "level and omega_n with "
                    "its own can be integrated apart, not {}",
                    prior.text()));
  }
  constexpr std::array levels = {1e-20, 1e-16, 1e-12, 1e-8, 1e-5, 1e-3, 0.02, 0.1, 0.3, 0.5};
  estimation::ParameterPriors priors;
  for (std::size_t p = 0; p < priors.size(); ++p) {
    const tmcmc::Marginal& marginal = prior.marginals()[p];
    auto& breaks = priors[p].breaks;
    for (const double level : levels) {
      breaks.push_back(marginal.quantile(level));
      breaks.push_back(marginal.from_normal(-portable_math::normal_quantile(level)));
    }
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
    priors[p].log_density = [marginal](double x) { return marginal.log_density(x); };
  }
  return priors;
}

estimation::ExactPosterior exact_posterior_for(const ProblemFiles& files,
                                               const friction::Likelihood& likelihood,
                                               const tmcmc::Prior& prior) {
  try {
    if (!prior.is_box()) {
      return {likelihood, quadrature_priors(prior)};
    }
    return {likelihood, bounds_of(prior, "the exact posterior")};
  } catch (const errors::InvalidValue& error) {
    if (files.prior.empty()) {  // Table 2 is valid: the observations leave no feasible force inside it
      throw io::InputError(fmt::format("{}: {}", files.observations, error.what()));
    }
    fail_prior(files.prior, error);
  }
}

}  // namespace replication
