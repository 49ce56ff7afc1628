#include "tmcmc/prior.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include "errors/invalid_value.hpp"
#include "tmcmc/detail/infinity.hpp"
#include "tmcmc/detail/proposal_covariance.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

/// The nearest double strictly between the bounds.
double inside(double value, double lower, double upper) {
  return std::clamp(value, std::nextafter(lower, detail::infinity), std::nextafter(upper, -detail::infinity));
}

/// Entry (i, j), j <= i, of the matrix with this Cholesky factor; plain sums, so that the digits
/// are the same everywhere.
double correlation_of(const Eigen::MatrixXd& factor, Index i, Index j) {
  double sum = 0.0;
  for (Index k = 0; k <= j; ++k) {
    sum += factor(i, k) * factor(j, k);
  }
  return sum;
}

}  // namespace

Prior::Prior(Eigen::VectorXd lower, Eigen::VectorXd upper)
    : lower_(std::move(lower)), upper_(std::move(upper)), box_(true) {
  if (lower_.size() == 0 || lower_.size() != upper_.size()) {
    throw errors::InvalidValue("prior", "", "as many lower as upper bounds, at least one of each");
  }
  for (Index j = 0; j < lower_.size(); ++j) {
    if (!std::isfinite(upper_[j] - lower_[j]) || !(std::nextafter(lower_[j], upper_[j]) < upper_[j])) {
      std::ostringstream bounds;
      bounds << std::setprecision(17) << "[" << lower_[j] << ", " << upper_[j] << "]";
      throw errors::InvalidValue("prior: bounds of parameter " + std::to_string(j), bounds.str(),
                                 "finite numbers, lower < upper, with numbers between them");
    }
    marginals_.push_back(Marginal::uniform(lower_[j], upper_[j]));
    names_.push_back("parameter " + std::to_string(j));
    units_.emplace_back();
  }
}

Prior::Prior(std::vector<Parameter> parameters, const Correlation& correlation)
    : lower_(static_cast<Index>(parameters.size())),
      upper_(static_cast<Index>(parameters.size())),
      box_(true) {
  std::vector<std::string> names;
  std::vector<std::string> units;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const Parameter& parameter = parameters[j];
    lower_[static_cast<Index>(j)] = parameter.marginal.support().lower;
    upper_[static_cast<Index>(j)] = parameter.marginal.support().upper;
    box_ = box_ && parameter.marginal.distribution() == "uniform";
    names.push_back(parameter.name);
    units.push_back(parameter.unit);
    marginals_.push_back(parameter.marginal);
  }
  set_names(std::move(names), std::move(units));
  if (correlation.matrix.size() > 0) {
    const Eigen::MatrixXd scores = normal_score_correlation(correlation, marginals_);
    if (scores != Eigen::MatrixXd::Identity(scores.rows(), scores.cols())) {
      factor_ = detail::cholesky_factor(scores);
      for (Index j = 0; j < scores.rows(); ++j) {
        double off_diagonal = 0.0;
        for (Index k = 0; k < scores.cols(); ++k) {
          off_diagonal += k == j ? 0.0 : std::fabs(scores(j, k));
        }
        correlated_.push_back(off_diagonal > 0.0 ? 1 : 0);
      }
      box_ = false;
    }
  }
}

Prior::Prior(OwnPrior own)
    : lower_(static_cast<Index>(own.parameters.size())), upper_(static_cast<Index>(own.parameters.size())) {
  std::vector<std::string> names;
  std::vector<std::string> units;
  for (std::size_t j = 0; j < own.parameters.size(); ++j) {
    const auto& [name, unit, support] = own.parameters[j];
    if (!(std::nextafter(support.lower, support.upper) < support.upper)) {
      throw errors::InvalidValue(name + ".support.upper", support.upper,
                                 "a number above the lower bound, with others between them");
    }
    lower_[static_cast<Index>(j)] = support.lower;
    upper_[static_cast<Index>(j)] = support.upper;
    names.push_back(name);
    units.push_back(unit);
  }
  set_names(std::move(names), std::move(units));
  if (own.description.empty() || own.description.find_first_of("\r\n") != std::string::npos) {
    throw errors::InvalidValue("description", own.description, "one line that names the prior");
  }
  if (!own.log_density || !own.draw) {
    throw errors::InvalidValue("prior", own.description, "a function log_density and a function draw");
  }
  own_ = std::make_shared<const OwnPrior>(std::move(own));
}

void Prior::set_names(std::vector<std::string> names, std::vector<std::string> units) {
  if (names.empty()) {
    throw errors::InvalidValue("parameters", "", "at least one");
  }
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (name->empty() || std::find(names.begin(), name, *name) != name) {
      throw errors::InvalidValue("name", *name, "a name for each parameter that no other has");
    }
  }
  names_ = std::move(names);
  units_ = std::move(units);
}

std::string Prior::text() const {
  if (own_ != nullptr) {
    return own_->description;
  }
  std::string result;
  for (std::size_t j = 0; j < names_.size(); ++j) {
    result.append(j == 0 ? "" : ", ").append(names_[j]).append(" ").append(marginals_[j].text());
  }
  if (factor_.size() > 0) {
    std::ostringstream correlations;
    correlations << std::setprecision(17);
    for (Index i = 0; i < factor_.rows(); ++i) {
      for (Index j = 0; j < i; ++j) {
        correlations << (i == 1 && j == 0 ? ", correlations of the normal scores" : "") << ' '
                     << correlation_of(factor_, i, j);
      }
    }
    result += correlations.str();
  }
  return result;
}

void Prior::draw(const StreamKey& key, const DrawId& place, Eigen::Ref<Eigen::VectorXd> point) const {
  RandomStream stream(key, place);
  if (own_ != nullptr) {
    own_->draw(stream, point);
    for (Index j = 0; j < dimension(); ++j) {
      if (!(point[j] >= lower_[j] && point[j] <= upper_[j] && std::isfinite(point[j]))) {
        std::ostringstream message;
        message << std::setprecision(17) << "the prior has drawn " << names_[static_cast<std::size_t>(j)]
                << " = " << point[j] << ": expected a number in its support, from " << lower_[j] << " to "
                << upper_[j];
        throw SamplingError(message.str());
      }
      point[j] = inside(point[j], lower_[j], upper_[j]);
    }
    return;
  }
  std::vector<double> normals(factor_.size() > 0 ? marginals_.size() : 0);
  for (Index j = 0; j < dimension(); ++j) {
    const Marginal& marginal = marginals_[static_cast<std::size_t>(j)];
    const double u = stream.uniform();
    double value = 0.0;
    if (normals.empty()) {
      value = marginal.quantile(u);
    } else {
      normals[static_cast<std::size_t>(j)] = portable_math::normal_quantile(u);
      double z = 0.0;
      for (Index k = 0; k <= j; ++k) {
        z += factor_(j, k) * normals[static_cast<std::size_t>(k)];
      }
      value = factor_(j, j) == 1.0 ? marginal.quantile(u) : marginal.from_normal(z);
    }
    point[j] = inside(value, lower_[j], upper_[j]);
  }
}

Population Prior::sample(Index n, const StreamKey& key, int threads) const {
  Population points(n, dimension());
  for_each_block(n, reduction_rows, threads, [&](Index, Index begin, Index end) {
    Eigen::VectorXd point(dimension());
    for (Index i = begin; i < end; ++i) {
      draw(key, {.purpose = Purpose::prior, .row = static_cast<std::uint64_t>(i)}, point);
      for (Index j = 0; j < dimension(); ++j) {
        points(i, j) = point[j];
      }
    }
  });
  return points;
}

}  // namespace tmcmc
