/// \file
/// Prior density of the parameters: independent marginals, a Gaussian copula over them, or a
/// user-defined density.
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
  /// For headers and messages; not empty, unique.
  std::string name;
  /// Such as "N"; empty for none.
  std::string unit;
  /// Its distribution.
  Marginal marginal;
};

/// A user-defined prior, for example a hierarchical model.
struct OwnPrior {
  /// Name, unit and bounds of a parameter. The density is zero outside the bounds.
  struct OwnParameter {
    /// As in Parameter.
    std::string name;
    /// As in Parameter.
    std::string unit = {};
    /// Determines the unbounded coordinate; infinite where there is no bound.
    Support support = {};
  };
  /// One line that distinguishes this prior from others; it is stored in checkpoints.
  std::string description;
  /// The d parameters.
  std::vector<OwnParameter> parameters;
  /// Logarithm of the density for each row of `points`, normalised (if its integral is not 1, the
  /// evidence is wrong by that factor); minus infinity where the density is zero. Called only with
  /// points inside the supports, and from several threads if Options::threads is larger than 1.
  LogLikelihood log_density;
  /// Makes one draw from the same density, using as many numbers of the stream as it needs.
  std::function<void(RandomStream& stream, Eigen::Ref<Eigen::VectorXd> point)> draw;
};

/// A normalised prior, as a value. Improper priors are refused: the evidence is the likelihood
/// averaged over the prior, and no average exists over a density without a finite integral.
class Prior {
 public:
  /// Uniform prior on the box lower < x < upper (Table 2), with the names "parameter 0" and so on.
  /// \param lower,upper  one bound per parameter
  /// \throws errors::InvalidValue unless both have the same positive length, and lower < upper with
  ///         a finite distance and at least one double between them.
  Prior(Eigen::VectorXd lower, Eigen::VectorXd upper);

  /// Prior with the given marginals, independent or with a Gaussian copula.
  /// \throws errors::InvalidValue if there is no parameter, if a name is empty or repeated, and as
  ///         normal_score_correlation().
  explicit Prior(std::vector<Parameter> parameters, const Correlation& correlation = {});

  /// User-defined prior.
  /// \throws errors::InvalidValue if there is no parameter, if a name is empty or repeated, if
  ///         there are no doubles between two bounds, if the description is not one line, or if a
  ///         function is missing.
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
  /// Marginals, d; none for a user-defined prior.
  [[nodiscard]] const std::vector<Marginal>& marginals() const { return marginals_; }
  /// Whether the density is constant on the box of the supports.
  [[nodiscard]] bool is_box() const { return box_; }
  /// Whether the density is the product of the marginals.
  [[nodiscard]] bool is_independent() const { return own_ == nullptr && factor_.size() == 0; }
  /// One line that distinguishes the prior from others: names with their marginals and any further
  /// properties, or OwnPrior::description.
  [[nodiscard]] std::string text() const;

  /// n independent draws, n x d, none of them on a bound. They do not depend on the number of
  /// threads. With marginals the draws are quantiles of uniform numbers.
  /// \throws SamplingError if a user-defined prior draws a point outside its support
  [[nodiscard]] Population sample(Index n, const StreamKey& key, int threads = 1) const;

  /// One draw, from the random words at a place.
  void draw(const StreamKey& key, const DrawId& place, Eigen::Ref<Eigen::VectorXd> point) const;

  /// Logarithm of the normalised density of each row of `points`.
  [[nodiscard]] Eigen::VectorXd log_density(const Population& points) const;

  /// The log-density minus log_constant(), of n points that are stored column by column.
  /// \param columns  d pointers to n numbers each
  /// \throws SamplingError if a user-defined prior gives NaN or plus infinity
  void log_kernel(std::span<const double* const> columns, std::size_t n, double* result) const;

  /// The part of the log-density that does not depend on the parameters, which log_kernel() leaves
  /// out.
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
  // Cholesky factor of the correlation matrix of the normal scores; empty for independence
  Eigen::MatrixXd factor_;
  // whether each parameter is correlated with another; empty for independence
  std::vector<char> correlated_;
  std::shared_ptr<const OwnPrior> own_;
  bool box_ = false;
};

/// Former name of the uniform prior.
using BoxPrior = Prior;

}  // namespace tmcmc
