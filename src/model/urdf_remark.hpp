// A doubt about a URDF file that is noted while it is read, for the doctor to tell.
#pragma once

#include <string>

namespace chainreel {

// What a file says that is read, but probably not as it was meant; or that is not read.
struct UrdfRemark {
  std::string kind;  // what several such are: "attributes that are not read"
  std::string message;
  int line = 0;
  bool is_harmless = false;  // good to know, no more
};

}  // namespace chainreel
