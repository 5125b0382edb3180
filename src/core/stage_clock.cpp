#include "core/stage_clock.hpp"

#include <sys/resource.h>

#include <ctime>

namespace chainreel {
namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double seconds_of(const timeval& time) {
  return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

double seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

// What has passed between two times; the later one takes the place of the earlier.
StageTime passed(StageTime& last, const StageTime& now) {
  StageTime lap = now;
  lap -= last;
  last = now;
  return lap;
}

}  // namespace

StageTime& StageTime::operator+=(const StageTime& other) {
  cpu += other.cpu;
  wall += other.wall;
  return *this;
}

StageTime& StageTime::operator-=(const StageTime& other) {
  cpu -= other.cpu;
  wall -= other.wall;
  return *this;
}

StageTime StageClock::now() {
  return {seconds_of(CLOCK_THREAD_CPUTIME_ID), seconds_of(CLOCK_MONOTONIC)};
}

StageTime StageClock::lap() {
  return passed(last_, now());
}

StageTime ProcessClock::now() {
  return {seconds_of(CLOCK_PROCESS_CPUTIME_ID) + seconds_of_children(), seconds_of(CLOCK_MONOTONIC)};
}

StageTime ProcessClock::lap() {
  return passed(last_, now());
}

}  // namespace chainreel
