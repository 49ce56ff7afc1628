#include "replication/columns.hpp"

#include <utility>

namespace replication {

std::vector<double> positive_numbers(const io::CsvTable& table, std::string_view column) {
  return checked(
      table, column, table.numbers(column), [](double x) { return x > 0.0; }, "a positive number");
}

std::vector<double> nonnegative_numbers(const io::CsvTable& table, std::string_view column) {
  return checked(
      table, column, table.numbers(column), [](double x) { return x >= 0.0; }, "a number of at least 0");
}

std::vector<long> positive_integers(const io::CsvTable& table, std::string_view column) {
  return checked(
      table, column, table.integers(column), [](long n) { return n >= 1; }, "a whole number of at least 1");
}

void require_runs_once(const io::CsvTable& table) {
  const auto samplers = table.text("sampler");
  const auto runs = table.integers("run");
  std::vector<std::pair<std::string_view, long>> keys;
  for (std::size_t row = 0; row < runs.size(); ++row) {
    keys.emplace_back(samplers[row], runs[row]);
  }
  require_once(table, keys, "run", "each run once a sampler");
}

}  // namespace replication
