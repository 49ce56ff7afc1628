#include "run_progress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/terminal_line.hpp"

namespace examples {

namespace {

constexpr std::chrono::milliseconds redraw_every(200), silent_for(500);

}  // namespace

RunProgress::RunProgress(long runs, long evaluations, bool is_enabled)
    : runs_(runs), evaluations_(evaluations) {
  if (!is_enabled || !io::can_redraw_line()) {
    return;
  }
  drawer_ = std::jthread([this](const std::stop_token& stop) {
    bool is_drawn = false;
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, stop, is_drawn ? redraw_every : silent_for,
                           [&stop] { return stop.stop_requested(); })) {
      draw();
      is_drawn = true;
    }
    if (is_drawn) {
      io::redraw_line("");
    }
  });
}

RunProgress::~RunProgress() = default;

void RunProgress::begin(long run) {
  run_ = run;
  stage_ = 0;
  beta_ = 0.0;
  done_ = 0;
}

void RunProgress::begin_prediction(tmcmc::Index evaluations) {
  done_ = 0;
  prediction_ = evaluations;
}

void RunProgress::update(const tmcmc::Progress& progress) {
  stage_ = progress.stages.size();
  beta_ = progress.state.beta;
  done_ = progress.state.evaluations;
}

void RunProgress::draw() const {
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
  if (const long all = prediction_; all > 0) {
    io::redraw_line(fmt::format("posterior predictive, {} of {} evaluations, {:.0f} s",
                                std::min(done_.load(), all), all, time.count()));
    return;
  }
  io::redraw_line(fmt::format("{}stage {}, beta {:.3g}, {} of {} evaluations, {:.0f} s",
                              runs_ > 1 ? fmt::format("run {} of {}, ", run_.load(), runs_) : "",
                              stage_.load() + 1, beta_.load(), std::min(done_.load(), evaluations_),
                              evaluations_, time.count()));
}

}  // namespace examples
