// What `compare` finds out about two things, and what each kind of thing takes to be compared. To add a kind:
// a function here, its file, and a row in compare_command.cpp.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "app/film/clip_memory.hpp"
#include "compare/compare_images.hpp"
#include "core/json.hpp"
#include "sim/trajectory_difference.hpp"

namespace chainreel {

struct CompareOptions {
  std::string before, after;
  std::string output;  // difference picture; of folders, a folder for them; "": none
  std::string strip;   // of films: their errors over time; "": none
  static constexpr double kNotGiven = -1e300;
  double wished = kNotGiven;  // --tolerance
  ImageTolerance tolerance{.forgive_edges = true};
  bool count_edges = false;
  bool side_by_side = false;
  CommonOptions common;

  // Of a column's range.
  double table_tolerance() const { return has_wish() ? wished : kSameOfRange; }
  bool has_wish() const { return wished != kNotGiven; }
};

struct Comparison {
  bool equal = true;               // in all that was looked at
  bool passes = true;              // equal, or within the tolerance
  std::vector<std::string> words;  // what to say, a line each
  Json report = Json::object();
};

// Each throws Error where an input cannot be read (exit 3) or a picture not written (exit 6).
Comparison compare_picture_files(const CompareOptions& options);
Comparison compare_folders(const CompareOptions& options);
Comparison compare_films(const CompareOptions& options);
Comparison compare_models(const CompareOptions& options);
Comparison compare_trajectories(const CompareOptions& options);

// What two pictures differ in, in words ("equal", "sizes differ: ..") and as JSON.
std::string told(const ImageDifference& difference, const Image& before, const Image& after,
                 const ImageTolerance& tolerance);
Json report_of(const ImageDifference& difference, const Image& before, const Image& after);

// Writes what shows the difference: alone, or beside both. Pictures of two sizes have none but stand side by
// side.
void write_difference(const CompareOptions& options, const Image& before, const Image& after,
                      const std::string& path);

// Whether both name a library, or this program, and not the same version of it.
bool has_other_versions(const Json& before, const Json& after);

// "1 pixel is", "3 pixels are".
std::string counted(long count, const char* one, const char* more);

// What audits of two runs, or what two figures remember, tell of their models' files. What an older version wrote knows of no comments.
enum class ModelFiles { same, other_comments, other };
ModelFiles compare_model_files(const Json& before, const Json& after);

// How sentences end that tell of a model or motion that is another one.
inline constexpr const char* kByHash = ", by its hash";
// What the two files remember differently, of scenes key by key. Nothing where neither remembers anything.
std::vector<std::string> explain_memories(const std::string& before, const std::string& after);
std::vector<std::string> explain_memories(const ClipMemory& before, const ClipMemory& after);

// Whether the file's ending is one of these, which are in lower case, whatever its own case.
bool ends_in(const std::string& path, std::initializer_list<const char*> endings);

}  // namespace chainreel
