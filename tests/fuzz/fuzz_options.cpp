// Any words as a command line of replicated_study, up to the point where the work would begin. It
// ends with status 0, or with 2 and one line on standard error; anything else is a mistake.

#include <array>
#include <cstdint>
#include <iostream>

#include "check.hpp"
#include "inputs.hpp"

namespace {

using namespace experiments;

int run(std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  CLI::App app("Command lines.", "replicated_study");
  Report report(app);
  std::string output;
  InputFiles inputs;
  PhysicsOptions physics;
  SamplerOptions sampler;
  RunOptions run_options;
  add_output(app, output, "CSV");
  inputs.add_observations_to(app);
  inputs.add_prior_to(app);
  run_options.add_to(app);
  sampler.add_to(app);
  physics.add_to(app);
  return report.run(static_cast<int>(words.size()), argv.data(), [&] {
    replication::Reading reading = physics.reading();
    sampler.apply(reading);
    const auto options = run_options.study_options();
    require(options.runs >= 1 && options.threads >= 1, "accepted options are in their range", "");
    for (const auto& arm : replication::paper_arms(reading, sampler.cov_target, sampler.ess_fraction)) {
      arm.options.validate();
    }
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> words = {"replicated_study"};
  words.emplace_back();
  for (std::size_t i = 0; i < size && data[i] != 0; ++i) {
    if (data[i] == '\n') {
      words.emplace_back();
    } else {
      words.back() += static_cast<char>(data[i]);
    }
  }
  if (words.back().empty()) words.pop_back();

  // The program's standard error, not the fuzzer's.
  static std::array<char, 1 << 16> said;
  std::FILE* const fuzzer_stderr = stderr;
  stderr = ::fmemopen(said.data(), said.size(), "w");
  std::cout.setstate(std::ios::failbit);
  const int status = run(words);
  std::fflush(stderr);
  const auto end = static_cast<std::size_t>(std::ftell(stderr));
  std::fclose(stderr);
  stderr = fuzzer_stderr;

  const std::string_view message(said.data(), end);
  require(status == 0 || status == 2, "a command line is accepted or refused", message);
  require((status == 0) == message.empty(), "an error, and nothing else, is said on standard error", message);
  if (status == 0) return 0;
  require(message.starts_with("replicated_study: error: "), "an error has the usual form", message);
  require(message.find('\n') == message.size() - 1, "an error is one line", message);
  require_one_line(message.substr(0, message.size() - 1));
  return 0;
}
