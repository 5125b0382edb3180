// What came of a suite, as one page for browsers that needs neither a server nor a network.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

struct ReportPicture {
  std::string name;
  std::string state;               // in a word: what pictures are listed and filtered by
  std::string source;              // file
  std::vector<std::string> words;  // why, the most telling first
  std::string expected_png, actual_png, difference_png;  // bytes of files; may be empty
  double worst = 0;                                      // error, 0 to 1
  long beyond = 0;                                       // pixels
  std::string tolerance;                                 // which one held, and where it was set
  bool passes = false;                                   // good pictures stand behind the others
};

struct VerifyReport {
  std::string suite;
  // What accepts all that failed; up to its --accept, what any picture is accepted by. Empty: nothing can be.
  std::string accept_command;
  std::string program;  // name and version
  std::vector<ReportPicture> pictures;
  std::string unused;  // what is said of baselines that are no picture's any more
};

// Throws Error (exit 6) as OutputFile does.
void write_html_report(const std::string& path, const VerifyReport& report, bool overwrite);

}  // namespace chainreel
