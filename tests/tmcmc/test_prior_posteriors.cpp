// Posteriors under other priors than uniform ones, against closed forms and quadrature.
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "tmcmc/distributions.hpp"
#include "tmcmc/problems.hpp"
#include "tmcmc/statistics.hpp"

using problems::by_rows;
using tmcmc::Index;
using tmcmc::Marginal;
using tmcmc::Prior;
using tmcmc::Problem;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t runs = 20;
/// Bound on the root mean square of 20 standard normal numbers; chance exceeds it with probability
/// 1e-4.
constexpr double rms_bound = 1.6;

struct Exact {
  std::vector<double> means;
  std::vector<double> standard_deviations;
  double log_evidence;
};

/// Means and log-evidence of 20 runs: none off in the mean, and each within its own error.
void check(const Problem& problem, const Exact& exact, const tmcmc::Options& options) {
  const auto d = exact.means.size();
  std::vector<std::vector<double>> means(d);
  std::vector<std::vector<double>> squares(d);
  std::vector<double> evidences;
  std::vector<double> mean_z(d, 0.0);
  double evidence_z = 0.0;
  for (std::uint32_t run = 0; run < runs; ++run) {
    const auto result = tmcmc::run(problem, options, {.seed = 12, .run = run});
    REQUIRE(result.stop == tmcmc::StopReason::completed);
    for (std::size_t j = 0; j < d; ++j) {
      const auto x = result.final.points.col(static_cast<Index>(j)).array();
      const double sd = exact.standard_deviations[j];
      const double size = result.diagnostics.effective_sample_size[static_cast<Index>(j)];
      means[j].push_back(x.mean());
      squares[j].push_back((x - exact.means[j]).square().mean());
      mean_z[j] += (x.mean() - exact.means[j]) * (x.mean() - exact.means[j]) * size / (sd * sd) / runs;
    }
    const double z =
        (result.evidence.log_evidence - exact.log_evidence) / std::max(result.evidence.standard_error, 1e-12);
    evidences.push_back(result.evidence.log_evidence);
    evidence_z += z * z / runs;
  }
  const double bias = 4.0 / static_cast<double>(options.samples);
  for (std::size_t j = 0; j < d; ++j) {
    CAPTURE(j, exact.means[j], exact.standard_deviations[j]);
    const double sd = exact.standard_deviations[j];
    const auto mean = statistics::estimate(means[j]);
    const auto variance = statistics::estimate(squares[j]);
    CHECK(std::fabs(mean.mean - exact.means[j]) <
          statistics::standard_errors * mean.standard_error + bias * sd);
    CHECK(std::fabs(variance.mean - sd * sd) <
          statistics::standard_errors * variance.standard_error + bias * sd * sd);
    CHECK(mean.standard_error < 0.05 * sd);  // else nothing is tested
    CHECK(std::sqrt(mean_z[j]) < rms_bound);
  }
  CAPTURE(exact.log_evidence, statistics::estimate(evidences).mean);
  CHECK(std::sqrt(evidence_z) < rms_bound);
}

void check(const Problem& problem, const Exact& exact) {
  check(problem, exact, tmcmc::recommended_moves(8000));
}

std::string parameter_name(std::size_t j) {
  return std::to_string(j).insert(0, 1, 'x');
}

/// Prior Normal(1, 2) and an observation with standard deviation 0.5 of each of d parameters.
void check_normal_normal(std::size_t d, const tmcmc::Options& options) {
  CAPTURE(d);
  std::vector<tmcmc::Parameter> parameters;
  Exact exact{{}, {}, 0.0};
  std::vector<double> y;
  for (std::size_t j = 0; j < d; ++j) {
    parameters.push_back({parameter_name(j), "", Marginal::normal(1.0, 2.0)});
    y.push_back(2.0 - 0.7 * static_cast<double>(j % 4));
    const double precision = 1.0 / 4.0 + 1.0 / 0.25;
    exact.means.push_back((1.0 / 4.0 + y[j] / 0.25) / precision);
    exact.standard_deviations.push_back(std::sqrt(1.0 / precision));
    exact.log_evidence +=
        std::log(statistics::normal_density((y[j] - 1.0) / std::sqrt(4.25)) / std::sqrt(4.25));
  }
  const auto log_likelihood = by_rows([y](const auto& x) {
    double sum = 0.0;
    for (std::size_t j = 0; j < y.size(); ++j) {
      const double r = (y[j] - x[static_cast<Index>(j)]) / 0.5;
      sum -= 0.5 * r * r + std::log(0.5 * std::sqrt(2.0 * 3.14159265358979323846));
    }
    return sum;
  });
  check({log_likelihood, Prior(parameters)}, exact, options);
}

}  // namespace

TEST_CASE("Normal prior and Normal likelihood in 1, 2 and 10 dimensions", "[tmcmc][prior]") {
  check_normal_normal(1, tmcmc::recommended_moves(8000));
  check_normal_normal(2, tmcmc::recommended_moves(8000));
  check_normal_normal(10, tmcmc::recommended_moves(40000, 100));
  // The moves of the paper, in natural coordinates.
  tmcmc::Options options;
  options.move = tmcmc::ResampleMove{.steps = 10};
  options.scale_rule = tmcmc::FixedScale{1.2};
  check_normal_normal(2, options);
}

TEST_CASE("gamma prior and Poisson counts", "[tmcmc][prior]") {
  // Counts 4, 2, 5: posterior gamma(3 + 11, 2 + 3).
  const auto log_likelihood = by_rows(
      [](const auto& x) { return 11.0 * std::log(x[0]) - 3.0 * x[0] - std::log(24.0 * 2.0 * 120.0); });
  const double evidence = 3.0 * std::log(2.0) + std::lgamma(14.0) - std::lgamma(3.0) - 14.0 * std::log(5.0) -
                          std::log(24.0 * 2.0 * 120.0);
  check({log_likelihood, Prior({{"rate", "1/s", Marginal::gamma(3.0, 2.0)}})},
        {{14.0 / 5.0}, {std::sqrt(14.0) / 5.0}, evidence});
}

TEST_CASE("beta prior and a binomial count", "[tmcmc][prior]") {
  // 7 of 10: posterior beta(2 + 7, 3 + 3).
  const auto log_likelihood = by_rows(
      [](const auto& x) { return 7.0 * std::log(x[0]) + 3.0 * std::log(1.0 - x[0]) + std::log(120.0); });
  const double evidence = std::log(120.0 * boost::math::beta(9.0, 6.0) / boost::math::beta(2.0, 3.0));
  check({log_likelihood, Prior({{"share", "", Marginal::beta(2.0, 3.0)}})},
        {{0.6}, {std::sqrt(0.6 * 0.4 / 16.0)}, evidence});
}

TEST_CASE("a correlated Normal prior gives the exact bivariate posterior", "[tmcmc][prior]") {
  Eigen::Matrix2d r;
  r << 1.0, 0.8, 0.8, 1.0;
  Eigen::Matrix2d covariance;
  covariance << 4.0, 0.8, 0.8, 0.25;
  // The sum is observed: 1.5 with a standard deviation of 0.3.
  const Eigen::Vector2d mean(1.0, -1.0);
  const Eigen::Vector2d a(1.0, 1.0);
  const double variance = a.dot(covariance * a) + 0.09;
  const Eigen::Vector2d gain = covariance * a / variance;
  const Eigen::Vector2d posterior = mean + gain * (1.5 - a.dot(mean));
  const Eigen::Matrix2d spread = covariance - gain * (covariance * a).transpose();
  const double evidence =
      std::log(statistics::normal_density((1.5 - a.dot(mean)) / std::sqrt(variance)) / std::sqrt(variance));
  const auto log_likelihood = by_rows([](const auto& x) {
    const double z = (1.5 - x[0] - x[1]) / 0.3;
    return -0.5 * z * z - std::log(0.3 * std::sqrt(2.0 * 3.14159265358979323846));
  });
  check({log_likelihood,
         Prior({{"a", "", Marginal::normal(1.0, 2.0)}, {"b", "", Marginal::normal(-1.0, 0.5)}}, {r})},
        {{posterior[0], posterior[1]}, {std::sqrt(spread(0, 0)), std::sqrt(spread(1, 1))}, evidence});
}

TEST_CASE("log-normal stiffnesses of a shear frame against quadrature", "[tmcmc][prior]") {
  // Two storeys of 1000 kg; both natural frequencies are measured, to 2 %.
  const Marginal lower = Marginal::log_normal_of_mean(2.0e6, 0.5e6);
  const Marginal upper = Marginal::log_normal_of_median(1.2e6, 0.3);
  const auto log_likelihood = [](double k1, double k2) {
    const double b = k1 + 2.0 * k2;
    const double root = std::sqrt(b * b - 4.0 * k1 * k2);
    double sum = 0.0;
    const double squares[] = {0.5e-3 * (b - root), 0.5e-3 * (b + root)};
    const double measured[] = {3.7, 10.0};
    for (int i = 0; i < 2; ++i) {
      const double f = std::sqrt(squares[i]) / 6.283185307179586;
      const double z = (f - measured[i]) / (0.02 * measured[i]);
      sum -= 0.5 * z * z;
    }
    return sum;
  };
  // Moments over the normal scores of the prior.
  using boost::math::quadrature::gauss_kronrod;
  const auto integral = [&](const auto& f) {
    return gauss_kronrod<double, 61>::integrate(
        [&](double z1) {
          const double k1 = lower.from_normal(z1);
          return statistics::normal_density(z1) * gauss_kronrod<double, 61>::integrate(
                                                      [&](double z2) {
                                                        const double k2 = upper.from_normal(z2);
                                                        return f(k1, k2) * std::exp(log_likelihood(k1, k2)) *
                                                               statistics::normal_density(z2);
                                                      },
                                                      -7.0, 7.0, 5, 1e-9);
        },
        -7.0, 7.0, 5, 1e-9);
  };
  const double z = integral([](double, double) { return 1.0; });
  Exact exact{{}, {}, std::log(z)};
  for (const int which : {0, 1}) {
    const auto k = [which](double k1, double k2) { return which == 0 ? k1 : k2; };
    const double mean = integral(k) / z;
    const double square = integral([&](double k1, double k2) { return std::pow(k(k1, k2) - mean, 2); }) / z;
    exact.means.push_back(mean);
    exact.standard_deviations.push_back(std::sqrt(square));
  }
  const Problem problem{by_rows([&](const auto& x) { return log_likelihood(x[0], x[1]); }),
                        Prior({{"stiffness_1", "N/m", lower}, {"stiffness_2", "N/m", upper}})};
  check(problem, exact);
  // The same by independent draws.
  auto options = tmcmc::recommended_moves(10000);
  options.finish = tmcmc::IndependentDraws{};
  const auto measured = tmcmc::run(problem, options, {.seed = 3});
  CHECK(std::fabs(measured.evidence.log_evidence - exact.log_evidence) <
        statistics::standard_errors * measured.evidence.standard_error);
  CHECK(measured.evidence.standard_error < 0.02);
}

TEST_CASE("with a flat likelihood the samples are the prior and the log-evidence is 0", "[tmcmc][prior]") {
  std::vector<Marginal> all;
  for (const auto& row : tmcmc::distributions()) {
    std::vector<double> arguments;
    for (std::size_t k = 0; k < row.arguments.size(); ++k) {
      arguments.push_back(1.5 + static_cast<double>(k));
    }
    all.push_back(row.make(arguments));
  }
  all.push_back(Marginal::truncated_normal(1.0, 2.0, 0.0, infinity));
  all.push_back(Marginal::truncated_normal(1.0, 2.0, -infinity, 0.0));
  all.push_back(Marginal::gamma(0.5, 2.0));
  tmcmc::Options natural;
  natural.samples = 500;
  natural.move = tmcmc::ResampleMove{.steps = 20};
  natural.scale_rule = tmcmc::FixedScale{2.0};
  for (const Marginal& marginal : all) {
    for (const auto& options : {tmcmc::recommended_moves(3000), natural}) {
      CAPTURE(marginal.text(), options.move.index());
      const Problem flat{by_rows([](const auto&) { return 0.0; }), Prior({{"x", "", marginal}})};
      std::vector<std::vector<double>> shares(4);
      for (std::uint32_t run = 0; run < runs; ++run) {
        const auto result = tmcmc::run(flat, options, {.seed = 13, .run = run});
        CHECK(std::fabs(result.evidence.log_evidence) <= 1e-12 + result.evidence.standard_error);
        std::vector<double> counts(4, 0.0);
        for (const double x : result.final.points.col(0)) {
          counts[std::min<std::size_t>(static_cast<std::size_t>(4.0 * marginal.cdf(x)), 3)] += 1.0;
        }
        for (std::size_t q = 0; q < 4; ++q) {
          shares[q].push_back(counts[q] / static_cast<double>(result.final.points.rows()));
        }
      }
      for (const auto& quarter : shares) {
        const auto share = statistics::estimate(quarter);
        CHECK(share.errors_from(0.25) < statistics::standard_errors);
        CHECK(share.standard_error < 0.02);
      }
    }
  }
}

TEST_CASE("ranks of parameters from a log-normal, beta and correlated prior are uniform", "[tmcmc][prior]") {
  // Simulation-based calibration on 500 data sets: y_i = k b + c t_i + noise.
  Eigen::Matrix3d r;
  r << 1.0, 0.6, 0.0, 0.6, 1.0, -0.4, 0.0, -0.4, 1.0;
  const Prior prior({{"k", "", Marginal::log_normal(0.0, 0.5)},
                     {"b", "", Marginal::beta(2.0, 4.0)},
                     {"c", "", Marginal::normal(0.0, 1.0)}},
                    {r});
  constexpr int data_sets = 500;
  constexpr int draws = 19;
  std::vector<std::vector<int>> histograms(3, std::vector<int>(draws + 1, 0));
  const auto options = tmcmc::recommended_moves(3000);
  for (std::uint32_t data_set = 0; data_set < data_sets; ++data_set) {
    const tmcmc::StreamKey truth_key{.seed = 14, .study = 1, .run = data_set};
    Eigen::VectorXd truth(3);
    prior.draw(truth_key, {.purpose = tmcmc::Purpose::data}, truth);
    tmcmc::RandomStream noise(truth_key, {.purpose = tmcmc::Purpose::data, .row = 1});
    Eigen::Vector4d y;
    for (Index i = 0; i < 4; ++i) {
      y[i] = truth[0] * truth[1] + truth[2] * static_cast<double>(i) + 0.3 * noise.normal();
    }
    const Problem problem{by_rows([y](const auto& x) {
                            double sum = 0.0;
                            for (Index i = 0; i < 4; ++i) {
                              const double z = (y[i] - x[0] * x[1] - x[2] * static_cast<double>(i)) / 0.3;
                              sum -= 0.5 * z * z;
                            }
                            return sum;
                          }),
                          prior};
    const auto result = tmcmc::run(problem, options, {.seed = 14, .run = data_set});
    const Index n = result.final.points.rows();
    for (Index j = 0; j < 3; ++j) {
      int rank = 0;
      for (Index k = 0; k < draws; ++k) {
        rank += result.final.points((2 * k + 1) * n / (2 * draws), j) < truth[j] ? 1 : 0;
      }
      ++histograms[static_cast<std::size_t>(j)][static_cast<std::size_t>(rank)];
    }
  }
  for (const auto& histogram : histograms) {
    double chi_square = 0.0;
    const double expected = data_sets / (draws + 1.0);
    for (const int count : histogram) {
      chi_square += (count - expected) * (count - expected) / expected;
    }
    CHECK(chi_square < 49.0);  // 19 degrees of freedom: exceeded by chance with probability 2e-4
  }
}

TEST_CASE("warnings call a parameter by its name", "[tmcmc][prior]") {
  const Problem problem{by_rows([](const auto& x) { return -1e4 * x[0] * x[0]; }),
                        Prior({{"stiffness_2", "N/m", Marginal::normal(0.0, 1.0)}})};
  tmcmc::Options options;
  options.samples = 60;
  options.move = tmcmc::ResampleMove{.steps = 1};
  const auto result = tmcmc::run(problem, options, {.seed = 1});
  bool named = false;
  for (const auto& warning : result.diagnostics.warnings) {
    named = named || warning.message.find("the effective sample size of stiffness_2 is ") == 0;
  }
  CHECK(named);
}
