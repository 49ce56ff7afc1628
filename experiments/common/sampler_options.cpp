#include "errors/invalid_value.hpp"
#include "names/names.hpp"
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

std::string option_of(std::string_view name) {
  std::string option = "--" + std::string(name);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

std::string type_of(const tmcmc::OptionText& option) {
  if (!option.values.empty()) {
    return fmt::format("{}", fmt::join(option.values, "|"));
  }
  return option.range.whole ? "INT" : "FLOAT";
}

CLI::Validator check_of(const tmcmc::OptionText& option) {
  return normalising(
      [name = option.name](const std::string& word) { return tmcmc::normalised_option(name, word); },
      option.expected);
}

namespace {

[[noreturn]] void refuse(const OptionPlace& place, std::string_view name, std::string_view value,
                         const std::string& expected) {
  throw errors::InvalidValue(fmt::format("{}: value '{}'", place(name), value), "", expected);
}

/// Calls, and names an option of the sampler that is refused by its place.
template <class Call>
void naming_options(const OptionPlace& place, Call call) {
  try {
    call();
  } catch (const errors::InvalidValue& invalid) {
    constexpr std::string_view of_options = "options.";
    if (!invalid.field().starts_with(of_options)) {
      throw;
    }
    refuse(place, std::string_view(invalid.field()).substr(of_options.size()), invalid.value(),
           invalid.expected());
  }
}

}  // namespace

void set_sampler_options(tmcmc::Options& options, const GivenOption& given, const OptionPlace& place) {
  naming_options(place, [&] {
    for (const tmcmc::OptionText& option : tmcmc::option_table()) {
      const auto value = given(option.name);
      if (value && !tmcmc::option_value(options, option.name)) {  // it would change nothing: a mistake
        refuse(place, option.name, *value,
               fmt::format("only with {}{}{}", option_of(option.needs_option),
                           option.needs_value.empty() ? "" : " ", option.needs_value));
      }
      if (value) {
        tmcmc::set_option(options, option.name, *value);
      }
    }
    options.validate();
  });
}

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
