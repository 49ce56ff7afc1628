#include "kept_run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "command_line/report.hpp"
#include "io/errors.hpp"
#include "io/interrupt.hpp"

namespace examples {

tmcmc::Result run_kept(const storage::RunDescription& run, const tmcmc::LogLikelihood& model,
                       const std::string& checkpoint, const tmcmc::Observer& observer) {
  const auto problem = command_line::interruptible({model, run.prior});
  if (checkpoint.empty()) {
    return tmcmc::run(problem, run.options, run.key, observer);
  }
  // Nothing is kept if the checkpoint is a device.
  const auto is_kept = [&] {
    std::error_code error;
    return std::filesystem::is_regular_file(checkpoint, error);
  };
  double beta = -1.0;
  std::size_t stages = 0;
  try {
    const auto observe = [&](const tmcmc::Progress& progress) {
      beta = progress.state.beta;
      stages = progress.stages.size();
      observer(progress);
    };
    return storage::run_with_checkpoint(checkpoint, run, problem.log_likelihood, observe, problem.look);
  } catch (io::Interrupted& interrupted) {
    if (is_kept()) {
      interrupted.kept =
          fmt::format("the stages so far are kept in {}, run the same command again to go on", checkpoint);
    }
    throw;
  } catch (const io::InputError&) {
    throw;
  } catch (const io::OutputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    if (beta < 0.0 || !is_kept()) {
      throw;
    }
    throw std::runtime_error(
        fmt::format("{}; the samples after stage {} (beta = {:.4g}) are kept in {}: the same command goes "
                    "on from there",
                    error.what(), stages, beta, checkpoint));
  }
}

}  // namespace examples
