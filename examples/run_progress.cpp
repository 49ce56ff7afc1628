#include "run_progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace examples {

namespace {

constexpr std::chrono::milliseconds redraw_every(200), silent_for(500);

bool can_draw() {
  const char* const terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) != 0 && !(terminal != nullptr && std::string_view(terminal) == "dumb");
}

void show(std::string_view text) {
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

RunProgress::RunProgress(long runs, long evaluations, bool is_enabled)
    : runs_(runs), evaluations_(evaluations) {
  if (!is_enabled || !can_draw()) {
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
    show(is_drawn ? "\r\x1B[K" : "");
  });
}

RunProgress::~RunProgress() = default;

void RunProgress::begin(long run) {
  run_ = run;
  stage_ = 0;
  beta_ = 0.0;
  done_ = 0;
}

void RunProgress::update(const tmcmc::Progress& progress) {
  stage_ = progress.stages.size();
  beta_ = progress.state.beta;
  done_ = progress.state.evaluations;
}

void RunProgress::draw() const {
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
  std::string line =
      fmt::format("{}stage {}, beta {:.3g}, {} of {} evaluations, {:.0f} s",
                  runs_ > 1 ? fmt::format("run {} of {}, ", run_.load(), runs_) : "", stage_.load() + 1,
                  beta_.load(), std::min(done_.load(), evaluations_), evaluations_, time.count());
  winsize size{};
  const bool is_known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  line.resize(std::min<std::size_t>(line.size(), is_known ? size.ws_col - 1U : 79U));
  show("\r" + line + "\x1B[K");
}

}  // namespace examples
