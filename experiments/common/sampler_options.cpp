#include "command_line/sampler_options.hpp"

#include "options.hpp"
#include "tmcmc/option_table.hpp"

namespace experiments {

namespace {

constexpr long recommended_evaluations = 31000;  // those of the published setting

const std::vector<std::string> sampler_names = {"published", "recommended"};

const char* group_of(tmcmc::OptionGroup group) {
  return group == tmcmc::OptionGroup::paper ? "Reading, option by option" : "Sampler beyond the paper";
}

}  // namespace

void SamplerOptions::add_to(CLI::App& app) {
  using enum tmcmc::OptionGroup;
  const auto add = [&](const tmcmc::OptionText& option) {
    const std::string help(option.help);
    if (option.name == "cov_target" ||
        option.name == "ess_fraction") {  // each belongs to one of the samplers compared
      app.add_option(option_of(option.name), option.name == "cov_target" ? cov_target : ess_fraction, help)
          ->transform(check_of(option))
          ->group(group_of(option.group));
    } else {
      app.add_option(option_of(option.name), values[std::string(option.name)], help)
          ->type_name(type_of(option))
          ->transform(check_of(option))
          ->group(group_of(option.group));
    }
  };
  for (const tmcmc::OptionGroup group : {paper, beyond_the_paper}) {
    if (group == beyond_the_paper) {
      add_choice(app, "--sampler", sampler, sampler_names,
                 "Sampler of the reading, or the recommended one; both criteria stay")
          ->group(group_of(group));
    }
    for (const tmcmc::OptionText& option : tmcmc::option_table()) {
      if (option.group == group) {
        add(option);
      }
    }
  }
  app.add_flag("--diagnose", diagnose, "Error of the log-evidence, effective sample sizes, warnings")
      ->group(group_of(beyond_the_paper));
}

std::optional<std::string> SamplerOptions::given(std::string_view name) const {
  const auto found = values.find(name);
  return found == values.end() ? std::nullopt : found->second;
}

void SamplerOptions::apply(replication::Reading& reading) const {
  tmcmc::Options& options = reading.sampler;
  if (sampler == "recommended") {
    const auto evaluations = given("evaluation_budget");
    naming_options(option_of, [&] {
      options = tmcmc::recommended_options(evaluations ? std::stol(*evaluations) : recommended_evaluations);
    });
  }
  options.diagnose = diagnose;
  set_sampler_options(
      options, [this](std::string_view name) { return given(name); }, option_of);
}

}  // namespace experiments
