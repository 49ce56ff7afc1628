#include "own_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "command_line/report.hpp"
#include "friction/angle.hpp"
#include "friction/likelihood.hpp"
#include "models/parallel_batches.hpp"
#include "other_program.hpp"
#include "replication/inputs.hpp"
#include "shear_frame.hpp"

namespace examples {

namespace {

/// The file of the measurements, which a problem file must name.
const std::string& measurements_file(const ProblemOptions& options) {
  if (options.file() && !options.is_given("--observations")) {
    throw io::InputError(fmt::format("{}: no data: expected file, the measurements, in the table [data]",
                                     io::printable_path(options.file()->path)));
  }
  return options.observations;
}

Model shear_frame(const ProblemOptions& options) {
  const FrameLikelihood frame(read_frame_observations(measurements_file(options)));
  const auto& measured = frame.observations();
  std::string description = "shear_frame";
  for (std::size_t i = 0; i < measured.mode.size(); ++i) {
    description += fmt::format(" {}:{}", measured.mode[i], io::format_number(measured.frequency_hz[i]));
  }
  Measurements measurements{.observed = {{"frequency_hz", measured.frequency_hz}},
                            .constant = {{"mode", {measured.mode.begin(), measured.mode.end()}}}};
  measurements.pointwise = [frame](const Eigen::MatrixXd& points) {
    return std::vector{std::pair{std::string("frequency_hz"), frame.pointwise(points)}};
  };
  ComparedOutputs compared{
      .outputs = [frame](const auto& points, auto outputs) { outputs = frame.frequencies_hz(points); },
      .noise = [](const auto& point, const auto& outputs) { return Eigen::RowVectorXd(point[2] * outputs); }};
  for (const long mode : measured.mode) {
    compared.labels.push_back(fmt::format("mode {}", mode));
  }
  return {prior_of(options, {.names = FrameLikelihood::parameter_names(), .nonnegative = true}), frame,
          description, measurements, compared};
}

/// Phase angles, each within half a turn of the measured one, followed by nominal frequency ratios:
/// the values that friction::Likelihood compares.
ComparedOutputs rig_outputs(const friction::Observations& measured, const friction::Physics& physics) {
  const auto n = static_cast<Eigen::Index>(measured.size());
  ComparedOutputs compared;
  compared.outputs = [measured, physics, n](const auto& points, auto outputs) {
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const auto constants = friction::response_constants(measured.measured_ratio[at], physics);
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const double phase =
            friction::phase_deg(constants, points(i, friction::friction_force) / physics.driving_force_n);
        outputs(i, k) = measured.phase_deg[at] - friction::angle_residual_deg(measured.phase_deg[at], phase);
        outputs(i, n + k) = measured.driving_frequency_hz[at] / points(i, friction::natural_frequency);
      }
    }
  };
  compared.noise = [n](const auto& point, const auto&) {
    Eigen::RowVectorXd noise(2 * n);
    noise << Eigen::RowVectorXd::Constant(n, point[friction::phase_noise]),
        Eigen::RowVectorXd::Constant(n, point[friction::frequency_ratio_noise]);
    return noise;
  };
  for (int repeat = 0; repeat < 2; ++repeat) {
    for (const double ratio : measured.nominal_ratio) {
      compared.labels.push_back(fmt::format("r = {}", io::format_number(ratio)));
    }
  }
  return compared;
}

Model friction_rig(const ProblemOptions& options) {
  const auto measured = replication::read_observations(measurements_file(options), command_line::warn);
  const friction::Physics physics{.driving_force_n = options.driving_force_n};
  std::string description =
      fmt::format("friction, driving force {} N", io::format_number(options.driving_force_n));
  for (std::size_t i = 0; i < measured.size(); ++i) {
    description += fmt::format(" {}:{}:{}:{}", io::format_number(measured.nominal_ratio[i]),
                               io::format_number(measured.measured_ratio[i]),
                               io::format_number(measured.driving_frequency_hz[i]),
                               io::format_number(measured.phase_deg[i]));
  }
  return {prior_of(options,
                   {.names = {"friction_force", "natural_frequency", "phase_noise", "frequency_ratio_noise"},
                    .nonnegative = true}),
          friction::Likelihood(measured, physics),
          description,
          {.observed = {{"phase_deg", measured.phase_deg}, {"r_nominal", measured.nominal_ratio}},
           .constant = {{"r_measured", measured.measured_ratio},
                        {"driving_frequency_hz", measured.driving_frequency_hz}}},
          rig_outputs(measured, physics)};
}

/// The models in C++ by the names that built_in takes. One of your own is a function like these,
/// and a row here.
const std::vector<std::pair<std::string, Model (*)(const ProblemOptions&)>> built_in_models = {
    {"shear_frame", shear_frame}, {"friction", friction_rig}};

}  // namespace

tmcmc::Prior prior_of(const ProblemOptions& options, const problem::ParameterRules& rules) {
  return options.file() && !options.is_given("--prior") ? problem::read_parameters(*options.file(), rules)
                                                        : problem::read_prior(options.prior, rules);
}

std::vector<std::string> built_in_names() {
  std::vector<std::string> names;
  for (const auto& [name, make] : built_in_models) {
    names.push_back(name);
  }
  return names;
}

Model make_model(const ProblemOptions& options, const Listeners& listeners) {
  const bool is_command = !options.command.empty(), is_worker = !options.worker.empty();
  if ((is_command && is_worker) || ((is_command || is_worker) && !options.um_bridge.empty()) ||
      (options.is_other_program() && options.is_given("--built-in"))) {
    throw std::invalid_argument("--built-in, --command, --worker, --um-bridge: expected one of them");
  }
  if (options.um_bridge.empty() != options.model.empty()) {
    throw std::invalid_argument("--um-bridge, --model: expected both of them");
  }
  if (options.is_other_program()) {
    return other_program(options, listeners);
  }
  const auto built_in = std::find_if(built_in_models.begin(), built_in_models.end(),
                                     [&](const auto& row) { return row.first == options.built_in; });
  Model model = built_in->second(options);
  model.log_likelihood = counted(model.log_likelihood, listeners);
  if (model.compared.outputs) {
    model.compared.outputs = models::parallel_outputs(counted(model.compared.outputs, listeners),
                                                      {.calls = options.thread_count()});
  }
  return model;
}

}  // namespace examples
