// With one rank a farm is a loop and a shared log-likelihood is the log-likelihood. More ranks: ranks/ranks.sh, which needs
// a build with MPI.

#include <catch2/catch.hpp>
#include <vector>

#include "distributed/share.hpp"
#include "tmcmc/resumable.hpp"

namespace {

using distributed::Farm;
using distributed::lead_or_serve;
using distributed::Ranks;
using problems::few_samples;
using problems::ridge;
using tmcmc::Index;
using tmcmc::SamplingError;

Ranks& ranks() {  // one object a process
  static int argc = 0;
  static char** argv = nullptr;
  static Ranks one(argc, argv);
  return one;
}

std::function<std::optional<std::string>()> count_to(int last) {
  return [last, next = 0]() mutable {
    return next < last ? std::optional(std::to_string(next++)) : std::nullopt;
  };
}

}  // namespace

TEST_CASE("a process that is alone is rank 0 of 1", "[distributed]") {
  CHECK(ranks().rank() == 0);
  CHECK(ranks().size() == 1);
  CHECK_NOTHROW(ranks().wait_until_all_are_ready());
  CHECK(ranks().reports_failure());
}

TEST_CASE("a farm hands out every task and collects in their order", "[distributed]") {
  std::vector<std::string> results;
  lead_or_serve(
      ranks(), [](const std::string& task) { return task + "!"; },
      [&](Farm& farm) {
        farm.run(count_to(3), [&](const std::string& result) { results.push_back(result); });
        farm.run(count_to(0), [&](const std::string& result) { results.push_back(result); });
      });
  CHECK(results == std::vector<std::string>{"0!", "1!", "2!"});
}

TEST_CASE("a task that fails ends the farm after the results before it", "[distributed]") {
  std::vector<std::string> results;
  const auto fails_at_2 = [](const std::string& task) -> std::string {
    if (task == "2") {
      throw SamplingError("task 2");
    }
    return task;
  };
  CHECK_THROWS_AS(lead_or_serve(ranks(), fails_at_2,
                                [&](Farm& farm) {
                                  farm.run(count_to(5),
                                           [&](const std::string& result) { results.push_back(result); });
                                }),
                  SamplingError);
  CHECK(results == std::vector<std::string>{"0", "1"});
}

TEST_CASE("a run with a shared log-likelihood is the run", "[distributed]") {
  for (const int threads : {1, 3}) {
    tmcmc::Options options = few_samples();
    options.threads = threads;
    options.batch_rows = 0;
    tmcmc::Result result;
    distributed::share(ranks(), ridge(), [&](const tmcmc::Problem& shared) {
      result = tmcmc::run(shared, options, {.seed = 5});
    });
    resumable::check_same_bits(result, problems::run_ridge(few_samples()));
  }
}
