// What the Python module takes from the libraries; python/tmcmc gives it names, checks and
// documentation.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "errors/invalid_value.hpp"
#include "friction/likelihood.hpp"
#include "friction/response.hpp"
#include "pbox/pbox.hpp"
#include "tmcmc/diagnostics.hpp"
#include "tmcmc/distributions.hpp"
#include "tmcmc/modes.hpp"
#include "tmcmc/option_table.hpp"
#include "tmcmc/sampler.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Raises what a signal's handler raises, such as KeyboardInterrupt.
void look_for_signals() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) {
    throw py::error_already_set();
  }
}

/// A Python function of an (n, d) array as a batch log-likelihood. It is called with the
/// interpreter's lock, between calls signals are looked for, and what it raises passes through the
/// sampler.
tmcmc::LogLikelihood batch_of(const py::function& function) {
  return [&function](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
    const py::gil_scoped_acquire lock;
    look_for_signals();
    const auto result = function(Eigen::MatrixXd(points)).cast<Doubles>();
    if (result.ndim() != 1 || result.shape(0) != points.rows()) {
      throw py::value_error("a log-likelihood for each row");
    }
    std::memcpy(values.data(), result.data(), sizeof(double) * static_cast<std::size_t>(values.size()));
  };
}

py::dict stages_of(const tmcmc::Result& result) {
  py::dict stages;
  const auto add = [&](const char* name, auto member) {
    using Value = std::remove_cvref_t<decltype(result.stages.front().*member)>;
    py::array_t<Value> column(static_cast<py::ssize_t>(result.stages.size()));
    Value* next = column.mutable_data();
    for (const auto& stage : result.stages) {
      *next++ = stage.*member;
    }
    stages[name] = column;
  };
  add("beta", &tmcmc::StageRecord::beta);
  add("effective_sample_size", &tmcmc::StageRecord::effective_sample_size);
  add("log_evidence_increment", &tmcmc::StageRecord::log_evidence_increment);
  add("acceptance_rate", &tmcmc::StageRecord::acceptance_rate);
  add("proposal_scale", &tmcmc::StageRecord::proposal_scale);
  add("evaluations", &tmcmc::StageRecord::evaluations);
  return stages;
}

using Marginals =
    std::vector<std::tuple<std::string, std::string, std::map<std::string, double, std::less<>>>>;

tmcmc::Prior prior_of(const Marginals& marginals) {
  std::vector<tmcmc::Parameter> parameters;
  for (const auto& [name, distribution, arguments] : marginals) {
    parameters.push_back({name, "", tmcmc::make_marginal(distribution, arguments)});
  }
  return tmcmc::Prior(std::move(parameters));
}

using GivenOptions = std::map<std::string, std::string>;

constexpr long default_chains = 100;

/// The recommended options; the recommended moves with what was given, whose names the caller has
/// checked.
tmcmc::Options options_of(long evaluations, std::optional<long> chains, const GivenOptions& given) {
  try {
    tmcmc::Options options = chains || !given.empty()
                                 ? tmcmc::recommended_moves(evaluations, chains.value_or(default_chains))
                                 : tmcmc::recommended_options(evaluations, default_chains);
    for (const auto& option : tmcmc::option_table()) {  // in the order in which they can be set
      if (const auto found = given.find(std::string(option.name)); found != given.end()) {
        tmcmc::set_option(options, option.name, found->second);
      }
    }
    options.validate();
    return options;
  } catch (const errors::InvalidValue& error) {
    const std::string field = error.field().substr(error.field().find('.') + 1);
    throw errors::InvalidValue(field == "evaluation_budget" ? "evaluations" : field, error.value(),
                               error.expected());
  }
}

/// \param marginals  of each parameter its name, the name of its distribution and the arguments by
///        name
py::dict run(const py::function& log_likelihood, const Marginals& marginals, long evaluations,
             std::optional<long> chains, std::uint64_t seed, std::uint32_t run_number,
             const GivenOptions& given) {
  const tmcmc::Options options = options_of(evaluations, chains, given);
  const tmcmc::Problem problem{batch_of(log_likelihood), prior_of(marginals), look_for_signals};
  tmcmc::Result result;
  {
    const py::gil_scoped_release unlock;
    result = tmcmc::run(problem, options, {.seed = seed, .run = run_number});
  }
  std::vector<std::string> warnings;
  for (const auto& warning : result.diagnostics.warnings) {
    warnings.push_back(warning.message);
  }
  return py::dict("samples"_a = result.final.points, "log_likelihood"_a = result.final.log_likelihood,
                  "weights"_a = Eigen::VectorXd(result.weights / result.weights.sum()),
                  "log_evidence"_a = result.evidence.log_evidence,
                  "log_evidence_error"_a = result.evidence.standard_error,
                  "effective_sample_size"_a = result.diagnostics.effective_sample_size,
                  "chains"_a = result.final.genealogy.chains, "parents"_a = result.final.genealogy.parents,
                  "stages"_a = stages_of(result), "warnings"_a = warnings, "beta"_a = result.final.beta,
                  "evaluations"_a = result.final.evaluations, "stop"_a = tmcmc::describe(result.stop));
}

/// \param chains, parents  the samples' genealogy
/// \return the arguments of tmcmc.Mode, a dict a mode; the place of each sample's mode; warnings
py::tuple find_modes(const Eigen::MatrixXd& samples, const Eigen::VectorXd& weights, tmcmc::Index chains,
                     const std::vector<std::vector<tmcmc::Index>>& parents) {
  tmcmc::Result result;
  result.final.points = samples;
  result.final.genealogy = {chains, parents};
  result.weights = weights;
  tmcmc::Modes found;
  {
    const py::gil_scoped_release unlock;
    found = tmcmc::find_modes(result);
  }
  py::list modes;
  for (const auto& mode : found.modes) {
    modes.append(py::dict("weight"_a = mode.weight, "standard_error"_a = mode.standard_error,
                          "samples"_a = mode.samples, "mean"_a = mode.mean,
                          "sd"_a = mode.standard_deviation));
  }
  return py::make_tuple(modes, py::array(py::cast(found.of_sample)), found.warnings);
}

std::vector<pbox::Ecdf> ecdfs_of(const std::vector<std::vector<double>>& samples) {
  return {samples.begin(), samples.end()};
}

friction::Physics physics_of(double driving_force_n, const std::string& limit, const std::string& phase) {
  friction::Physics physics;
  physics.driving_force_n = driving_force_n;
  physics.limit = limit == "grid" ? friction::LimitRule::grid : friction::LimitRule::supremum;
  physics.phase =
      phase == "discrete_bin" ? friction::PhaseRule::discrete_bin : friction::PhaseRule::fourier_coefficient;
  return physics;
}

/// Both arrays have one length.
py::array_t<double> phase(const Doubles& force_ratio, const Doubles& frequency_ratio,
                          const std::string& limit, const std::string& rule) {
  const friction::Physics physics = physics_of(1.0, limit, rule);
  py::array_t<double> angles(force_ratio.size());
  friction::ResponseConstants constants{};
  for (py::ssize_t i = 0; i < force_ratio.size(); ++i) {
    const double ratio = frequency_ratio.at(i);
    if (i == 0 || ratio != constants.frequency_ratio) {
      constants = friction::response_constants(ratio, physics);
    }
    angles.mutable_at(i) = friction::phase_deg(constants, force_ratio.at(i));
  }
  return angles;
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = COMPANION_VERSION;
  py::register_exception<tmcmc::SamplingError>(module, "SamplingError", PyExc_RuntimeError);
  module.def(
      "check_prior", [](const Marginals& marginals) { return prior_of(marginals).text(); }, "marginals"_a);
  module.def("distributions", [] {
    std::vector<std::pair<std::string, std::vector<std::string>>> all;
    for (const auto& distribution : tmcmc::distributions()) {
      all.emplace_back(distribution.name, std::vector<std::string>(distribution.arguments.begin(),
                                                                   distribution.arguments.end()));
    }
    return all;
  });
  module.def("run", &run, "log_likelihood"_a, "marginals"_a, "evaluations"_a, "chains"_a, "seed"_a, "run"_a,
             "options"_a);
  module.def("find_modes", &find_modes, "samples"_a, "weights"_a, "chains"_a, "parents"_a);
  module.def("options", [] {
    std::vector<std::tuple<std::string, std::string, std::string>> all;
    for (const auto& option : tmcmc::option_table()) {
      all.emplace_back(option.name, option.help, option.expected);
    }
    return all;
  });

  module.def("envelope", [](const std::vector<std::vector<double>>& samples) {
    const pbox::PBox box = pbox::envelope(ecdfs_of(samples));
    return py::make_tuple(py::array(py::cast(box.x)), py::array(py::cast(box.lower)),
                          py::array(py::cast(box.upper)));
  });
  module.def("area", [](const std::vector<std::vector<double>>& samples) {
    return pbox::area_metric(ecdfs_of(samples));
  });

  module.def("phase", &phase);
  py::class_<friction::Likelihood>(module, "Likelihood")
      .def(py::init([](std::vector<double> nominal_ratio, std::vector<double> measured_ratio,
                       std::vector<double> driving_frequency_hz, std::vector<double> phase_deg,
                       double driving_force_n, const std::string& limit, const std::string& rule,
                       double infeasible) {
        return friction::Likelihood({std::move(nominal_ratio), std::move(measured_ratio),
                                     std::move(driving_frequency_hz), std::move(phase_deg)},
                                    physics_of(driving_force_n, limit, rule), infeasible);
      }))
      .def("__call__",
           [](const friction::Likelihood& likelihood, const Eigen::MatrixXd& points) {
             Eigen::VectorXd values(points.rows());
             const py::gil_scoped_release unlock;
             likelihood(points, values);
             return values;
           })
      .def_property_readonly("limit_friction_force_n", &friction::Likelihood::limit_friction_force_n);
}
