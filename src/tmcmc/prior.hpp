/// \file
/// Prior density of the parameters: independent marginals, a Gaussian copula over them, or a density of the user's own.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tmcmc/correlation.hpp"
#include "tmcmc/marginal.hpp"
#include "tmcmc/random_stream.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// One parameter of a prior.
struct Parameter {
  std::string name;   ///< for headers and messages; not empty, different from the others
  std::string unit;   ///< such as "N"; empty for none
  Marginal marginal;  ///< its distribution
};

/// A prior that the user writes, a hierarchical model for example.
struct OwnPrior {
  /// Name, unit and bounds of a parameter. The density is zero outside.
  struct OwnParameter {
    std::string name;       ///< as in Parameter
    std::string unit = {};  ///< as in Parameter
    Support support = {};   ///< decides the unbounded coordinate; infinite bounds where there are none
  };
  /// One line that tells it from other priors; it stands in checkpoints.
  std::string description;
  /// d of them.
  std::vector<OwnParameter> parameters;
  /// Logarithm of the density, normalised (its integral is 1, or the evidence is off by it), for each row of `points`; minus
  /// infinity where it is zero. Called with points inside the supports only, from several threads with Options::threads.
  LogLikelihood log_density;
  /// Makes one draw from the same density out of as many numbers of the stream as it takes.
  std::function<void(RandomStream& stream, Eigen::Ref<Eigen::VectorXd> point)> draw;
};

/// A normalised prior, as a value. Improper priors are refused: the evidence is the likelihood averaged over the prior, and
/// there is no average over a density without a finite integral.
class Prior {
 public:
  /// Uniform on the box lower < x < upper (Table 2), with the names "parameter 0" and so on.
  /// \param lower,upper  one bound a parameter
  /// \throws errors::InvalidValue unless both have the same positive length, and lower < upper with a finite
  ///         distance and at least one double between them.
  Prior(Eigen::VectorXd lower, Eigen::VectorXd upper);

  /// Marginals by parameter, independent or with a Gaussian copula.
  /// \throws errors::InvalidValue for no parameter, a name that is empty or stands twice, and as normal_score_correlation().
  explicit Prior(std::vector<Parameter> parameters, const Correlation& correlation = {});

  /// \throws errors::InvalidValue for no parameter, a name that is empty or stands twice, bounds without doubles between them, a
  ///         description that is not one line, and a missing function.
  explicit Prior(OwnPrior own);

  /// d, the number of parameters.
  [[nodiscard]] Index dimension() const { return lower_.size(); }
  /// Lower bounds of the supports, d; minus infinity where there is none.
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  /// Upper bounds of the supports, d; infinity where there is none.
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }
  /// Names of the parameters, d.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Units of the parameters, d; empty for none.
  [[nodiscard]] const std::vector<std::string>& units() const { return units_; }
  /// Marginals, d; none for a prior of the user's own.
  [[nodiscard]] const std::vector<Marginal>& marginals() const { return marginals_; }
  /// Whether the density is constant on the box of the supports.
  [[nodiscard]] bool is_box() const { return box_; }
  /// Whether the density is the product of the marginals.
  [[nodiscard]] bool is_independent() const { return own_ == nullptr && factor_.size() == 0; }
  /// One line that tells the prior from others: names with their marginals and what else there is, or OwnPrior::description.
  [[nodiscard]] std::string text() const;

  /// n independent draws, n x d, none on a bound. They do not depend on the threads. Marginals get quantiles of uniform numbers.
  /// \throws SamplingError if a prior of the user's own draws a point outside its support
  [[nodiscard]] Population sample(Index n, const StreamKey& key, int threads = 1) const;

  /// One draw from the random words at a place.
  void draw(const StreamKey& key, const DrawId& place, Eigen::Ref<Eigen::VectorXd> point) const;

  /// Logarithm of the normalised density of each row of `points`.
  [[nodiscard]] Eigen::VectorXd log_density(const Population& points) const;

  /// The log-density less log_constant(), of n points that stand column by column.
  /// \param columns  d pointers to n numbers each
  /// \throws SamplingError if a prior of the user's own gives NaN or plus infinity
  void log_kernel(std::span<const double* const> columns, std::size_t n, double* result) const;

  /// What log_kernel() leaves out, the part of the log-density that no parameter changes.
  [[nodiscard]] double log_constant() const;

 private:
  void add_copula(std::span<const double* const> columns, std::size_t n, double* result) const;
  void own_log_density(std::span<const double* const> columns, std::size_t n, double* result) const;
  void set_names(std::vector<std::string> names, std::vector<std::string> units);

  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  std::vector<std::string> names_;
  std::vector<std::string> units_;
  std::vector<Marginal> marginals_;
  Eigen::MatrixXd
      factor_;  // Cholesky factor of the correlation matrix of the normal scores; empty for independence
  std::vector<char> correlated_;  // which parameters are, with any other; empty for independence
  std::shared_ptr<const OwnPrior> own_;
  bool box_ = false;
};

/// The name that the uniform prior had.
using BoxPrior = Prior;

}  // namespace tmcmc
