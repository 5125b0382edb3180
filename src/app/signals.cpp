#include "app/signals.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <string>

#include "core/error.hpp"

namespace chainreel {
namespace {

// Who sends a signal to a program and then to its group (timeout, a shell) means one.
constexpr double kOneAndTheSame = 0.5;  // s

struct Ending {
  int signal;
  const char* word;
  bool may_be_ignored;
};
constexpr std::array<Ending, 4> kEndings = {{{SIGINT, "interrupted", false},
                                             {SIGTERM, "terminated", false},
                                             {SIGHUP, "the terminal was closed", true},
                                             {SIGQUIT, "told to quit", true}}};

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
  for (const Ending& ending : kEndings) sigaddset(&action.sa_mask, ending.signal);  // none interrupts another's handler
  for (const Ending& ending : kEndings) {
    // Who started the program with one of them ignored (nohup) wants it to go on.
    struct sigaction before = {};
    if (ending.may_be_ignored && sigaction(ending.signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(ending.signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() {
  return received != 0;
}

void throw_if_interrupted() {
  const int signal = received;
  for (const Ending& ending : kEndings)
    if (ending.signal == signal)
      throw Error(ExitCode(128 + signal), std::string(ending.word) + ": nothing half-written was kept");
}

}  // namespace chainreel
