#include "io/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/interrupt.hpp"
#include "io/terminal_line.hpp"

namespace io {

Progress::Progress(std::string label, std::size_t total, bool enabled)
    : label_(std::move(label)), total_(total), active_(enabled && total > 0 && can_redraw_line()) {}

Progress::~Progress() {
  if (drawn_) redraw_line("");
}

void Progress::advance(std::size_t n) {
  constexpr auto silent_for = std::chrono::milliseconds(1500);
  constexpr auto redraw_every = std::chrono::milliseconds(100);
  stop_if_interrupted();
  const std::size_t done = done_.fetch_add(n, std::memory_order_relaxed) + n;
  const Clock::time_point now = Clock::now();
  if (!active_ || now - start_ < silent_for) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock() || now - last_draw_ < redraw_every) return;
  draw(std::min(done, total_), now - start_);
  last_draw_ = now;
}

void Progress::draw(std::size_t done, Clock::duration elapsed) {
  constexpr std::size_t bar_width = 30;
  const double fraction = static_cast<double>(done) / static_cast<double>(total_);
  const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(bar_width));
  const double elapsed_s = std::chrono::duration<double>(elapsed).count();
  const double left_s = done > 0 ? elapsed_s * (1.0 - fraction) / fraction : 0.0;
  redraw_line(fmt::format("{} [{:.<{}}] {:3.0f} % {}/{}, {:.0f} s left", label_, std::string(filled, '#'),
                          bar_width, 100.0 * fraction, done, total_, left_s));
  drawn_ = true;
}

}  // namespace io
