#include "mesh/limited_child.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

#include "core/error.hpp"

namespace chainreel {
namespace {

enum ChildStatus : int { kDone = 0, kNoMemory = 1, kFailed = 2 };

void limit(decltype(RLIMIT_CPU) resource, rlim_t value) {
  rlimit current{};
  getrlimit(resource, &current);
  // A limit that is already lower stays.
  current.rlim_cur = std::min({value, current.rlim_cur, current.rlim_max});
  setrlimit(resource, &current);
}

// Address space in use, bytes.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * std::size_t(sysconf(_SC_PAGESIZE));
}

void apply(const ChildLimits& limits) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, rlim_t(limits.cpu_seconds));
#ifndef __SANITIZE_ADDRESS__  // its shadow memory alone takes terabytes of address space
  limit(RLIMIT_AS, address_space() + limits.memory);
#endif
}

bool write_all(int file, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += std::size_t(n);
  }
  return true;
}

// At most `limit` bytes and a little more.
std::string read_all(int file, std::size_t limit) {
  std::string text;
  std::array<char, 65536> buffer;  // what a pipe holds
  while (text.size() <= limit) {
    const ssize_t n = read(file, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    text.append(buffer.data(), std::size_t(n));
  }
  return text;
}

[[noreturn]] void be_the_child(const std::function<std::string()>& work, const ChildLimits& limits,
                               int reply) {
  // The parent's handlers tidy up files that are the parent's.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGSEGV, SIGABRT, SIGPIPE, SIGXCPU, SIGXFSZ, SIGALRM})
    signal(number, SIG_DFL);
  apply(limits);
  alarm(unsigned(limits.seconds));
  int status = kDone;
  try {
    if (!write_all(reply, work())) status = kFailed;
  } catch (const std::bad_alloc&) {
    status = kNoMemory;
  } catch (...) {
    status = kFailed;
  }
  _exit(status);  // no destructors, no atexit: they belong to the parent
}

std::string trouble_of(int status) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    if (number == SIGXCPU || number == SIGALRM) return "took too long";
    if (number == SIGKILL) return "was killed, as systems do that are short of memory, or took too long";
    return "ran out of memory or crashed (signal " + std::to_string(number) + ")";
  }
  return WEXITSTATUS(status) == kNoMemory ? "ran out of memory" : "failed";
}

}  // namespace

ChildResult run_in_limited_child(const std::function<std::string()>& work, const ChildLimits& limits) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0)
    throw Error(ExitCode::limit, std::string("no pipe could be made: ") + std::strerror(errno));
  std::fflush(nullptr);  // or the child would own a second copy of unwritten text
  const pid_t child = fork();
  if (child < 0) {
    const std::string reason = std::strerror(errno);
    close(ends[0]);
    close(ends[1]);
    throw Error(ExitCode::limit, "no process could be made to read a file safely: " + reason);
  }
  if (child == 0) {
    close(ends[0]);
    be_the_child(work, limits, ends[1]);
  }
  close(ends[1]);

  ChildResult result;
  result.reply = read_all(ends[0], limits.reply);
  const bool is_too_long = result.reply.size() > limits.reply;
  if (is_too_long) kill(child, SIGKILL);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.finished = WIFEXITED(status) && WEXITSTATUS(status) == kDone;
  if (!result.finished) result.trouble = trouble_of(status);
  if (is_too_long) {
    result = {};
    result.trouble = "sent back too much";
  }
  return result;
}

}  // namespace chainreel
