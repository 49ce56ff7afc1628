// Time and memory of one run in the published setting over the number of samples, threads and observations. Each
// measurement is a process of its own, so that its peak memory is its own; the best of three counts as time.
// Writes CSV to standard output: sweep, samples, threads, observations, seconds, microseconds per sample and evaluation,
// bytes per sample.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "study/study.hpp"
#include "study/synthetic.hpp"

namespace {

struct Measurement {
  double seconds;
  double evaluations;
  double peak_bytes;
};

friction::Observations repeated(long count) {
  friction::Observations all;
  for (std::uint64_t seed = 1; static_cast<long>(all.size()) < count; ++seed) {
    const auto o = study::generate_observations({}, study::nominal_ratios(), {}, seed);
    for (std::size_t i = 0; i < o.size() && static_cast<long>(all.size()) < count; ++i) {
      all.nominal_ratio.push_back(o.nominal_ratio[i]);
      all.measured_ratio.push_back(o.measured_ratio[i]);
      all.driving_frequency_hz.push_back(o.driving_frequency_hz[i]);
      all.phase_deg.push_back(o.phase_deg[i]);
    }
  }
  return all;
}

Measurement run_once(long samples, int threads, long observations) {
  const study::Reading reading = study::reading(study::ReadingName::as_published);
  const tmcmc::BoxPrior prior(Eigen::Vector4d(0.01, 0.001, 0.001, 0.001),
                              Eigen::Vector4d(10.0, 10.0, 10.0, 1.0));
  const auto problem = study::problem(reading, repeated(observations), prior);
  auto options = study::paper_arms(reading)[0].options;
  options.samples = samples;
  options.threads = threads;
  options.batch_rows = 2048;
  const auto start = std::chrono::steady_clock::now();
  const auto result = tmcmc::run(problem, options, {.seed = 1});
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {elapsed.count(), static_cast<double>(result.final.evaluations),
          1024.0 * static_cast<double>(usage.ru_maxrss)};
}

Measurement in_child(long samples, int threads, long observations) {
  int channel[2];
  if (pipe(channel) != 0) {
    std::abort();
  }
  const pid_t child = fork();
  if (child == 0) {
    const Measurement m = run_once(samples, threads, observations);
    const bool written = write(channel[1], &m, sizeof m) == static_cast<ssize_t>(sizeof m);
    _exit(written ? 0 : 1);
  }
  close(channel[1]);
  Measurement m{};
  const bool read_all = read(channel[0], &m, sizeof m) == static_cast<ssize_t>(sizeof m);
  close(channel[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!read_all || status != 0) {
    std::fprintf(stderr, "scaling: a measurement failed\n");
    std::exit(1);
  }
  return m;
}

void measure(const char* sweep, long samples, int threads, long observations, double base_bytes) {
  Measurement best = in_child(samples, threads, observations);
  for (int repeat = 0; repeat < 2; ++repeat) {
    const Measurement again = in_child(samples, threads, observations);
    best.seconds = std::min(best.seconds, again.seconds);
  }
  std::printf("%s,%ld,%d,%ld,%.6g,%.4g,%.4g\n", sweep, samples, threads, observations, best.seconds,
              1e6 * best.seconds / best.evaluations,
              (best.peak_bytes - base_bytes) / static_cast<double>(samples));
  std::fflush(stdout);
}

}  // namespace

int main() {
  std::printf("sweep,samples,threads,observations,seconds,microseconds_per_evaluation,bytes_per_sample\n");
  const double base = in_child(64, 1, 10).peak_bytes;
  for (const long samples : {1000L, 3162L, 10000L, 31623L, 100000L, 316228L, 1000000L}) {
    measure("samples", samples, 1, 10, base);
  }
  for (const int threads : {1, 2, 4}) {
    measure("threads", 100000, threads, 10, base);
  }
  for (const long observations : {1L, 3L, 10L, 30L, 100L, 300L, 1000L}) {
    measure("observations", 10000, 1, observations, base);
  }
}
