// What a stage of some work takes: processor time of the thread that does it, and time by the clock.
#pragma once

namespace chainreel {

struct StageTime {
  double cpu = 0, wall = 0;  // s

  StageTime& operator+=(const StageTime& other);
  StageTime& operator-=(const StageTime& other);
};

// Since it was made or last asked. To be asked by one thread, whose time it tells.
class StageClock {
 public:
  StageTime lap();

 private:
  static StageTime now();
  StageTime last_ = now();
};

// The same of the whole process, with its other threads and with children that have ended.
class ProcessClock {
 public:
  StageTime lap();

 private:
  static StageTime now();
  StageTime last_ = now();
};

}  // namespace chainreel
