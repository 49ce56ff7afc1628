// How time and memory grow: one run over the number of samples N, over threads and over the number of observations, and
// the paper's study (50 runs of each sampler) over threads.
//
// Data: synthetic, from Eqs. 22 and 23 with the stated parameters; prior of Table 2 (Lye and Marino, ESREL 2023).

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>

#include "inputs.hpp"
#include "io/interrupt.hpp"
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

struct Measurement {
  double seconds = std::numeric_limits<double>::infinity();
  long stages = 0;
  long evaluations = 0;
  double peak_bytes = 0.0;
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

/// Repeats the work for a tenth of a second, at least once; the shortest time counts.
Measurement work_on(const Setting& s) {
  using Clock = std::chrono::steady_clock;
  const auto reading = replication::reading(replication::ReadingName::as_published);
  const auto problem =
      replication::problem(reading, synthetic_observations(s.observations), prior_for({}, reading));
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
  for (const auto begin = Clock::now(); Clock::now() - begin < std::chrono::milliseconds(100);) {
    result.stages = result.evaluations = 0;
    const auto start = Clock::now();
    if (s.runs == 1) {
      count(tmcmc::run(problem, arms[0].options, {.seed = 1}));
    } else {
      const replication::StudyOptions options{.runs = s.runs / std::ssize(arms), .threads = s.threads};
      for (std::uint32_t a = 0; a < arms.size(); ++a) {
        const auto runs = replication::run_arm(problem, arms[a], a, options);
        static_cast<void>(replication::pbox_areas(runs, options.threads));
        for (const auto& run : runs) {
          count(run.result);
        }
      }
    }
    result.seconds = std::min(result.seconds, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return result;
}

/// In a process of its own, whose peak memory is that of the work. This process must not have started a thread.
Measurement measure(const Setting& setting) {
  int channel[2];
  if (pipe(channel) != 0) {
    throw std::runtime_error("scaling: no pipe to a process of its own");
  }
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {
      _exit(1);
    }
    try {
      const Measurement m = work_on(setting);
      _exit(write(channel[1], &m, sizeof m) == static_cast<ssize_t>(sizeof m) ? 0 : 1);
    } catch (...) {
      _exit(1);
    }
  }
  close(channel[1]);
  Measurement m;
  const bool complete = child > 0 && read(channel[0], &m, sizeof m) == static_cast<ssize_t>(sizeof m);
  close(channel[0]);
  rusage usage{};
  int status = 0;
  if (child > 0) {
    if (!complete) {  // an interrupt broke off the read
      kill(child, SIGKILL);
    }
    wait4(child, &status, 0, &usage);
  }
  io::stop_if_interrupted();
  if (!complete || status != 0) {
    throw std::runtime_error(
        fmt::format("the measurement of {} samples on {} threads failed", setting.samples, setting.threads));
  }
  m.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  return m;
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
  Program program("scaling", "Time and memory over samples, threads and observations, on this machine.");
  long most_samples = 1000000, repetitions = 5;
  int most_threads = 0;
  program.add_output(
      "CSV, one row a setting: stages and evaluations, best time, peak memory beyond that of 64 samples");
  program.add_number("--most-samples", most_samples, count(100, 1000000),
                     "Settings with more samples are left out");
  program.add_number("--most-threads", most_threads, count(0, 4096),
                     "Most threads; 0: as many as the machine has");
  program.add_number("--repetitions", repetitions, count(1, 1000000), "Rounds over all settings");

  return program.run(argc, argv, [&] {
    const RunOptions machine{.threads = most_threads};
    const auto all = settings(most_samples, machine.study_options().threads);
    auto csv = open_csv(program.output(), {"sweep", "runs", "samples", "threads", "observations", "stages",
                                           "evaluations", "seconds", "microseconds_per_sample",
                                           "nanoseconds_per_evaluation", "memory_bytes", "speedup"});
    const double base = measure({"base", 1, 64, 1, 10}).peak_bytes;
    std::vector<Measurement> best(all.size());
    io::Progress progress("scaling", all.size() * static_cast<std::size_t>(repetitions), !program.quiet());
    // Round by round, so that a disturbance does not hit one setting alone.
    for (long round = 0; round < repetitions; ++round) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto m = measure(all[i]);
        const double peak_bytes = std::max(best[i].peak_bytes, m.peak_bytes);
        best[i] = m.seconds < best[i].seconds ? m : best[i];
        best[i].peak_bytes = peak_bytes;
        progress.advance();
      }
    }
    program.report("{:<13} {:>8} {:>8} {:>13} {:>10} {:>14} {:>17} {:>10} {:>8}\n", "sweep", "samples",
                   "threads", "observations", "seconds", "us per sample", "ns per evaluation", "MB",
                   "speed-up");
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Setting& s = all[i];
      const Measurement& m = best[i];
      const double per_sample = 1e6 * m.seconds / static_cast<double>(s.runs * s.samples);
      const double per_evaluation = 1e9 * m.seconds / static_cast<double>(m.evaluations);
      const double memory = std::max(0.0, m.peak_bytes - base);
      const auto alone = std::find_if(all.begin(), all.end(), [&](const Setting& other) {
        return other.sweep == s.sweep && other.samples == s.samples && other.observations == s.observations;
      });
      const double speedup = best[static_cast<std::size_t>(alone - all.begin())].seconds / m.seconds;
      program.report("{:<13} {:>8} {:>8} {:>13} {:>10.4f} {:>14.3f} {:>17.1f} {:>10.2f} {:>8.2f}\n", s.sweep,
                     s.samples, s.threads, s.observations, m.seconds, per_sample, per_evaluation,
                     1e-6 * memory, speedup);
      if (csv) {
        csv->row(s.sweep, s.runs, s.samples, s.threads, s.observations, m.stages, m.evaluations, m.seconds,
                 per_sample, per_evaluation, memory, speedup);
      }
    }
    io::commit_all(csv);
  });
}
