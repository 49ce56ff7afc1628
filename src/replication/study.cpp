#include "replication/study.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "errors/invalid_value.hpp"
#include "tmcmc/diagnostics.hpp"
#include "tmcmc/parallel.hpp"

namespace replication {

namespace {

std::string name_run(const Arm& arm, tmcmc::Index index) {
  return arm.name + ", run " + std::to_string(index) + ": ";
}

}  // namespace

void StudyOptions::validate() const {
  if (runs < 1) {
    throw errors::InvalidValue("runs", runs, "at least 1");
  }
  if (threads < 1) {
    throw errors::InvalidValue("threads", threads, "at least 1");
  }
}

Run run_one(const tmcmc::Problem& problem, const Arm& arm, std::uint32_t arm_index,
            const StudyOptions& options, tmcmc::Index index, const tmcmc::Observer& observer) {
  Run run;
  const tmcmc::StreamKey key{options.seed, options.study, arm_index, static_cast<std::uint32_t>(index)};
  try {
    run.result = tmcmc::run(problem, arm.options, key, observer);
    if (run.result.stop != tmcmc::StopReason::completed) {
      throw tmcmc::SamplingError("ended at beta = " + std::to_string(run.result.final.beta) + " after " +
                                 std::to_string(run.iterations()) +
                                 " stages: " + tmcmc::describe(run.result.stop));
    }
  } catch (const tmcmc::InfeasiblePriorError& error) {
    throw tmcmc::InfeasiblePriorError(name_run(arm, index) + error.what());
  } catch (const tmcmc::SamplingError& error) {
    throw tmcmc::SamplingError(name_run(arm, index) + error.what());
  }
  const auto& points = run.result.final.points;
  run.mean.resize(points.cols());
  run.standard_deviation.resize(points.cols());
  for (tmcmc::Index j = 0; j < points.cols(); ++j) {
    const Moments m = moments({points.col(j).data(), static_cast<std::size_t>(points.rows())},
                              tmcmc::as_span(run.result.weights));
    run.mean[j] = m.mean;
    run.standard_deviation[j] = m.standard_deviation;
  }
  return run;
}

std::vector<Run> run_arm(const tmcmc::Problem& problem, const Arm& arm, std::uint32_t arm_index,
                         const StudyOptions& options, const RunObserver& observer) {
  options.validate();
  arm.options.validate();
  std::vector<Run> runs(static_cast<std::size_t>(options.runs));
  tmcmc::for_each_block(
      options.runs, 1, options.threads, [&](tmcmc::Index index, tmcmc::Index, tmcmc::Index) {
        runs[static_cast<std::size_t>(index)] = run_one(problem, arm, arm_index, options, index);
        if (observer) {
          observer();
        }
      });
  return runs;
}

std::vector<pbox::Ecdf> ecdfs_of(const std::vector<Run>& runs, tmcmc::Index parameter) {
  std::vector<pbox::Ecdf> ecdfs;
  ecdfs.reserve(runs.size());
  for (const Run& run : runs) {
    const auto column = run.result.final.points.col(parameter);
    ecdfs.emplace_back(std::vector<double>(column.begin(), column.end()), tmcmc::as_span(run.result.weights));
  }
  return ecdfs;
}

Eigen::VectorXd pbox_areas(const std::vector<Run>& runs, int threads) {
  if (runs.empty()) {
    throw errors::InvalidValue("runs", "", "at least one");
  }
  const tmcmc::Index d = runs.front().result.final.points.cols();
  Eigen::VectorXd areas(d);
  tmcmc::for_each_block(d, 1, threads, [&](tmcmc::Index j, tmcmc::Index, tmcmc::Index) {
    areas[j] = pbox::area_metric(ecdfs_of(runs, j));
  });
  return areas;
}

statistics::EstimateError error_over_runs(const std::vector<Run>& runs,
                                          const std::function<double(const Run&)>& number, double exact) {
  std::vector<double> estimates;
  std::transform(runs.begin(), runs.end(), std::back_inserter(estimates), number);
  return statistics::error_of(estimates, exact);
}

std::map<tmcmc::Index, tmcmc::Index> iteration_counts(const std::vector<Run>& runs) {
  std::map<tmcmc::Index, tmcmc::Index> counts;
  for (const Run& run : runs) {
    ++counts[run.iterations()];
  }
  return counts;
}

}  // namespace replication
