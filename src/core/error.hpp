// The one error type. Readers gather every problem of a file before they throw; the command line catches once,
// in main, and turns the code into the exit status.
#pragma once

#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chainreel {

// Exit codes of the program; a contract with scripts.
enum class ExitCode : int {
  good = 0,
  comparison_failed = 1,  // a comparison or requirement did not hold
  usage = 2,              // the command line
  bad_input = 3,          // a scene, model or data file
  no_renderer = 4,        // no OpenGL, codec or font
  numerical = 5,          // the run diverged or could not be solved
  file = 6,               // an output could not be written
  limit = 7,              // a size or resource limit
  interrupted = 130,      // SIGINT
  terminated = 143,       // SIGTERM
};

// A place in a text file; line and column count from 1, 0 means unknown.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

struct Problem {
  std::string message;  // what is wrong and what to do about it
  Place place;
  bool is_of_key = false;  // a key leads nowhere: no other value makes it better
};

// "file:line:column: message", leaving out what is unknown.
std::string to_string(const Problem& problem);

class Error : public std::exception {
 public:
  Error(ExitCode code, std::string message, Place place = {});
  Error(ExitCode code, std::vector<Problem> problems);

  ExitCode code() const { return code_; }
  const std::vector<Problem>& problems() const { return problems_; }
  const char* what() const noexcept override { return text_.c_str(); }  // one problem a line

 private:
  ExitCode code_;
  std::vector<Problem> problems_;
  std::string text_;
};

// Gathers the problems of one file.
class ProblemList {
 public:
  void add(std::string message, Place place) { add(Problem{std::move(message), std::move(place)}); }
  void add(Problem problem) { problems_.push_back(std::move(problem)); }
  bool empty() const { return problems_.empty(); }
  void throw_if_any(ExitCode code = ExitCode::bad_input) const;

 private:
  std::vector<Problem> problems_;
};

// The candidate that `name` most likely misspells, or "" if none is near (edit distance above a third of its length).
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

// "did you mean 'x'?" behind a space, or "" if no candidate is near.
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

}  // namespace chainreel
