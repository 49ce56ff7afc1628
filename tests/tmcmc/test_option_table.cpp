// The options as text: one table for command lines, checkpoints and documentation.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <string>

#include "data/directories.hpp"
#include "errors/invalid_value.hpp"
#include "tmcmc/option_table.hpp"

using Catch::Matchers::Contains;
using tmcmc::normalised_option;
using tmcmc::option_table;
using tmcmc::option_value;
using tmcmc::OptionGroup;
using tmcmc::Options;
using tmcmc::OptionText;
using tmcmc::set_option;

namespace {

/// Converts to any member of an aggregate.
struct Any {
  template <class T>
  operator T() const;  // NOLINT
};

/// Number of members of an aggregate.
template <class T, class... Given>
consteval std::size_t members() {
  if constexpr (requires { T{Given{}..., Any{}}; }) {
    return members<T, Given..., Any>();
  } else {
    return sizeof...(Given);
  }
}

template <class>
constexpr std::size_t members_of_alternatives = 0;
template <class... Alternatives>
constexpr std::size_t members_of_alternatives<std::variant<Alternatives...>> = (members<Alternatives>() +
                                                                                ...);

/// Options with every argument of every alternative in use, one after the other.
std::vector<Options> every_alternative() {
  std::vector<Options> all(1);
  all.back().criterion = tmcmc::effective_sample_size_rule();
  all.back().move = tmcmc::ResampleMove{.mixing_correlation = 0.5};
  all.back().scale_rule = tmcmc::TargetAcceptance{};
  all.emplace_back().move = tmcmc::WasteFree{};
  all.back().proposal = tmcmc::RedrawnWalk{};
  all.back().finish = tmcmc::IndependentDraws{.fit = {.degrees_of_freedom = 10}};
  all.emplace_back();
  return all;
}

std::string range_of(const OptionText& option) {
  std::string text = option.expected;
  const std::string words = "a whole number ";
  return text.starts_with(words) ? text.substr(words.size()) : text;
}

std::string with_hyphens(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

std::string markdown() {
  const Options recommended = tmcmc::recommended_options();
  std::ostringstream text;
  text << "| option | values | default | recommended | |\n|---|---|---|---|---|\n";
  for (const OptionText& option : option_table()) {
    if (option.group == OptionGroup::computation) {
      continue;
    }
    text << "| `--" << with_hyphens(option.name) << "` | " << range_of(option) << " | " << option.preset
         << " | " << option_value(recommended, option.name).value_or("") << " | " << option.help;
    if (!option.needs_option.empty() && option.needs_option != "criterion") {  // which the sampler decides
      text << "; with `--" << with_hyphens(option.needs_option) << (option.needs_value.empty() ? "" : " ")
           << option.needs_value << "`";
    }
    text << " |\n";
  }
  return text.str();
}

}  // namespace

TEST_CASE("every member of the options has its row", "[tmcmc][options]") {
  // criterion has two further members, a mixture fit has its own; move, scale_rule, proposal,
  // finish and criterion.rule are rows, as are their members.
  const std::size_t expected =
      members<Options>() - 1 + members<tmcmc::Criterion>() +
      members_of_alternatives<decltype(tmcmc::Criterion::rule)> + members_of_alternatives<tmcmc::Move> +
      members_of_alternatives<tmcmc::ScaleRule> + members_of_alternatives<tmcmc::Proposal> +
      members_of_alternatives<tmcmc::Finish> - 1 + members<tmcmc::MixtureFitOptions>();
  CHECK(option_table().size() == expected);
  std::set<std::string_view> names;
  for (const OptionText& option : option_table()) {
    CAPTURE(option.name);
    CHECK(names.insert(option.name).second);
    CHECK(!option.help.empty());
    CHECK(!option.expected.empty());
    CHECK(!option.preset.empty());
    CHECK((option.needs_option.empty() || names.count(option.needs_option) == 1));  // which is set before it
  }
}

TEST_CASE("the value of every option is read back as it was written", "[tmcmc][options]") {
  std::set<std::string_view> seen;
  for (const Options& options : every_alternative()) {
    Options copy;
    for (const OptionText& option : option_table()) {
      CAPTURE(option.name);
      if (const auto value = option_value(options, option.name)) {
        seen.insert(option.name);
        REQUIRE_NOTHROW(set_option(copy, option.name, *value));
        CHECK(option_value(copy, option.name) == value);
        CHECK(normalised_option(option.name, *value) == value);
      } else {
        CHECK(!option.needs_option.empty());
        CHECK_THROWS_WITH(set_option(copy, option.name, option.values.empty() ? "1" : option.values.front()),
                          Contains("expected only with " + std::string(option.needs_option)));
      }
    }
  }
  CHECK(seen.size() == option_table().size());
}

TEST_CASE("numbers are taken in any notation, within their range alone", "[tmcmc][options]") {
  CHECK(normalised_option("samples", "1e3") == "1000");
  CHECK(normalised_option("samples", "0200") == "200");
  CHECK(normalised_option("minimum_step", ".50") == "0.5");
  CHECK(normalised_option("infeasible_level", "-inf") == "-inf");
  CHECK(normalised_option("max_stages", "1000000000") == "1000000000");
  CHECK(normalised_option("ess_fraction", "1") == "1");
  for (const auto& [name, bad] : {std::pair{"samples", "1"},
                                  {"samples", "2.5"},
                                  {"samples", "1e10"},
                                  {"samples", ""},
                                  {"samples", "7 "},
                                  {"minimum_step", "1"},
                                  {"minimum_step", "-1e-9"},
                                  {"minimum_step", "nan"},
                                  {"infeasible_level", "nan"},
                                  {"ess_fraction", "0"},
                                  {"target_acceptance", "1"},
                                  {"proposal_scale", "inf"},
                                  {"move", "waste_free"},
                                  {"cross_fit", "true"},
                                  {"counted", ""}}) {
    CAPTURE(name, bad);
    CHECK_FALSE(normalised_option(name, bad).has_value());
  }
}

TEST_CASE("another alternative begins with its defaults; the same one keeps what it has",
          "[tmcmc][options]") {
  Options options = tmcmc::recommended_options();
  set_option(options, "move", "waste-free");
  CHECK(option_value(options, "chains") == "10");
  set_option(options, "move", "resample-move");
  CHECK(option_value(options, "chains") == std::nullopt);
  set_option(options, "move", "waste-free");
  CHECK(option_value(options, "chains") == "50");
}

TEST_CASE("what is refused carries option, value and expectation", "[tmcmc][options]") {
  Options options;
  try {
    set_option(options, "move", "waste");
    FAIL("accepted");
  } catch (const errors::InvalidValue& error) {
    CHECK(error.field() == "options.move");
    CHECK(error.value() == "waste");
    CHECK(error.expected() == "resample-move, growing-chains or waste-free");
  }
  CHECK_THROWS_AS(set_option(options, "moves", "1"), errors::InvalidValue);
  CHECK_THROWS_AS(option_value(options, ""), errors::InvalidValue);
  CHECK_THROWS_AS(normalised_option("Samples", "1"), errors::InvalidValue);
}

TEST_CASE("docs/options.md holds the table of the options", "[tmcmc][options]") {
  std::ifstream file(test_data::source_directory() + "/docs/options.md");
  REQUIRE(file);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  INFO("build/release/bin/test_tmcmc '[print-options]' prints the table of now");
  CHECK_THAT(text, Contains(markdown()));
}

TEST_CASE("prints the table of docs/options.md", "[.][print-options]") {
  std::cout << markdown();
}
