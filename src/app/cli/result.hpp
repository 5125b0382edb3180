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

// What a command wrote and nothing more: the files' names, one a line, or {"file": ..} with what else was found. Of several
// files "files" holds them all.
void tell_files(const CommonOptions& options, const std::vector<std::string>& files, Json found = Json::object());

// "-o -" gives the data itself to standard output, where there is room for one text. Throws Error (usage) beside --json.
void require_room_on_output(const CommonOptions& options, const std::string& output);

}  // namespace chainreel
