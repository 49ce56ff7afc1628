#include "models/echo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace models {

namespace {

/// The value of one unit in the last digit of a decimal number: 0.01 for 1.25, 1000 for 3e3.
double last_digit_unit(std::string_view number) {
  const std::size_t mantissa_end = std::min(number.find_first_of("eE"), number.size());
  const std::string_view mantissa = number.substr(0, mantissa_end);
  int exponent = 0;
  if (mantissa_end < number.size()) {
    std::string_view digits = number.substr(mantissa_end + 1);
    digits.remove_prefix(digits.starts_with('+') ? 1 : 0);
    std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  }
  const std::size_t point = mantissa.find('.');
  const auto decimals = static_cast<int>(point == mantissa.npos ? 0 : mantissa.size() - point - 1);
  return std::pow(10.0, exponent - decimals);
}

bool agree(double written, double given, std::string_view text) {
  constexpr double single_precision = std::numeric_limits<float>::epsilon();
  const double tolerance = std::max(last_digit_unit(text), single_precision * std::abs(given));
  return std::abs(written - given) <= tolerance * (1.0 + std::numeric_limits<float>::epsilon());
}

}  // namespace

Echo::Echo(const io::CsvTable& table, const std::vector<std::string>& parameter_names) : table_(table) {
  for (std::size_t j = 0; j < parameter_names.size(); ++j) {
    if (table.has(parameter_names[j])) {
      names_.push_back(parameter_names[j]);
      parameters_.push_back(static_cast<Eigen::Index>(j));
    }
  }
}

std::string Echo::mismatch(Eigen::Index row, const Eigen::Ref<const Eigen::VectorXd>& point) const {
  for (std::size_t k = 0; k < names_.size(); ++k) {
    const auto text = table_.cell(static_cast<std::size_t>(row), names_[k]);
    const double given = point[parameters_[k]];
    const auto written = table_.find_number(static_cast<std::size_t>(row), names_[k]);
    if (!written || !agree(*written, given, text)) {
      return fmt::format("wrote {} = {} where the point has {}: expected the rows in the order of the points",
                         names_[k], io::printable(text), io::format_number(given));
    }
  }
  return {};
}

}  // namespace models
