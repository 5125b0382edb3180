#include "app/cli/streams.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "core/temporary_file.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kLongestMessage = 1000;  // bytes: a dozen lines
constexpr std::size_t kMostProblems = 10;

struct Guard {
  int file = -1;
  std::size_t longest_line = 0;  // bytes; 0: any
  PrintableStream text{};
  std::size_t line = 0;     // bytes of the line so far
  int trouble = 0;          // errno of what was not taken
};

// Keeps only the first bytes of lines that are too long.
std::string without_long_lines(Guard& guard, const std::string& text) {
  if (guard.longest_line == 0) return text;
  std::string result;
  for (const char c : text) {
    if (c == '\n') {
      if (guard.line > guard.longest_line)
        result += ".. (" + std::to_string(guard.line - guard.longest_line) + " bytes more)";
      guard.line = 0;
    } else if (++guard.line > guard.longest_line) {
      continue;
    }
    result += c;
  }
  return result;
}

bool write_all(Guard& guard, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(guard.file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      guard.trouble = errno;
      return false;
    }
    done += std::size_t(count);
  }
  return true;
}

ssize_t write_guarded(void* cookie, const char* bytes, size_t count) {
  Guard& guard = *static_cast<Guard*>(cookie);
  // After a loss nothing more is tried: the reader would get a text with a hole.
  if (guard.trouble != 0) return 0;
  return write_all(guard, without_long_lines(guard, guard.text.next({bytes, count}))) ? ssize_t(count) : 0;
}

Guard& guard_of(int file) {
  static std::array<Guard, 2> guards{{{STDOUT_FILENO, 0}, {STDERR_FILENO, kLongestMessage + 200}}};
  return guards[file == STDOUT_FILENO ? 0 : 1];
}

std::FILE* guarded(int file, int buffering) {
  cookie_io_functions_t functions = {};
  functions.write = write_guarded;
  std::FILE* stream = fopencookie(&guard_of(file), "w", functions);
  if (stream != nullptr) std::setvbuf(stream, nullptr, buffering, 0);
  return stream;
}

// Opened the wrong way round: whoever writes is told so.
void hold_if_closed(int file) {
  if (fcntl(file, F_GETFD) != -1 || errno != EBADF) return;
  const int held = open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  if (held >= 0 && held != file) {
    dup2(held, file);
    close(held);
  }
}

}  // namespace

void guard_streams() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) hold_if_closed(file);
  if (std::FILE* out = guarded(STDOUT_FILENO, isatty(STDOUT_FILENO) == 1 ? _IOLBF : _IOFBF)) stdout = out;
  if (std::FILE* err = guarded(STDERR_FILENO, _IOLBF)) stderr = err;
}

namespace {

// Of "and 970 more problems", which stands for those that a reader did not keep; else 1.
std::size_t problems_in(const Problem& problem) {
  std::size_t count = 0;
  return std::sscanf(problem.message.c_str(), "and %zu more problems", &count) == 1 ? count : 1;
}

}  // namespace

void print_error(const Error& error) {
  std::vector<std::string> told;
  std::size_t more = 0;
  for (const Problem& problem : error.problems()) {
    const std::string line = shortened(with_final_names(to_string(problem)), kLongestMessage);
    if (std::find(told.begin(), told.end(), line) != told.end()) continue;  // of panels that share what is wrong
    if (told.size() == kMostProblems || problems_in(problem) > 1) {
      more += problems_in(problem);
      continue;
    }
    told.push_back(line);
    std::fprintf(stderr, "%s\n", line.c_str());
  }
  if (more > 0) std::fprintf(stderr, ".. and %zu more problems\n", more);
}

std::optional<std::size_t> terminal_columns() {
  constexpr unsigned short kNarrowest = 40;  // of less lines are broken by the terminal
  winsize size = {};
  if (isatty(STDOUT_FILENO) != 1 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < kNarrowest) return std::nullopt;
  return size.ws_col;
}

void keep_and_tell(OutputFile& file) {
  const std::string partial = file.keep_as_partial();
  std::error_code code;
  const bool is_older = std::filesystem::exists(file.path(), code);
  std::fprintf(stderr, "note: what there is of it: %s%s\n", partial.c_str(), is_older ? ("; " + file.path() + " is still that of an earlier run").c_str() : "");
}

namespace {

std::atomic<int> warnings_told = 0;
AfterWarnings after_warnings = AfterWarnings::tell;

}  // namespace

std::span<const Name> names_of(AfterWarnings) {
  static constexpr Name names[] = {{"tell", "nothing"}, {"fail", "exit code 1"}};
  return names;
}

void tell_warning(const std::string& words) {
  ++warnings_told;
  std::fprintf(stderr, "WARNING: %s\n", words.c_str());
}

void choose_after_warnings(AfterWarnings what) { after_warnings = what; }

bool fails_by_warnings() {
  if (after_warnings != AfterWarnings::fail || warnings_told == 0) return false;
  std::fprintf(stderr, "%d WARNING%s above, which --warnings fail lets be an error; `acknowledge` in a scene names those that are known\n",
               int(warnings_told), warnings_told == 1 ? "" : "s");
  return true;
}

bool flush_standard_output() {
  Guard& guard = guard_of(STDOUT_FILENO);
  const bool flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && guard.trouble == 0;
  if (flushed && write_all(guard, guard.text.end())) return true;
  // Who closed the pipe, like `head`, wants no more of it.
  if (guard.trouble != EPIPE) std::fprintf(stderr, "standard output did not take all that was printed (%s)\n", std::strerror(guard.trouble));
  return false;
}

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
std::atomic<bool> goes_on = false;  // when it is given again
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

std::string read_standard_input() {
  constexpr std::size_t kLargest = std::size_t(1) << 20;  // bytes, as of a scene's file
  if (standard_input_at(kStandardInput) != nullptr) return kStandardInput;
  std::string text;
  std::array<char, 65536> piece{};
  for (;;) {
    const ssize_t count = read(STDIN_FILENO, piece.data(), piece.size());
    throw_if_interrupted();
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Error(ExitCode::bad_input, std::string("cannot be read: ") + std::strerror(errno), {kStandardInput});
    if (count == 0) break;
    text.append(piece.data(), std::size_t(count));
    if (text.size() > kLargest) throw Error(ExitCode::limit, "is larger than 1 MiB: some 25 lines are enough", {kStandardInput});
  }
  hold_standard_input(std::move(text));
  return kStandardInput;
}

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

namespace {
int watches = 0;
}

InterruptWatch::InterruptWatch() : before_{} {
  ++watches;
  struct sigaction action = {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &before_);
}

InterruptWatch::~InterruptWatch() {
  sigaction(SIGINT, &before_, nullptr);
  if (--watches == 0) received = 0;  // who watches around this one is yet to see it
}

bool interrupted() {
  return received != 0;
}

void throw_if_interrupted() {
  const int signal = received;
  for (const Ending& ending : kEndings)
    if (ending.signal == signal)
      throw Error(ExitCode(128 + signal), std::string(ending.word) + ": nothing half-written was kept" +
                                             (goes_on ? "; what is finished is, and the same command goes on from there" : ""));
}

void keeps_what_is_finished() {
  goes_on = true;
}

}  // namespace chainreel
