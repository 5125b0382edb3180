// What a command found, told by all of them in one way: in words, or with --json as one JSON text, and nothing else, on
// standard output.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "core/json.hpp"

namespace chainreel {

// One JSON text and a new line. Bytes of texts that are no UTF-8, like those of file names, are replaced; numbers that are
// not finite become null.
void print_json(const Json& found);

// With --json the first, else the second unless --quiet. Only the one that is told is made.
void tell_result(const CommonOptions& options, const std::function<Json()>& found, const std::function<void()>& in_words);

// The names of files that were written: {"file": the first, or null, "files": all}.
Json files_json(const std::vector<std::string>& files);

// What a command wrote: `in_words` where there is anything to say, then the files' names, one a line; or `files_json` with
// what else was found. Only the one that is told is made.
void tell_files(const CommonOptions& options, const std::vector<std::string>& files,
                const std::function<Json()>& found = nullptr, const std::function<void()>& in_words = nullptr);

// "-o -" gives the data itself to standard output, where there is room for one text. Throws Error (usage) beside --json.
void require_room_on_output(const CommonOptions& options, const std::string& output);

}  // namespace chainreel
