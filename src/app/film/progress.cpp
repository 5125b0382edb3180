#include "app/film/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr std::chrono::milliseconds kTerminalPeriod{100};
constexpr std::chrono::milliseconds kPlainPeriod{4000};
constexpr std::chrono::milliseconds kPatience{900};  // before the first word

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
  char numbers[128];
  std::snprintf(numbers, sizeof numbers, " %3d %%  %d/%d frames  %.1f frames/s  %.0f s left%s",
                total_ > 0 ? int(100.0 * done / total_) : 100, done, total_, rate, left, terminal_ ? "  " : "\n");
  // To the file itself: standard error takes no carriage return, which would let a name write over its line.
  std::string text = terminal_ ? "\r" : "";
  text += printable(label_) + std::string(label_.size() < 16 ? 16 - label_.size() : 0, ' ') + numbers;
  std::fflush(stderr);
  if (write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nobody looks
  printed_ = true;
}

Ticker::Ticker(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), next_(Clock::now() + kPatience) {}

Ticker::~Ticker() {
  // What was said meanwhile is of no use any more.
  if (terminal_ && printed_ > 0) std::fprintf(stderr, "\r%*s\r", int(printed_), "");
}

bool Ticker::is_due() const {
  return !quiet_ && Clock::now() >= next_;
}

void Ticker::say(const std::string& text) {
  next_ = Clock::now() + (terminal_ ? kTerminalPeriod : kPlainPeriod);
  if (terminal_)
    std::fprintf(stderr, "\r%-*s", int(printed_), text.c_str());
  else
    std::fprintf(stderr, "%s\n", text.c_str());
  std::fflush(stderr);
  printed_ = std::max(printed_, text.size());
}

}  // namespace chainreel
