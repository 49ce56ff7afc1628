#include "storage/settings.hpp"

#include <fmt/format.h>

#include <concepts>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"
#include "tmcmc/option_table.hpp"

namespace storage {

namespace {

template <std::integral Integer>
std::string text(Integer value) {
  return std::to_string(value);
}

std::string text(const Eigen::VectorXd& values) {
  std::string all;
  for (const double value : values) {
    all += all.empty() ? "" : " ";
    all += io::format_number(value);
  }
  return all;
}

}  // namespace

Settings settings(const RunDescription& run) {
  if (run.model.find_first_of("\n\r") != std::string::npos) {
    throw errors::InvalidValue("description of the model", io::printable(run.model), "one line");
  }
  Settings all = tmcmc::sample_settings(run.options);
  const auto& [seed, study, arm, index] = run.key;
  all.emplace_back("seed", text(seed));
  all.emplace_back("study", text(study));
  all.emplace_back("arm", text(arm));
  all.emplace_back("run", text(index));
  all.emplace_back("prior.lower", text(run.prior.lower()));
  all.emplace_back("prior.upper", text(run.prior.upper()));
  if (!run.prior.is_box()) {
    all.emplace_back("prior", run.prior.text());
  }
  all.emplace_back("model", run.model);
  return all;
}

}  // namespace storage
