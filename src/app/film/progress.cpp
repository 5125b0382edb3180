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

// To the file itself: standard error takes no carriage return, which would let a name write over its line.
bool rewrite_line(const std::string& text) {
  std::fflush(stderr);
  return write(STDERR_FILENO, text.data(), text.size()) >= 0;
}

}  // namespace

std::string bar_text(double part) {
  constexpr int kWidth = 20;
  if (!(part >= 0 && part <= 1)) return "";
  const int done = int(part * kWidth);
  std::string bar(std::size_t(kWidth), ' ');
  std::fill_n(bar.begin(), done, '=');
  if (done < kWidth) bar[std::size_t(done)] = '>';
  return "[" + bar + "] " + format_fixed(100 * part, 0) + " %";
}

std::string time_left_text(double part, double seconds) {
  constexpr double kEnough = 0.01;  // less of the work tells nothing of the rest
  if (!(part >= kEnough && part <= 1)) return "";
  return format_fixed(seconds * (1 - part) / part, 0) + " s left";
}

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
  std::snprintf(numbers, sizeof numbers, " %s  %d/%d frames  %.1f frames/s  %.0f s left%s",
                bar_text(total_ > 0 ? double(done) / total_ : 1).c_str(), done, total_, rate, left, terminal_ ? "  " : "\n");
  std::string text = terminal_ ? "\r" : "";
  text += printable(label_) + std::string(label_.size() < 16 ? 16 - label_.size() : 0, ' ') + numbers;
  printed_ |= rewrite_line(text);
}

Ticker::Ticker(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), next_(start_ + kPatience) {}

Ticker::~Ticker() {
  // What was said meanwhile is of no use any more.
  if (terminal_ && printed_ > 0) rewrite_line("\r" + std::string(printed_, ' ') + "\r");
}

bool Ticker::is_due() const {
  return !quiet_ && Clock::now() >= next_;
}

void Ticker::say(const std::string& text) {
  next_ = Clock::now() + (terminal_ ? kTerminalPeriod : kPlainPeriod);
  std::string line = printable(text);
  if (terminal_) line = "\r" + line + std::string(printed_ > line.size() ? printed_ - line.size() : 0, ' ');
  rewrite_line(terminal_ ? line : line + "\n");
  printed_ = std::max(printed_, line.size());
}

void Ticker::say(const std::string& text, double part) {
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const std::string left = time_left_text(part, seconds);
  say(text + "  " + bar_text(part) + (left.empty() ? "" : "  " + left));
}

void WorkTicker::tell(double part, const std::string& now) {
  // Who would have to wait has other things to do.
  const std::unique_lock lock(lock_, std::try_to_lock);
  if (lock.owns_lock() && ticker_.is_due()) ticker_.say(now.empty() ? what_ : what_ + ", " + now, part);
}

}  // namespace chainreel
