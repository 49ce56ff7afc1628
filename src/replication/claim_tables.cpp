#include "replication/claim_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/csv.hpp"
#include "replication/claims.hpp"
#include "replication/columns.hpp"

namespace replication {

ClaimTable read_claims(const std::string& path) {
  const auto table = io::CsvTable::read(path);
  ClaimTable claims{table.text("id"), table.text("place"), table.text("claim")};
  require_once(table, claims.ids, "id", "each claim once");
  const auto& known = claim_ids();
  const std::string all = fmt::format("{} to {}", known.front(), known.back());
  const auto holds = [](const std::vector<std::string>& ids, const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  for (std::size_t i = 0; i < claims.ids.size(); ++i) {
    if (!holds(known, claims.ids[i])) {
      table.fail(i, "id", "one of " + all);
    }
  }
  for (const auto& id : known) {
    if (!holds(claims.ids, id)) {
      throw io::InputError(
          fmt::format("{}: column 'id': no row '{}': expected one row for each of {}", path, id, all));
    }
  }
  return claims;
}

RankCorrelation iterations_and_error(const std::string& path, double exact_mean_n) {
  const auto table = io::CsvTable::read(path);
  require_runs_once(table);
  const auto iterations = positive_integers(table, "iterations");
  std::vector<double> errors = table.numbers("mean_friction_force_n");
  if (errors.size() < 3) {
    throw io::InputError(fmt::format("{}: {} rows: expected at least 3 runs", path, errors.size()));
  }
  for (double& mean : errors) {
    mean = std::fabs(mean - exact_mean_n);
  }
  return rank_correlation(std::vector<double>(iterations.begin(), iterations.end()), errors);
}

double median_of_column(const std::string& path, const std::string& column) {
  auto values = positive_numbers(io::CsvTable::read(path), column);
  if (values.empty()) {
    throw io::InputError(path + ": expected at least one row");
  }
  std::sort(values.begin(), values.end());
  return sample_quantile(values, 0.5);
}

}  // namespace replication
