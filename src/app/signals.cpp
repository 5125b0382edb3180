#include "app/signals.hpp"

#include <csignal>

#include "core/error.hpp"

namespace chainreel {
namespace {

volatile std::sig_atomic_t received = 0;

void remember(int signal) {
  received = signal;
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESETHAND;  // a second signal ends the program at once
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
