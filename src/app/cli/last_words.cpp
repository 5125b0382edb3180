#include "app/cli/last_words.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "core/error.hpp"
#include "core/temporary_file.hpp"

namespace chainreel {
namespace {

pid_t own_process = 0;  // children that read files for it have none of its files

struct FaultLine {
  int signal;
  std::string_view line;
};
constexpr std::array<FaultLine, 5> kFaults = {
    {{SIGSEGV, "chainreel: a fault in the program or in a library that it uses (SIGSEGV): what it was writing is not finished\n"},
     {SIGBUS, "chainreel: a file that was being read became shorter, or a fault in the program or in a library (SIGBUS): what it was writing is not finished\n"},
     {SIGILL, "chainreel: the processor lacks an instruction, or a fault in the program or in a library (SIGILL): what it was writing is not finished\n"},
     {SIGFPE, "chainreel: a fault in the program or in a library that it uses (SIGFPE): what it was writing is not finished\n"},
     {SIGABRT, "chainreel: the program or a library that it uses gave up (SIGABRT): what it was writing is not finished\n"}}};

// Of the thread that runs main, whose stack may be what has ended.
alignas(16) std::array<char, 1 << 16> spare_stack;

// False where nobody takes it.
bool tell(std::string_view line) {
  return write(STDERR_FILENO, line.data(), line.size()) >= 0;
}

// Takes no memory and no lock: either may be what is broken.
void tell_fault(int signal) {
  const int saved = errno;
  if (getpid() == own_process)
    for (const FaultLine& fault : kFaults)
      if (fault.signal == signal && !tell(fault.line)) break;
  std::raise(signal);  // comes when this handler returns, as the system has it
  errno = saved;
}

[[noreturn]] void end_at_once() {
  if (getpid() == own_process) remove_unfinished();
  try {
    if (const std::exception_ptr problem = std::current_exception()) std::rethrow_exception(problem);
  } catch (const std::bad_alloc&) {
    _exit(int(tell(kOutOfMemory) ? ExitCode::limit : ExitCode::file));
  } catch (...) {
  }
  std::abort();
}

}  // namespace

void install_last_words() {
  own_process = getpid();
  std::set_terminate(end_at_once);
  stack_t stack = {};
  stack.ss_sp = spare_stack.data();
  stack.ss_size = spare_stack.size();
  sigaltstack(&stack, nullptr);
  for (const FaultLine& fault : kFaults) {
    struct sigaction action = {}, before = {};
    // Tools that look for faults have handlers of their own, which say more.
    if (sigaction(fault.signal, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) continue;
    action.sa_handler = tell_fault;
    action.sa_flags = int(SA_RESETHAND) | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    sigaction(fault.signal, &action, nullptr);
  }
}

}  // namespace chainreel
