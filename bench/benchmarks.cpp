// Speed of the parts, of a run and of a study in the published setting (Table 1, N = 1000, three
// steps a stage), with a straightforward implementation beside them. `make bench` writes a table
// and build/bench/benchmarks.json.

#include <benchmark/benchmark.h>

#include "portable_math/multiversion.hpp"
#include "reference_sampler.hpp"
#include "replication/study.hpp"
#include "replication/synthetic.hpp"
#include "tmcmc/detail/stage.hpp"

namespace {

constexpr int paper_samples = 1000;

friction::Observations observations() {
  return replication::generate_observations({}, replication::nominal_ratios(), {}, 1);
}

struct Setting {
  replication::Reading reading = replication::reading(replication::ReadingName::as_published);
  friction::Observations data = observations();
  tmcmc::BoxPrior prior{Eigen::Vector4d(0.01, 0.001, 0.001, 0.001), Eigen::Vector4d(10.0, 10.0, 10.0, 1.0)};
  tmcmc::Problem problem = replication::problem(reading, data, prior);
  std::vector<replication::Arm> arms = replication::paper_arms(reading);
};

reference::Model reference_model(const Setting& s) {
  reference::Model model;
  for (const double r : s.data.measured_ratio) {
    model.constants.push_back(friction::response_constants(r, s.reading.physics));
  }
  model.nominal_ratio = s.data.nominal_ratio;
  model.driving_frequency_hz = s.data.driving_frequency_hz;
  model.phase_deg = s.data.phase_deg;
  return model;
}

/// Points of the posterior's region, all feasible.
Eigen::MatrixXd posterior_points(Eigen::Index n) {
  const tmcmc::BoxPrior region(Eigen::Vector4d(0.9, 3.0, 2.0, 0.01), Eigen::Vector4d(1.1, 3.2, 4.0, 0.02));
  return region.sample(n, {.seed = 3});
}

void per_item(benchmark::State& state, double items) {
  state.counters["time_per_item"] =
      benchmark::Counter(items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The roof: multiplications and additions alone, in registers, as many independent ones as hide
/// their latency.
PORTABLE_MATH_MULTIVERSION
void multiply_and_add(double* x, int steps) {
  constexpr int lanes = 48;
  double a[lanes];
  std::copy_n(x, lanes, a);
  for (int step = 0; step < steps; ++step) {
#pragma GCC unroll 48
    for (double& value : a) {
      value = value * 0.999 + 0.001;
    }
  }
  std::copy_n(a, lanes, x);
}

void arithmetic_peak(benchmark::State& state) {
  constexpr int steps = 1000;
  std::vector<double> x(48, 0.5);
  for (auto _ : state) {
    multiply_and_add(x.data(), steps);
    benchmark::DoNotOptimize(x.data());
  }
  state.counters["flops"] =
      benchmark::Counter(2.0 * 48.0 * steps, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(arithmetic_peak);

void phase_reference(benchmark::State& state) {
  const Setting s;
  const auto model = reference_model(s);
  double force = 0.9;
  for (auto _ : state) {
    benchmark::DoNotOptimize(model.phase(3, force));
    force = force < 1.1 ? force + 1e-6 : 0.9;
  }
  per_item(state, 1.0);
}
BENCHMARK(phase_reference);

void phase_scalar(benchmark::State& state) {
  const Setting s;
  const auto model = reference_model(s);
  double force_ratio = 0.4;
  for (auto _ : state) {
    benchmark::DoNotOptimize(friction::phase_deg(model.constants[3], force_ratio));
    force_ratio = force_ratio < 0.44 ? force_ratio + 1e-6 : 0.4;
  }
  per_item(state, 1.0);
}
BENCHMARK(phase_scalar);

void likelihood_reference(benchmark::State& state) {
  const Setting s;
  const auto model = reference_model(s);
  const auto points = posterior_points(paper_samples);
  for (auto _ : state) {
    for (Eigen::Index i = 0; i < paper_samples; ++i) {
      benchmark::DoNotOptimize(
          model.log_likelihood({points(i, 0), points(i, 1), points(i, 2), points(i, 3)}));
    }
  }
  per_item(state, paper_samples);
}
BENCHMARK(likelihood_reference)->Unit(benchmark::kMicrosecond);

void likelihood_batch(benchmark::State& state) {
  const Setting s;
  const auto points = posterior_points(paper_samples);
  Eigen::VectorXd result(paper_samples);
  for (auto _ : state) {
    s.problem.log_likelihood(points, result);
    benchmark::DoNotOptimize(result.data());
  }
  per_item(state, paper_samples);
}
BENCHMARK(likelihood_batch)->Unit(benchmark::kMicrosecond);

void normals_reference(benchmark::State& state) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  for (auto _ : state) {
    for (int i = 0; i < 4 * paper_samples; ++i) {
      benchmark::DoNotOptimize(normal(generator));
    }
  }
  per_item(state, 4.0 * paper_samples);
}
BENCHMARK(normals_reference)->Unit(benchmark::kMicrosecond);

void normals_counter_based(benchmark::State& state) {
  std::vector<double> z(std::size_t{4} * paper_samples);
  for (auto _ : state) {
    for (std::size_t i = 0; i < paper_samples; ++i) {
      const auto w = tmcmc::random_words({.seed = 1}, {.row = i});
      const auto a = tmcmc::normal_pair(w[1], w[3] >> 32U);
      const auto b = tmcmc::normal_pair(w[2], w[3]);
      z[4 * i] = a.first;
      z[4 * i + 1] = a.second;
      z[4 * i + 2] = b.first;
      z[4 * i + 3] = b.second;
    }
    benchmark::DoNotOptimize(z.data());
  }
  per_item(state, 4.0 * paper_samples);
}
BENCHMARK(normals_counter_based)->Unit(benchmark::kMicrosecond);

void choose_step(benchmark::State& state) {
  const Setting s;
  const auto& arm = s.arms[static_cast<std::size_t>(state.range(0))];
  auto population = tmcmc::init(s.problem, arm.options, {.seed = 1});
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        tmcmc::choose_step(tmcmc::as_span(population.log_likelihood), 1.0, arm.options.criterion));
  }
}
BENCHMARK(choose_step)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void one_stage(benchmark::State& state) {
  const Setting s;
  const auto& options = s.arms[0].options;
  const tmcmc::StreamKey key{.seed = 1};
  tmcmc::detail::Stage stage(s.problem, options, key);
  const auto from = tmcmc::init(s.problem, options, key);
  const auto step = tmcmc::choose_step(tmcmc::as_span(from.log_likelihood), 1.0, options.criterion);
  tmcmc::State to;
  for (auto _ : state) {
    benchmark::DoNotOptimize(stage.advance(step, from, to));
  }
}
BENCHMARK(one_stage)->Unit(benchmark::kMicrosecond);

void one_run_reference(benchmark::State& state) {
  const Setting s;
  const auto model = reference_model(s);
  std::vector<reference::Point> samples;
  unsigned seed = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(reference::run(model, {0.01, 0.001, 0.001, 0.001}, {10.0, 10.0, 10.0, 1.0},
                                            paper_samples, seed++, samples));
  }
}
BENCHMARK(one_run_reference)->Unit(benchmark::kMillisecond);

void one_run(benchmark::State& state) {
  const Setting s;
  std::uint32_t run = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(tmcmc::run(s.problem, s.arms[0].options, {.seed = 1, .run = run++}));
  }
}
BENCHMARK(one_run)->Unit(benchmark::kMillisecond);

/// The same run under other priors than the box, by evaluation: independent log-normal ones, four
/// with other densities, a copula.
void one_run_with_prior(benchmark::State& state) {
  using tmcmc::Marginal;
  Setting s;
  const std::vector<tmcmc::Parameter> log_normal = {
      {"friction_force", "N", Marginal::log_normal_of_mean(2.0, 2.0)},
      {"natural_frequency", "Hz", Marginal::log_normal_of_mean(4.0, 2.0)},
      {"phase_noise", "deg", Marginal::log_normal_of_mean(3.0, 2.0)},
      {"ratio_noise", "", Marginal::log_normal_of_mean(0.05, 0.05)}};
  const std::vector<tmcmc::Parameter> mixed = {
      {"friction_force", "N", Marginal::gamma(2.0, 1.0)},
      {"natural_frequency", "Hz", Marginal::truncated_normal(3.0, 2.0, 0.01, 10.0)},
      {"phase_noise", "deg", Marginal::half_normal(5.0)},
      {"ratio_noise", "", Marginal::log_uniform(0.001, 1.0)}};
  Eigen::Matrix4d correlations = Eigen::Matrix4d::Identity();
  correlations(0, 1) = correlations(1, 0) = 0.5;
  correlations(2, 3) = correlations(3, 2) = 0.3;
  const std::vector<tmcmc::Prior> priors = {s.prior, tmcmc::Prior(log_normal), tmcmc::Prior(mixed),
                                            tmcmc::Prior(log_normal, {correlations})};
  s.problem.prior = priors[static_cast<std::size_t>(state.range(0))];
  double evaluations = 0.0;
  for (auto _ : state) {
    evaluations =
        static_cast<double>(tmcmc::run(s.problem, s.arms[1].options, {.seed = 1}).final.evaluations);
  }
  per_item(state, evaluations);
}
BENCHMARK(one_run_with_prior)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

/// TMCMC's posterior by independent draws from a fitted density.
void one_run_with_independent_draws(benchmark::State& state) {
  const Setting s;
  auto options = tmcmc::recommended_moves(state.range(0));
  options.finish = tmcmc::IndependentDraws{};
  std::uint32_t run = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(tmcmc::run(s.problem, options, {.seed = 1, .run = run++}));
  }
  per_item(state, static_cast<double>(state.range(0)));
}
BENCHMARK(one_run_with_independent_draws)->Arg(31000)->Unit(benchmark::kMillisecond);

void one_large_run(benchmark::State& state) {
  const Setting s;
  auto options = s.arms[0].options;
  options.samples = state.range(0);
  options.threads = static_cast<int>(state.range(1));
  for (auto _ : state) {
    benchmark::DoNotOptimize(tmcmc::run(s.problem, options, {.seed = 1}));
  }
  per_item(state, static_cast<double>(state.range(0)));
}
BENCHMARK(one_large_run)->Args({100000, 1})->Args({100000, 2})->Unit(benchmark::kMillisecond)->UseRealTime();

void one_study(benchmark::State& state) {
  const Setting s;
  replication::StudyOptions options;
  options.threads = static_cast<int>(state.range(0));
  for (auto _ : state) {
    for (std::uint32_t arm = 0; arm < s.arms.size(); ++arm) {
      const auto runs = replication::run_arm(s.problem, s.arms[arm], arm, options);
      benchmark::DoNotOptimize(replication::pbox_areas(runs, options.threads));
    }
    ++options.seed;
  }
}
BENCHMARK(one_study)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
