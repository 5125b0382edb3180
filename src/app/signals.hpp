// Signals that ask the program to end: a flag that the long loops look at, so that temporary files are removed on the
// way out. A pipe without a reader and a file that may not grow are errors of the write that meets them, no signals.
#pragma once

namespace chainreel {

void install_signal_handlers();
bool interrupted();
// Throws Error once a signal has come, with 128 and its number for an exit code: 129 SIGHUP, 130 SIGINT, 131 SIGQUIT,
// 143 SIGTERM.
void throw_if_interrupted();

}  // namespace chainreel
