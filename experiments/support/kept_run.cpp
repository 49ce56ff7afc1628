#include "kept_run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "io/errors.hpp"
#include "io/signals.hpp"

namespace experiments {

tmcmc::Result run_kept(const archive::RunDescription& run, const tmcmc::LogLikelihood& log_likelihood,
                       const std::string& checkpoint) {
  if (checkpoint.empty()) {
    return tmcmc::run({log_likelihood, run.prior}, run.options, run.key);
  }
  // A checkpoint that is a device keeps nothing.
  const auto is_kept = [&] {
    std::error_code error;
    return std::filesystem::is_regular_file(checkpoint, error);
  };
  const auto say_what_is_kept = [&] {
    if (is_kept()) {
      io::set_interruption_note(
          fmt::format("the stages so far are kept in {}, run the same command again to go on", checkpoint));
    }
  };
  say_what_is_kept();
  double beta = -1.0;
  std::size_t stages = 0;
  try {
    return archive::run_with_checkpoint(checkpoint, run, log_likelihood,
                                        [&](const tmcmc::Progress& progress) {
                                          say_what_is_kept();
                                          beta = progress.state.beta;
                                          stages = progress.stages.size();
                                        });
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

}  // namespace experiments
