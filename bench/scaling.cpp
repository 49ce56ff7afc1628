// How time and memory grow: one run over the number of samples N, over threads and over the number
// of observations, and the paper's study (50 runs of each sampler) over threads.
//
// Data: synthetic, from Eqs. 22 and 23 with the stated parameters; prior of Table 2 (Lye and
// Marino, ESREL 2023).

#include <algorithm>
#include <cmath>

#include "inputs.hpp"
#include "measure.hpp"
#include "replication/synthetic.hpp"

using namespace experiments;

namespace {

struct Setting {
  std::string sweep;
  long runs;  // 1, or the runs of a study
  long samples;
  int threads;
  long observations;
};

/// Best of several repetitions.
struct Measurement {
  Cost cost{std::numeric_limits<double>::infinity(), 0.0};
  long stages = 0;
  long evaluations = 0;
};

/// The frequency ratios of Table 1 over and over.
friction::Observations synthetic_observations(long count) {
  std::vector<double> ratios;
  for (long i = 0; i < count; ++i) {
    ratios.push_back(
        replication::nominal_ratios()[static_cast<std::size_t>(i) % replication::nominal_ratios().size()]);
  }
  return replication::generate_observations({}, ratios, {}, 1);
}

Measurement measure(const Setting& s) {
  const auto reading = replication::reading(replication::ReadingName::as_published);
  const auto problem = interruptible(replication::problem(reading, synthetic_observations(s.observations),
                                                          prior_for(InputFiles(), reading)));
  auto arms = replication::paper_arms(reading);
  for (auto& arm : arms) {
    arm.options.samples = s.samples;
    arm.options.threads = s.runs == 1 ? s.threads : 1;
  }
  Measurement result;
  const auto count = [&result](const tmcmc::Result& run) {
    result.stages += std::ssize(run.stages);
    result.evaluations += run.final.evaluations;
  };
  result.cost = cost_of([&] {
    result.stages = result.evaluations = 0;
    if (s.runs == 1) {
      return count(tmcmc::run(problem, arms[0].options, {.seed = 1}));
    }
    const replication::StudyOptions options{.runs = s.runs / std::ssize(arms), .threads = s.threads};
    for (std::uint32_t a = 0; a < arms.size(); ++a) {
      const auto runs = replication::run_arm(problem, arms[a], a, options);
      static_cast<void>(replication::pbox_areas(runs, options.threads));
      for (const auto& run : runs) {
        count(run.result);
      }
    }
  });
  return result;
}

std::vector<Setting> settings(long most_samples, int most_threads) {
  std::vector<Setting> all;
  for (const long samples : {1000L, 3162L, 10000L, 31623L, 100000L, 316228L, 1000000L}) {
    if (samples <= most_samples) {
      all.push_back({"samples", 1, samples, 1, 10});
    }
  }
  for (int threads = 1; threads <= most_threads; ++threads) {
    all.push_back({"threads", 1, std::min(100000L, most_samples), threads, 10});
  }
  for (int threads = 1; threads <= most_threads; ++threads) {
    all.push_back({"study", 100, std::min(1000L, most_samples), threads, 10});
  }
  for (const long observations : {1L, 3L, 10L, 30L, 100L, 300L, 1000L}) {
    all.push_back({"observations", 1, std::min(10000L, most_samples), 1, observations});
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Time and memory over samples, threads and observations, on this machine.", "scaling");
  Report report(app);
  std::string output;
  long most_samples = 1000000, repetitions = 5;
  int most_threads = 0;
  add_output(app, output,
             "CSV, one row for each setting: stages and evaluations, best time, peak memory beyond what was "
             "in use before");
  app.add_option("--most-samples", most_samples, "Settings with more samples are left out")
      ->transform(count(100, 1000000));
  app.add_option("--most-threads", most_threads, "Most threads; 0: as many as the machine has")
      ->transform(count(0, 4096));
  app.add_option("--repetitions", repetitions, "Rounds over all settings")->transform(count(1, 1000000));

  return report.run(argc, argv, [&] {
    const RunOptions machine{.threads = most_threads};
    const auto all = settings(most_samples, machine.study_options().threads);
    auto csv = open_csv(
        output, {"sweep", "runs", "samples", "threads", "observations", "stages", "evaluations", "seconds",
                 "microseconds_per_sample", "nanoseconds_per_evaluation", "memory_bytes", "speedup"});
    std::vector<Measurement> best(all.size());
    io::Progress progress("scaling", all.size() * static_cast<std::size_t>(repetitions), !report.quiet());
    // Round by round, so that a disturbance does not hit one setting alone.
    for (long round = 0; round < repetitions; ++round) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto m = measure(all[i]);
        const double peak_bytes = std::max(best[i].cost.peak_bytes, m.cost.peak_bytes);
        best[i] = m.cost.seconds < best[i].cost.seconds ? m : best[i];
        best[i].cost.peak_bytes = peak_bytes;
        progress.advance();
      }
    }
    report("{:<13} {:>8} {:>8} {:>13} {:>10} {:>14} {:>17} {:>10} {:>8}\n", "sweep", "samples", "threads",
           "observations", "seconds", "us per sample", "ns per evaluation", "MB", "speed-up");
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Setting& s = all[i];
      const Measurement& m = best[i];
      const double per_sample = 1e6 * m.cost.seconds / static_cast<double>(s.runs * s.samples);
      const double per_evaluation = 1e9 * m.cost.seconds / static_cast<double>(m.evaluations);
      const auto alone = std::find_if(all.begin(), all.end(), [&](const Setting& other) {
        return other.sweep == s.sweep && other.samples == s.samples && other.observations == s.observations;
      });
      const double speedup =
          best[static_cast<std::size_t>(alone - all.begin())].cost.seconds / m.cost.seconds;
      report("{:<13} {:>8} {:>8} {:>13} {:>10.4f} {:>14.3f} {:>17.1f} {:>10.2f} {:>8.2f}\n", s.sweep,
             s.samples, s.threads, s.observations, m.cost.seconds, per_sample, per_evaluation,
             1e-6 * m.cost.peak_bytes, speedup);
      csv.row(s.sweep, s.runs, s.samples, s.threads, s.observations, m.stages, m.evaluations, m.cost.seconds,
              per_sample, per_evaluation, m.cost.peak_bytes, speedup);
    }
    io::commit_all(csv);
  });
}
