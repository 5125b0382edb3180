// SIGINT and SIGTERM: a flag that the long loops look at, so that temporary files are removed on the way out.
#pragma once

namespace chainreel {

void install_signal_handlers();
bool interrupted();
// Throws Error with exit code 130 or 143 once a signal has come.
void throw_if_interrupted();

}  // namespace chainreel
