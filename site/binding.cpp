// What the page calls: a thin binding of the library's study, exact posterior and phase model. A
// study is set up by the words of sampling_study's command line, so that the page and the command
// line have the same options and the same messages.
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "fit.hpp"
#include "friction/time_integration.hpp"
#include "inputs.hpp"
#include "options.hpp"
#include "pbox/pbox.hpp"
#include "replication/replication.hpp"
#include "tmcmc/log_weights.hpp"
#include "tmcmc/options.hpp"
#include "tmcmc/weighted_samples.hpp"

using emscripten::val;

namespace {

val numbers(const double* data, std::size_t count) {
  const val array = val::global("Float64Array").new_(count);
  array.call<void>("set", val(emscripten::typed_memory_view(count, data)));
  return array;
}

val numbers(const std::vector<double>& values) {
  return numbers(values.data(), values.size());
}

val numbers(const Eigen::VectorXd& values) {
  return numbers(values.data(), static_cast<std::size_t>(values.size()));
}

/// Column by column.
val numbers(const tmcmc::Population& points) {
  return numbers(points.data(), static_cast<std::size_t>(points.size()));
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_file(const std::string& path, const std::string& text) {
  const auto directory = std::filesystem::path(path).parent_path();
  if (!directory.empty()) {
    std::filesystem::create_directories(directory);
  }
  std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::string> words_of(const val& words) {
  return emscripten::vecFromJSArray<std::string>(words);
}

/// The command line of sampling_study, as far as a study depends on it.
struct Settings {
  experiments::InputFiles inputs;
  experiments::RunOptions runs;
  experiments::SamplerOptions sampler;
  experiments::PhysicsOptions physics;
  replication::Reading reading;

  explicit Settings(std::vector<std::string> words) {
    CLI::App app("", "sampling_study");
    inputs.add_observations_to(app);
    inputs.add_prior_to(app);
    runs.add_to(app);
    sampler.add_to(app);
    physics.add_to(app);
    try {
      std::reverse(words.begin(), words.end());
      app.parse(words);
    } catch (const CLI::ParseError& error) {
      const std::string message = error.what();
      throw std::invalid_argument(message.substr(0, message.find('\n')));
    }
    reading = physics.reading();
    sampler.apply(reading);
  }

  [[nodiscard]] std::vector<replication::Arm> arms() const {
    return replication::paper_arms(reading, sampler.cov_target, sampler.ess_fraction);
  }
  [[nodiscard]] tmcmc::Problem problem() const {
    return replication::problem(reading, experiments::read_observations(inputs.observations),
                                experiments::prior_for(inputs, reading));
  }
};

val record_of(const tmcmc::StageRecord& s) {
  val record = val::object();
  record.set("stage", static_cast<double>(s.stage));
  record.set("beta", s.beta);
  record.set("step", s.step);
  record.set("effectiveSampleSize", s.effective_sample_size);
  record.set("coefficientOfVariation", s.coefficient_of_variation);
  record.set("acceptanceRate", s.acceptance_rate);
  record.set("feasible", static_cast<double>(s.feasible));
  record.set("distinctAncestors", static_cast<double>(s.distinct_ancestors));
  record.set("evaluations", static_cast<double>(s.evaluations));
  return record;
}

/// A study whose runs are made one by one, in any order.
class Study {
 public:
  explicit Study(const val& words)
      : settings_(words_of(words)),
        problem_(settings_.problem()),
        arms_(settings_.arms()),
        options_(settings_.runs.study_options()) {
    options_.validate();
    for (const auto& arm : arms_) {
      arm.options.validate();
    }
    runs_.resize(arms_.size());
    ecdfs_.resize(arms_.size());
  }

  /// Runs of each sampler, and the samplers' names.
  [[nodiscard]] val description() const {
    std::vector<std::string> names;
    for (const auto& arm : arms_) {
      names.push_back(arm.name);
    }
    val all = val::object();
    all.set("runs", static_cast<double>(options_.runs));
    all.set("arms", val::array(names));
    return all;
  }

  /// The next run of an arm.
  val run(std::size_t arm) {
    auto& runs = runs_.at(arm);
    runs.push_back(replication::run_one(problem_, arms_[arm], static_cast<std::uint32_t>(arm), options_,
                                        static_cast<tmcmc::Index>(runs.size())));
    const auto& run = runs.back();
    const tmcmc::Population points = equally_weighted(run, arm, runs.size() - 1);
    for (tmcmc::Index j = 0; j < points.cols(); ++j) {
      ecdfs_[arm][static_cast<std::size_t>(j)].emplace_back(
          std::vector<double>(points.col(j).begin(), points.col(j).end()));
    }
    val summary = val::object();
    summary.set("iterations", static_cast<double>(run.iterations()));
    summary.set("logEvidence", run.result.final.log_evidence);
    summary.set("evaluations", static_cast<double>(run.result.final.evaluations));
    summary.set("mean", numbers(run.mean));
    return summary;
  }

  /// Areas of the p-boxes of the runs so far, one entry per parameter.
  [[nodiscard]] val areas(std::size_t arm) const {
    std::vector<double> areas;
    for (const auto& ecdfs : ecdfs_.at(arm)) {
      areas.push_back(pbox::area_metric(ecdfs));
    }
    return numbers(areas);
  }

  /// The p-boxes of all samplers' runs so far at `count` places, at least from low to high: x, and
  /// for each sampler the least and the largest fraction.
  [[nodiscard]] val pboxes(std::size_t parameter, double low, double high, std::size_t count) const {
    for (const auto& of_arm : ecdfs_) {
      for (const auto& ecdf : of_arm.at(parameter)) {
        low = std::min(low, ecdf.sorted().front());
        high = std::max(high, ecdf.sorted().back());
      }
    }
    std::vector<double> x(count);
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = low + (high - low) * static_cast<double>(i) / static_cast<double>(count - 1);
    }
    val boxes = val::array();
    boxes.call<void>("push", numbers(x));
    for (const auto& of_arm : ecdfs_) {
      std::vector<double> lower(count, of_arm[parameter].empty() ? std::nan("") : 1.0);
      std::vector<double> upper(count, of_arm[parameter].empty() ? std::nan("") : 0.0);
      for (const auto& ecdf : of_arm[parameter]) {
        for (std::size_t i = 0; i < count; ++i) {
          const double fraction = ecdf(x[i]);
          lower[i] = std::min(lower[i], fraction);
          upper[i] = std::max(upper[i], fraction);
        }
      }
      boxes.call<void>("push", numbers(lower));
      boxes.call<void>("push", numbers(upper));
    }
    return boxes;
  }

  /// The samples of one parameter of a sampler's last run, in ascending order; of weighted ones
  /// 1000 that were drawn.
  [[nodiscard]] val samples(std::size_t arm, std::size_t parameter) const {
    const auto sorted = ecdfs_.at(arm).at(parameter).back().sorted();
    return numbers(sorted.data(), sorted.size());
  }

  /// The bytes that sampling_study writes: "runs", "stages" or "samples".
  [[nodiscard]] std::string csv(const std::string& table) const {
    const std::string path = "/tmp/" + table + ".csv";
    const bool is_weighted =
        std::holds_alternative<tmcmc::IndependentDraws>(settings_.reading.sampler.finish);
    io::CsvWriter writer(path, table == "runs"     ? replication::run_columns(settings_.sampler.diagnose)
                               : table == "stages" ? replication::stage_columns()
                                                   : replication::sample_columns(is_weighted));
    for (std::size_t a = 0; a < arms_.size(); ++a) {
      for (std::size_t i = 0; i < runs_[a].size(); ++i) {
        if (table == "runs") {
          replication::write_run(writer, arms_[a].name, i, runs_[a][i], settings_.sampler.diagnose);
        } else if (table == "stages") {
          replication::write_stages(writer, arms_[a].name, i, runs_[a][i]);
        } else {
          replication::write_samples(writer, arms_[a].name, i, runs_[a][i], is_weighted);
        }
      }
    }
    writer.commit();
    return bytes_of(path);
  }

  /// One run with the population after each stage and the weights that lead to the next one.
  [[nodiscard]] val trace(std::size_t arm, int index) const {
    std::vector<tmcmc::State> states;
    const auto run =
        replication::run_one(problem_, arms_.at(arm), static_cast<std::uint32_t>(arm), options_, index,
                             [&](const tmcmc::Progress& progress) { states.push_back(progress.state); });
    val stages = val::array();
    for (std::size_t t = 0; t < states.size(); ++t) {
      const auto& state = states[t];
      val stage = val::object();
      stage.set("beta", state.beta);
      stage.set("points", numbers(state.points));
      stage.set("logLikelihood", numbers(state.log_likelihood));
      if (t > 0 && t <= run.result.stages.size()) {
        stage.set("record", record_of(run.result.stages[t - 1]));
      }
      if (t < run.result.stages.size()) {
        std::vector<double> weights(static_cast<std::size_t>(state.log_likelihood.size()));
        static_cast<void>(tmcmc::relative_weights(tmcmc::as_span(state.log_likelihood),
                                                  run.result.stages[t].step, weights));
        stage.set("weights", numbers(weights));
      }
      stages.call<void>("push", stage);
    }
    return stages;
  }

 private:
  /// The samples of a run; weighted ones are drawn from.
  [[nodiscard]] tmcmc::Population equally_weighted(const replication::Run& run, std::size_t arm,
                                                   std::size_t index) const {
    const auto& weights = run.result.weights;
    if (weights.size() == 0 || (weights.array() == 1.0).all()) {
      return run.result.final.points;
    }
    const tmcmc::StreamKey key{options_.seed, options_.study, static_cast<std::uint32_t>(arm),
                               static_cast<std::uint32_t>(index)};
    return tmcmc::equally_weighted(run.result, 1000, key, tmcmc::Resampling::multinomial);
  }

  Settings settings_;
  tmcmc::Problem problem_;
  std::vector<replication::Arm> arms_;
  replication::StudyOptions options_;
  std::vector<std::vector<replication::Run>> runs_;
  std::vector<std::array<std::vector<pbox::Ecdf>, friction::parameter_count>> ecdfs_;
};

/// The exact marginals at `count` places each, and their moments, under the settings of a study.
val exact_posterior(const val& words, int count) {
  const Settings settings(words_of(words));
  const auto observations = experiments::read_observations(settings.inputs.observations);
  auto physics = settings.reading.physics;
  const friction::Likelihood likelihood(observations, physics);
  const auto exact = experiments::exact_posterior_for(
      settings.inputs, likelihood, experiments::prior_for(settings.inputs, settings.reading));
  val all = val::object();
  all.set("logEvidence", exact.log_evidence());
  val marginals = val::array();
  for (int p = 0; p < friction::parameter_count; ++p) {
    const auto& density = exact.marginal(static_cast<friction::Parameter>(p));
    const double low = density.quantile(1e-4);
    const double high = density.quantile(1.0 - 1e-4);
    std::vector<double> x, y, cdf;
    for (int i = 0; i < count; ++i) {
      x.push_back(low + (high - low) * i / (count - 1));
      y.push_back(density.density(x.back()));
      cdf.push_back(density.cdf(x.back()));
    }
    val marginal = val::object();
    marginal.set("x", numbers(x));
    marginal.set("density", numbers(y));
    marginal.set("cdf", numbers(cdf));
    marginal.set("mean", density.mean());
    marginal.set("sd", density.standard_deviation());
    marginal.set("low", density.quantile(0.025));
    marginal.set("high", density.quantile(0.975));
    marginals.call<void>("push", marginal);
  }
  all.set("marginals", marginals);
  return all;
}

/// Observations as the study reads them, for pictures.
val observations(const std::string& path) {
  const auto o = experiments::read_observations(path);
  val all = val::object();
  all.set("nominalRatio", numbers(o.nominal_ratio));
  all.set("measuredRatio", numbers(o.measured_ratio));
  all.set("drivingFrequencyHz", numbers(o.driving_frequency_hz));
  all.set("phaseDeg", numbers(o.phase_deg));
  return all;
}

val fit_of(const site::Fit& fit) {
  val all = val::object();
  all.set("estimate", fit.estimate);
  all.set("standardError", fit.standard_error);
  all.set("noise", fit.noise);
  all.set("atBound", fit.at_bound);
  return all;
}

/// Both least-squares fits under the settings of a study, standard errors with the noise of the
/// residuals.
val least_squares(const val& words) {
  const Settings settings(words_of(words));
  const auto o = experiments::read_observations(settings.inputs.observations);
  val all = val::object();
  all.set("frictionForce", fit_of(site::fit_friction_force(o, settings.reading.physics)));
  all.set("naturalFrequency", fit_of(site::fit_natural_frequency(o)));
  return all;
}

/// Phase angle, deg, over frequency ratios: in closed form (NaN where the mass sticks) and by
/// integration in time.
val phase_curve(double force_ratio, const val& ratios, bool integrate) {
  const auto r = emscripten::convertJSArrayToNumberVector<double>(ratios);
  std::vector<double> closed, integrated, limit;
  for (const double ratio : r) {
    double phase = std::numeric_limits<double>::quiet_NaN();
    double largest = phase;
    if (!friction::is_singular_ratio(ratio)) {
      const auto constants = friction::response_constants(ratio, friction::Physics{});
      phase = friction::phase_deg(constants, force_ratio);
      largest = constants.limit_force_ratio;
    }
    closed.push_back(phase);
    limit.push_back(largest);
    if (integrate) {
      integrated.push_back(
          friction::integrate_steady_response(ratio, force_ratio, {.maximum_periods = 60}).phase_deg);
    }
  }
  val all = val::object();
  all.set("closed", numbers(closed));
  all.set("limit", numbers(limit));
  all.set("integrated", numbers(integrated));
  return all;
}

/// The steady motion over two periods of the base: tau in periods, x in base amplitudes, and
/// whether the mass sticks.
val steady_motion(double frequency_ratio, double force_ratio) {
  const auto steady = friction::integrate_steady_response(frequency_ratio, force_ratio);
  val all = val::object();
  all.set("periodic", steady.state == friction::SteadyState::periodic);
  all.set("atRest", steady.state == friction::SteadyState::at_rest);
  all.set("phaseDeg", steady.phase_deg);
  all.set("amplitude", steady.amplitude);
  all.set("continuous", steady.continuous);
  all.set("stickingFraction", steady.sticking_fraction);
  all.set("stops", steady.stops_per_period);
  std::vector<double> tau, x, sticks;
  if (steady.state == friction::SteadyState::periodic) {
    const auto half = friction::trace_half_period(frequency_ratio, force_ratio, steady.x, steady.velocity,
                                                  {.steps_per_period = 200});
    for (int h = 0; h < 4; ++h) {
      const double sign = h % 2 == 0 ? 1.0 : -1.0;
      for (const auto& point : half) {
        tau.push_back(0.5 * h + point.tau / (2.0 * std::numbers::pi));
        x.push_back(sign * point.x);
        sticks.push_back(point.sticks ? 1.0 : 0.0);
      }
    }
  }
  all.set("tau", numbers(tau));
  all.set("x", numbers(x));
  all.set("sticks", numbers(sticks));
  return all;
}

/// The studies of the page, by the part that asked.
std::map<int, Study> studies;

/// What `work` returns, or an object with the one line that the command line would print.
template <class... Arguments, class Work>
auto guarded(Work work) {
  return +[](Arguments... arguments) -> val {
    try {
      return Work()(arguments...);
    } catch (const std::exception& error) {
      val failed = val::object();
      failed.set("error", io::printable(error.what(), 8192));
      return failed;
    }
  };
}

}  // namespace

EMSCRIPTEN_BINDINGS(tmcmc_study) {
  using std::size_t;
  using std::string;
  emscripten::function("writeFile", &write_file);
  emscripten::function("begin", guarded<int, val>([](int slot, const val& words) {
                         studies.erase(slot);
                         return studies.try_emplace(slot, words).first->second.description();
                       }));
  emscripten::function("run",
                       guarded<int, size_t>([](int slot, size_t arm) { return studies.at(slot).run(arm); }));
  emscripten::function(
      "areas", guarded<int, size_t>([](int slot, size_t arm) { return studies.at(slot).areas(arm); }));
  emscripten::function("pboxes", guarded<int, size_t, double, double, size_t>(
                                     [](int slot, size_t parameter, double low, double high, size_t count) {
                                       return studies.at(slot).pboxes(parameter, low, high, count);
                                     }));
  emscripten::function("samples", guarded<int, size_t, size_t>([](int slot, size_t arm, size_t parameter) {
                         return studies.at(slot).samples(arm, parameter);
                       }));
  emscripten::function("csv", guarded<int, string>([](int slot, const string& table) {
                         return val(studies.at(slot).csv(table));
                       }));
  emscripten::function("trace", guarded<int, size_t, int>([](int slot, size_t arm, int index) {
                         return studies.at(slot).trace(arm, index);
                       }));
  emscripten::function("observations",
                       guarded<string>([](const string& path) { return observations(path); }));
  emscripten::function("exactPosterior", guarded<val, int>([](const val& words, int count) {
                         return exact_posterior(words, count);
                       }));
  emscripten::function("leastSquares", guarded<val>([](const val& words) { return least_squares(words); }));
  emscripten::function("phaseCurve", guarded<double, val, bool>([](double phi, const val& r, bool integrate) {
                         return phase_curve(phi, r, integrate);
                       }));
  emscripten::function("steadyMotion",
                       guarded<double, double>([](double r, double phi) { return steady_motion(r, phi); }));
}
