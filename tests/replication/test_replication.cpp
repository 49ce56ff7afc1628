#include <catch2/catch.hpp>
#include <limits>

#include "friction_study.hpp"
#include "replication/published.hpp"
#include "replication/replication.hpp"

using namespace replication;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

/// An asymmetric two-dimensional target that takes several stages.
tmcmc::Problem target() {
  const auto log_likelihood = [](const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::VectorXd> l) {
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      const double a = (x(i, 0) - 1.0) / 0.05;
      const double b = (x(i, 1) - x(i, 0)) / 0.2;
      l[i] = -0.5 * (a * a + b * b);
    }
  };
  return {log_likelihood, tmcmc::BoxPrior(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(10.0, 10.0))};
}

std::vector<Arm> arms(double ess_fraction, tmcmc::Index samples = 200) {
  Reading r = reading(ReadingName::corrected);
  r.sampler.samples = samples;
  return paper_arms(r, 1.0, ess_fraction);
}

StudyOptions small(std::uint32_t number, int threads = 1) {
  StudyOptions options;
  options.runs = 8;
  options.study = number;
  options.threads = threads;
  return options;
}

}  // namespace

TEST_CASE("iteration counts as text", "[replication]") {
  const std::map<tmcmc::Index, tmcmc::Index> counts = {{9, 2}, {10, 45}, {11, 3}};
  CHECK(format_iterations(counts) == "9:2 10:45 11:3");
  CHECK(parse_iterations("9:2 10:45 11:3") == counts);
  CHECK(parse_iterations("9:1000000").at(9) == 1000000);
  CHECK(parse_iterations("7:50") == std::map<tmcmc::Index, tmcmc::Index>{{7, 50}});
  for (const char* bad : {"", "9", "9:", "9:2  10:1", "9:2,10:1", "9:2 9:3", "a:1", "9:-2", "9:2x", "0:1",
                          "9:0", "9:1000001", "9:9000000000000000000"}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH(parse_iterations(bad), Contains("10:45"));
  }
}

TEST_CASE("a study is a function of its number, not of threads or order", "[replication]") {
  const auto problem = target();
  const auto first = run_study(problem, arms(0.5), small(3));
  CHECK(first == run_study(problem, arms(0.5), small(3, 2)));
  CHECK(first == run_study(problem, arms(0.5), small(3, 3)));
  CHECK_FALSE(first == run_study(problem, arms(0.5), small(4)));
  REQUIRE(first.size() == 2);
  CHECK(first[0].sampler == "TMCMC");
  CHECK(first[1].sampler == "TMCMC-II");
  CHECK(first[0].study == 3);
}

TEST_CASE("the key of a study names each number that it depends on", "[replication]") {
  const auto key_of = [](const Reading& reading, StudyOptions options, friction::Observations observations) {
    return study_key(reading, paper_arms(reading), options, observations, test_data::table2(reading));
  };
  const auto published = reading(ReadingName::as_published);
  const auto key = key_of(published, {}, test_data::table1());
  CHECK(key == key_of(published, {.study = 7, .threads = 3}, test_data::table1()));
  CHECK(key.find('\n') == std::string::npos);
  CHECK(key != key_of(published, {.seed = 2}, test_data::table1()));
  CHECK(key != key_of(published, {.runs = 49}, test_data::table1()));
  CHECK(key != key_of(reading(ReadingName::corrected), {}, test_data::table1()));
  auto rig = published;
  rig.physics.driving_force_n = 2.4;
  CHECK(key != key_of(rig, {}, test_data::table1()));
  auto other = test_data::table1();
  other.phase_deg[9] += 1e-9;
  CHECK(key != key_of(published, {}, other));
}

TEST_CASE("a summary holds what the runs say", "[replication]") {
  const auto problem = target();
  const auto options = small(0);
  const auto runs = run_arm(problem, arms(0.5)[0], 0, options);
  const auto summary = summarise(0, "TMCMC", runs);
  const Eigen::VectorXd areas = pbox_areas(runs);
  double mean = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& run : runs) {
    mean += run.mean[1] / static_cast<double>(runs.size());
    smallest = std::min(smallest, run.result.final.points.col(1).minCoeff());
  }
  CHECK(summary.areas[1] == areas[1]);
  CHECK_THAT(summary.means[1], WithinAbs(mean, 1e-12));
  CHECK(summary.smallest[1] == smallest);
  tmcmc::Index total = 0;
  for (const auto& [iterations, count] : summary.iterations) {
    total += count;
  }
  CHECK(total == options.runs);
}

TEST_CASE("a criterion that really differs is told apart by the same machinery", "[replication]") {
  const auto problem = target();
  const auto replicate = [&](double ess_fraction) {
    std::vector<StudySummary> studies;
    for (std::uint32_t k = 0; k < 30; ++k) {
      for (auto& s : run_study(problem, arms(ess_fraction), small(k))) {
        studies.push_back(std::move(s));
      }
    }
    return studies;
  };
  const Counts printed = {{4, 8}};
  const auto half_studies = replicate(0.5);
  const auto quarter_studies = replicate(0.25);
  const auto same =
      contrast_iterations(half_studies, printed, printed, "TMCMC", "TMCMC-II", {.tables = 1000});
  CHECK_THAT(same.replicated.ratio, WithinAbs(1.0, iteration_margin + 0.02));  // few studies
  CHECK_FALSE(same.replicated.different);
  const auto quarter =
      contrast_iterations(quarter_studies, printed, printed, "TMCMC", "TMCMC-II", {.tables = 1000});
  CHECK(quarter.replicated.different);
  CHECK(quarter.replicated.ratio < 0.9);
  CHECK(null_of(quarter_studies, "TMCMC", "TMCMC-II", 1) == Null::own_studies);
}
