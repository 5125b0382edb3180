// What program this is.
#pragma once

namespace chainreel {

const char* program_version();   // "0.1.0"
const char* program_revision();  // "1a2b3c4-dirty": of the source tree when the program was built

}  // namespace chainreel
