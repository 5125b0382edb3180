// What is said where the program cannot unwind to its end.
#pragma once

namespace chainreel {

inline constexpr const char* kOutOfMemory = "chainreel: out of memory: take a shorter duration or a smaller picture\n";

// What cannot be unwound still ends with a line, an exit code and nothing half-written: libraries take memory in destructors,
// which may not throw. Faults that are no want of memory end as the system ends them, with 128 and the signal's number for
// an exit code, behind a line of their own; what they leave half-written the next run in that folder takes away.
void install_last_words();

}  // namespace chainreel
