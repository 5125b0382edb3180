#include "app/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace chainreel {
namespace {

constexpr std::chrono::milliseconds kTerminalPeriod{100};
constexpr std::chrono::milliseconds kPlainPeriod{4000};

}  // namespace

Progress::Progress(std::string label, int total, bool quiet)
    : label_(std::move(label)),
      total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
  if (terminal_ && printed_) std::fputc('\n', stderr);
}

void Progress::update(int done) {
  if (quiet_) return;
  const auto now = Clock::now();
  const bool finished = done == total_;
  if (now - last_ < (terminal_ ? kTerminalPeriod : kPlainPeriod) && !finished) return;
  last_ = now;
  print(done, now);
}

void Progress::print(int done, Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = seconds > 0 ? done / seconds : 0;
  const double left = rate > 0 ? (total_ - done) / rate : 0;
  std::fprintf(stderr, "%s%-16s %3d %%  %d/%d frames  %.1f frames/s  %.0f s left%s", terminal_ ? "\r" : "",
               label_.c_str(), total_ > 0 ? int(100.0 * done / total_) : 100, done, total_, rate, left,
               terminal_ ? "  " : "\n");
  std::fflush(stderr);
  printed_ = true;
}

}  // namespace chainreel
