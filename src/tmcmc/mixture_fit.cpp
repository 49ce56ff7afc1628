#include "tmcmc/mixture_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "portable_math/multiversion.hpp"
#include "tmcmc/detail/clusters.hpp"
#include "tmcmc/detail/mixture_moments.hpp"
#include "tmcmc/detail/proposal_covariance.hpp"
#include "tmcmc/detail/vector_sums.hpp"

namespace tmcmc {

using detail::cholesky_factor;
using detail::Moments;
using detail::proposal_covariance;
using detail::weighted_mean;

namespace {

/// unit = weight / density; the part of a point assigned to a component is unit times the
/// component's term.
PORTABLE_MATH_MULTIVERSION
void share_weights(Index rows, const double* weights, const double* sum, double* unit) {
  for (Index i = 0; i < rows; ++i) {
    unit[i] = sum[i] > 0.0 ? weights[i] / sum[i] : 0.0;
  }
}

PORTABLE_MATH_MULTIVERSION
void logarithms(Index rows, const double* sum, const double* log_scale, double* log_density) {
  for (Index i = 0; i < rows; ++i) {
    log_density[i] = log_scale[i] + portable_math::log(sum[i]);
  }
}

/// Work space and data of one fit.
class Fit {
 public:
  Fit(const WeightedPoints& data, const MixtureFitOptions& options, const std::function<void()>& look)
      : data_(data), options_(options), look_(look), d_(data.points.cols()), n_(data.points.rows()) {
    total_ = detail::sum(data.weights.data(), n_);
    if (!(total_ > 0.0) || !std::isfinite(total_)) {
      throw SamplingError("no point has a positive weight to fit a reference density to");
    }
    mean_ = weighted_mean(data.points, as_span(data.weights), total_);
    covariance_ = proposal_covariance(data.points, as_span(data.weights), total_, 1.0, Centre::weighted_mean);
    for (Index j = 0; j < d_; ++j) {
      // A coordinate without variance gets a small one, as does every other coordinate, beyond its
      // rounding.
      covariance_(j, j) += 1e-6 * covariance_(j, j) + 1e-12;
    }
  }

  [[nodiscard]] StudentMixture run(Index components, const StreamKey& key, std::uint32_t stage) {
    return improve(start(components, key, stage));
  }

  [[nodiscard]] StudentMixture improve(StudentMixture mixture) {
    constexpr int fewest_iterations = 4;
    double before = -std::numeric_limits<double>::infinity();
    for (int iteration = 1; iteration <= options_.most_iterations; ++iteration) {
      if (look_) {
        look_();
      }
      const bool is_compared =
          iteration + 1 >= fewest_iterations && options_.most_iterations > fewest_iterations;
      const double mean_log_density = expect(mixture, is_compared);
      maximise(mixture);
      if (iteration >= fewest_iterations && mean_log_density - before < options_.tolerance) {
        break;
      }
      before = mean_log_density;
    }
    return mixture;
  }

 private:
  /// Components of clusters in coordinates whitened by the covariance of all points.
  [[nodiscard]] StudentMixture start(Index components, const StreamKey& key, std::uint32_t stage) {
    StudentMixture mixture;
    mixture.degrees_of_freedom = options_.degrees_of_freedom;
    const Eigen::MatrixXd factor = cholesky_factor(covariance_);
    if (components == 1) {
      mixture.weights = Eigen::VectorXd::Ones(1);
      mixture.means = mean_;
      mixture.factors = {factor};
      return mixture;
    }
    // A subset of points at equal steps is enough for the start.
    constexpr Index most_points = 500;
    const Index stride = (n_ + most_points - 1) / most_points;
    const Index n = (n_ + stride - 1) / stride;
    Population points(n, d_);
    Eigen::VectorXd weights(n);
    for (Index j = 0; j < d_; ++j) {
      for (Index i = 0; i < n; ++i) {
        points(i, j) = data_.points(i * stride, j) - mean_[j];
      }
    }
    for (Index i = 0; i < n; ++i) {
      weights[i] = data_.weights[i * stride];
    }
    const double total = detail::sum(weights.data(), n);
    if (!(total > 0.0)) {
      return start(1, key, stage);
    }
    weights *= total_ / total;
    Population white = points;
    for (Index j = 0; j < d_; ++j) {
      for (Index l = 0; l < j; ++l) {
        white.col(j) -= factor(j, l) * white.col(l);
      }
      white.col(j) /= factor(j, j);
    }
    return from_clusters(points, weights, components,
                         detail::clusters(white, weights, components, key, stage));
  }

  /// Components with the weights, means and covariances of the clusters.
  /// \param points  deviations from the mean of all points
  [[nodiscard]] StudentMixture from_clusters(const Population& points, const Eigen::VectorXd& weights,
                                             Index components, const std::vector<Index>& cluster_of) {
    StudentMixture mixture;
    mixture.degrees_of_freedom = options_.degrees_of_freedom;
    mixture.means = mean_.replicate(1, components);
    moments_.assign(static_cast<std::size_t>(components), Moments(d_));
    mixture.weights = Eigen::VectorXd::Zero(components);
    for (Index i = 0; i < points.rows(); ++i) {
      Moments& moments = moments_[static_cast<std::size_t>(cluster_of[static_cast<std::size_t>(i)])];
      const double weight = weights[i];
      moments.taken += weight;
      for (Index j = 0; j < d_; ++j) {
        moments.first[j] += weight * points(i, j);
        for (Index l = 0; l <= j; ++l) {
          moments.second(j, l) += weight * points(i, j) * points(i, l);
        }
      }
    }
    for (Moments& moments : moments_) {
      moments.pull = moments.taken;
    }
    maximise(mixture);
    return mixture;
  }

  /// E-step and the sums of the M-step.
  /// \return  the mean log-density if it is requested, otherwise 0
  double expect(const StudentMixture& mixture, bool has_density) {
    const Index components = mixture.size();
    detail::MixtureTerms terms(mixture);
    moments_.assign(static_cast<std::size_t>(components), Moments(d_));
    double log_density_sum = 0.0;
    double log_density[detail::mixture_rows];
    double unit[detail::mixture_rows];
    for (Index begin = 0; begin < n_; begin += detail::mixture_rows) {
      const Index rows = std::min(detail::mixture_rows, n_ - begin);
      const double* weights = data_.weights.data() + begin;
      terms.evaluate(data_.points.data() + begin, n_, rows);
      share_weights(rows, weights, terms.sum(), unit);
      if (has_density) {
        logarithms(rows, terms.sum(), terms.log_scale(), log_density);
        log_density_sum += detail::sum_of_products(weights, log_density, rows);
      }
      for (Index k = 0; k < components; ++k) {
        add_moments({data_.points.data() + begin, n_, rows, unit}, terms, mixture, k,
                    moments_[static_cast<std::size_t>(k)]);
      }
    }
    return log_density_sum / total_;
  }

  /// Scale matrix of one component, computed from its sums.
  [[nodiscard]] Eigen::MatrixXd own_scale(const Moments& moments) const {
    Eigen::MatrixXd scale(d_, d_);
    for (Index j = 0; j < d_; ++j) {
      for (Index l = 0; l <= j; ++l) {
        scale(j, l) = moments.second(j, l) / moments.pull -
                      moments.first[j] / moments.pull * (moments.first[l] / moments.pull);
        scale(l, j) = scale(j, l);
      }
    }
    return scale;
  }

  void maximise(StudentMixture& mixture) const {
    const double fewest = 2.0 + 0.25 * static_cast<double>(d_);
    StudentMixture next;
    next.degrees_of_freedom = mixture.degrees_of_freedom;
    std::vector<Index> kept;
    Index largest = 0;
    for (Index k = 0; k < mixture.size(); ++k) {
      const double taken = moments_[static_cast<std::size_t>(k)].taken;
      largest = taken > moments_[static_cast<std::size_t>(largest)].taken ? k : largest;
      if (taken > fewest) {
        kept.push_back(k);
      }
    }
    if (kept.empty()) {
      kept.push_back(largest);
    }
    const auto count = static_cast<Index>(kept.size());
    double all = 0.0;
    Eigen::MatrixXd within = Eigen::MatrixXd::Zero(d_, d_);
    for (const Index k : kept) {
      const Moments& moments = moments_[static_cast<std::size_t>(k)];
      all += moments.taken;
      within += moments.taken * own_scale(moments);
    }
    within /= all;
    next.weights.resize(count);
    next.means.resize(d_, count);
    for (Index m = 0; m < count; ++m) {
      const Index k = kept[static_cast<std::size_t>(m)];
      const Moments& moments = moments_[static_cast<std::size_t>(k)];
      next.weights[m] = moments.taken / all;
      const double shrinkage =
          count == 1 ? 0.0 : static_cast<double>(d_ + 1) / (static_cast<double>(d_ + 1) + moments.taken);
      Eigen::MatrixXd scale = (1.0 - shrinkage) * own_scale(moments) + shrinkage * within;
      for (Index j = 0; j < d_; ++j) {
        next.means(j, m) = mixture.means(j, k) + moments.first[j] / moments.pull;
        scale(j, j) += 1e-6 * within(j, j) + 1e-14 * covariance_(j, j);
      }
      next.factors.push_back(cholesky_factor(scale));
    }
    mixture = std::move(next);
  }

  const WeightedPoints& data_;
  const MixtureFitOptions& options_;
  const std::function<void()>& look_;
  Index d_;
  Index n_;
  double total_ = 0.0;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_;
  std::vector<Moments> moments_;
};

}  // namespace

StudentMixture fit_mixture(const WeightedPoints& data, Index components, const MixtureFitOptions& options,
                           const StreamKey& key, std::uint32_t stage, const std::function<void()>& look) {
  return Fit(data, options, look).run(components, key, stage);
}

StudentMixture improve_mixture(const WeightedPoints& data, StudentMixture start,
                               const MixtureFitOptions& options, const std::function<void()>& look) {
  return Fit(data, options, look).improve(std::move(start));
}

}  // namespace tmcmc
