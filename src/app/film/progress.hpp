// Progress on standard error: one line that rewrites itself on a terminal, a plain line every few seconds
// elsewhere.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <utility>

namespace chainreel {

// "[=======>            ]  37 %"; of what is not known to end, "".
std::string bar_text(double part);
// "12 s left", of work of which that part took so long; "" while nothing can be told.
std::string time_left_text(double part, double seconds);

class Progress {
 public:
  Progress(std::string label, int total, bool quiet);
  ~Progress();

  void update(int done);  // percent, frames/s, time left

 private:
  using Clock = std::chrono::steady_clock;
  void print(int done, Clock::time_point now);

  std::string label_;
  int total_;
  bool quiet_;
  bool terminal_;
  bool printed_ = false;
  Clock::time_point start_, last_;
};

// The same for what has no frames to count: sentences, from the first second on.
class Ticker {
 public:
  explicit Ticker(bool quiet);
  ~Ticker();

  bool is_due() const;
  void say(const std::string& text);
  // The same with a bar behind it and the time left, of work of which that part is done.
  void say(const std::string& text, double part);

 private:
  using Clock = std::chrono::steady_clock;

  bool quiet_;
  bool terminal_;
  std::size_t printed_ = 0;  // characters of the line that stands on the terminal
  Clock::time_point start_, next_;
};

// What a command does that computes many runs, told by whichever of its threads comes first: "rr_free: 12 methods  [==>   ] .."
class WorkTicker {
 public:
  WorkTicker(std::string what, bool quiet) : what_(std::move(what)), ticker_(quiet) {}

  // Of all that is to be done that part is. `now`: what is at work.
  void tell(double part, const std::string& now = "");

 private:
  std::string what_;
  Ticker ticker_;
  std::mutex lock_;
};

}  // namespace chainreel
