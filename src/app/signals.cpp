#include "app/signals.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>

#include "core/error.hpp"

namespace chainreel {
namespace {

// Who sends a signal to a program and then to its group (timeout, a shell) means one.
constexpr double kOneAndTheSame = 0.5;  // s

std::atomic<int> received = 0;
std::atomic<double> first_time = 0;  // s, of the monotonic clock
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<double>::is_always_lock_free);

double now() {
  timespec time = {};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

// Calls nothing but what a handler may. A second signal that is another one ends the program at once.
void remember(int signal) {
  const int saved = errno;
  if (received == 0) {
    first_time = now();
    received = signal;
  } else if (now() - first_time > kOneAndTheSame) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // comes when this handler returns
  }
  errno = saved;
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action = {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  sigaddset(&action.sa_mask, SIGINT);  // neither interrupts the handler of the other
  sigaddset(&action.sa_mask, SIGTERM);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() {
  return received != 0;
}

void throw_if_interrupted() {
  if (received == SIGINT) throw Error(ExitCode::interrupted, "interrupted: nothing half-written was kept");
  if (received == SIGTERM) throw Error(ExitCode::terminated, "terminated: nothing half-written was kept");
}

}  // namespace chainreel
