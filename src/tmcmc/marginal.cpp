#include "tmcmc/marginal.hpp"

#include <charconv>
#include <utility>

#include "tmcmc/detail/marginal_family.hpp"

namespace tmcmc {

Marginal::Marginal(std::string_view name, std::vector<double> arguments,
                   std::shared_ptr<const detail::MarginalFamily> family)
    : name_(name),
      arguments_(std::move(arguments)),
      support_(family->support()),
      family_(std::move(family)) {}

std::string Marginal::text() const {
  std::string result(name_);
  const char* before = "(";
  for (const double argument : arguments_) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, argument).ptr;
    result.append(before).append(digits, end);
    before = ", ";
  }
  return result.append(")");
}

bool Marginal::portable() const {
  return family_->portable();
}

bool Marginal::has_variance() const {
  return family_->has_variance();
}

double Marginal::log_density(double x) const {
  double sum = 0.0;
  family_->add_log_kernel(&x, 1, &sum);
  return sum + family_->log_constant();
}

double Marginal::cdf(double x) const {
  return x <= support_.lower ? 0.0 : (x >= support_.upper ? 1.0 : family_->cdf(x));
}

double Marginal::complement(double x) const {
  return x <= support_.lower ? 1.0 : (x >= support_.upper ? 0.0 : family_->complement(x));
}

double Marginal::quantile(double p) const {
  if (!(p > 0.0 && p < 1.0)) {
    return p == 0.0 ? support_.lower : (p == 1.0 ? support_.upper : std::numeric_limits<double>::quiet_NaN());
  }
  return std::clamp(family_->quantile(p), support_.lower, support_.upper);
}

double Marginal::normal_score(double x) const {
  return x <= support_.lower   ? -detail::infinity
         : x >= support_.upper ? detail::infinity
                               : family_->normal_score(x);
}

void Marginal::normal_scores(const double* x, std::size_t n, double* scores) const {
  family_->normal_scores(x, n, scores);
}

double Marginal::from_normal(double z) const {
  return std::clamp(family_->from_normal(z), support_.lower, support_.upper);
}

void Marginal::add_log_kernel(const double* x, std::size_t n, double* sum) const {
  family_->add_log_kernel(x, n, sum);
}

double Marginal::log_constant() const {
  return family_->log_constant();
}

}  // namespace tmcmc
