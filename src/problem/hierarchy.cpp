#include "problem/hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"

namespace problem {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr tmcmc::Index trial_draws = 1000;

/// The parameters as text, such as "theta ~ normal(mu, 2)".
std::string describe(const std::vector<ConditionalParameter>& parameters) {
  std::string text;
  for (const auto& parameter : parameters) {
    text +=
        (text.empty() ? "" : ", ") + parameter.name + " ~ " + std::string(parameter.distribution.name) + "(";
    for (std::size_t k = 0; k < parameter.arguments.size(); ++k) {
      const auto* other = std::get_if<std::size_t>(&parameter.arguments[k]);
      text += k > 0 ? ", " : "";
      text += other != nullptr ? parameters[*other].name
                               : io::format_number(std::get<double>(parameter.arguments[k]));
    }
    text += ")";
  }
  return text;
}

/// The support, without bounds that are other parameters.
tmcmc::Support fixed_support(const ConditionalParameter& parameter, const tmcmc::Marginal& example) {
  tmcmc::Support support = example.support();
  for (std::size_t k = 0; k < parameter.arguments.size(); ++k) {
    const bool is_other = std::holds_alternative<std::size_t>(parameter.arguments[k]);
    if (is_other && parameter.distribution.arguments[k] == "lower") {
      support.lower = -infinity;
    } else if (is_other && parameter.distribution.arguments[k] == "upper") {
      support.upper = infinity;
    }
  }
  return support;
}

double log_density(const std::vector<ConditionalParameter>& parameters,
                   const Eigen::Ref<const Eigen::VectorXd>& point) {
  double sum = 0.0;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    try {
      sum += parameters[j].given(point).log_density(point[static_cast<Eigen::Index>(j)]);
    } catch (const errors::InvalidValue&) {  // the parameters before it have left the range of its arguments
      return -infinity;
    }
  }
  return sum;
}

void draw(const std::vector<ConditionalParameter>& parameters, tmcmc::RandomStream& stream,
          Eigen::Ref<Eigen::VectorXd> point) {
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    try {
      point[static_cast<Eigen::Index>(j)] = parameters[j].given(point).quantile(stream.uniform());
    } catch (const errors::InvalidValue& error) {
      throw errors::InvalidValue(parameters[j].name, error.field() + " = " + error.value(), error.expected());
    }
  }
}

}  // namespace

bool ConditionalParameter::depends_on_others() const {
  return std::any_of(arguments.begin(), arguments.end(),
                     [](const Argument& a) { return std::holds_alternative<std::size_t>(a); });
}

tmcmc::Marginal ConditionalParameter::given(const Eigen::Ref<const Eigen::VectorXd>& point) const {
  std::vector<double> numbers;
  for (const Argument& argument : arguments) {
    const auto* other = std::get_if<std::size_t>(&argument);
    numbers.push_back(other != nullptr ? point[static_cast<Eigen::Index>(*other)]
                                       : std::get<double>(argument));
  }
  return distribution.make(numbers);
}

tmcmc::Prior hierarchical_prior(std::vector<ConditionalParameter> parameters) {
  const auto d = static_cast<Eigen::Index>(parameters.size());
  tmcmc::OwnPrior own{.description = describe(parameters), .parameters = {}, .log_density = {}, .draw = {}};
  Eigen::VectorXd point = Eigen::VectorXd::Zero(d);
  const tmcmc::StreamKey key{.seed = 1};
  for (tmcmc::Index i = 0; i < trial_draws; ++i) {
    tmcmc::RandomStream stream(key, {.row = static_cast<std::uint64_t>(i)});
    draw(parameters, stream, point);
  }
  for (const auto& parameter : parameters) {
    own.parameters.push_back(
        {parameter.name, parameter.unit, fixed_support(parameter, parameter.given(point))});
  }
  own.log_density = [parameters](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                 Eigen::Ref<Eigen::VectorXd> values) {
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      values[i] = log_density(parameters, points.row(i).transpose());
    }
  };
  own.draw = [parameters](tmcmc::RandomStream& stream, Eigen::Ref<Eigen::VectorXd> drawn) {
    draw(parameters, stream, drawn);
  };
  return tmcmc::Prior(std::move(own));
}

}  // namespace problem
