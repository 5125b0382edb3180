// Standard output and error as this program uses them.
#pragma once

#include <csignal>
#include <optional>
#include <span>
#include <string>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/output_file.hpp"

namespace chainreel {

// From now on whatever is printed is fit for a terminal (core/printable), and no line of standard error is longer than
// some lines of a terminal. Streams that the caller closed are held by ones that take nothing, so that no file of ours
// gets their number. To be called first.
void guard_streams();

// Every problem on standard error: each some lines long at most, temporary files under their final names.
void print_error(const Error& error);

// "WARNING: words" on standard error, however quiet: what speaks against a scene or a run.
void tell_warning(const std::string& words);

// What comes of a program that told one.
enum class AfterWarnings { tell, fail };
std::span<const Name> names_of(AfterWarnings);
// From now on.
void choose_after_warnings(AfterWarnings what);
// Whether one was told that lets the program fail; then that is said.
bool fails_by_warnings();

// What there is of a run that failed, under its .partial name, which is said; also that a file of an earlier run still has the
// name that was asked for.
void keep_and_tell(OutputFile& file);

// Hands on what was printed. False, with words on standard error, where not all of it was taken.
bool flush_standard_output();

// How wide the terminal is that standard output is; none where it is no terminal.
std::optional<std::size_t> terminal_columns();

// Reads all of standard input, once, and holds it (core/input_file) for those that read scenes. Returns the name under
// which they find it. Throws Error (bad input) where it cannot be read, (limit) where it does not end within 1 MiB.
std::string read_standard_input();

// Signals that ask the program to end: a flag that the long loops look at, so that temporary files are removed on the
// way out. A pipe without a reader and a file that may not grow are errors of the write that meets them, no signals.

void install_signal_handlers();
bool interrupted();
// For a program that has handlers of its own and calls ours: as long as this lives SIGINT is ours, and afterwards as it was,
// with no signal received. Of one thread, where one may live within another.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

 private:
  struct sigaction before_;
};
// Throws Error once a signal has come, with 128 and its number for an exit code: 129 SIGHUP, 130 SIGINT, 131 SIGQUIT,
// 143 SIGTERM.
void throw_if_interrupted();
// This command keeps what it has finished, and goes on from there when it is given again: which is said where a signal ends it.
void keeps_what_is_finished();

}  // namespace chainreel
