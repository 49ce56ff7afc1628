// Options of the sampler, set from texts: what is refused is named by the place where it was given.

#include <catch2/catch.hpp>
#include <map>

#include "command_line/sampler_options.hpp"
#include "errors/invalid_value.hpp"

using namespace command_line;
using Catch::Matchers::Contains;

namespace {

using Texts = std::map<std::string, std::string, std::less<>>;

/// The options with these texts set.
tmcmc::Options with(const Texts& texts) {
  tmcmc::Options options;
  set_sampler_options(
      options,
      [&](std::string_view name) {
        const auto found = texts.find(name);
        return found == texts.end() ? std::nullopt : std::optional(found->second);
      },
      option_of);
  return options;
}

/// The complaint about these texts.
std::string refusal(const Texts& texts) {
  try {
    std::ignore = with(texts);
  } catch (const errors::InvalidValue& invalid) {
    return invalid.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("every option of the sampler has an option of the command line and a check", "[command_line]") {
  CHECK(option_of("move_steps") == "--move-steps");
  for (const tmcmc::OptionText& option : tmcmc::option_table()) {
    INFO(option.name);
    CHECK_THAT(option_of(option.name), Catch::Matchers::StartsWith("--"));
    CHECK(option_of(option.name).find('_') == std::string::npos);
    CHECK_FALSE(type_of(option).empty());
    std::string nonsense = "no such value";
    CHECK_THAT(check_of(option)(nonsense), Contains("value 'no such value': expected "));
  }
}

TEST_CASE("texts set the options, in any order of the texts", "[command_line]") {
  CHECK(with({{"samples", "123"}}).samples == 123);
  CHECK(std::get<tmcmc::ResampleMove>(with({{"move", "resample-move"}, {"move_steps", "7"}}).move).steps ==
        7);
  CHECK(with({}).samples == tmcmc::Options().samples);
}

TEST_CASE("an option that would change nothing, or that is out of range, is named as it was given",
          "[command_line]") {
  CHECK_THAT(refusal({{"move", "waste-free"}, {"move_steps", "7"}}),
             Contains("--move-steps: value '7'") && Contains("only with --move resample"));
  CHECK_THAT(refusal({{"samples", "-5"}}), Contains("--samples") && Contains("-5"));
}

TEST_CASE("what is no option of the sampler is passed on", "[command_line]") {
  CHECK_THROWS_WITH(naming_options(option_of, [] { throw errors::InvalidValue("prior", 1, "another"); }),
                    Contains("prior") && !Contains("--prior"));
}
