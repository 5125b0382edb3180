// What a figure or table of a model or of scenes was made of: by it `check --today` tells whether it would be the same now, and what changed.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "core/json.hpp"

namespace chainreel {

// The command's words with the paths of its files as found from that folder, for where the command is remembered.
std::vector<std::string> words_from(const Command& command, const std::string& folder);

// Of each file that the command names: of a scene its text with all defaults and the --set that are given, of its models and tables the hashes; of a model
// its links and joints; of any other file its hash. `words` and `files`: the command's, with paths as found from here. Null in the place of one that cannot
// be read by itself.
Json command_inputs(const std::vector<std::string>& words, const std::vector<std::size_t>& files);

// Whether all are known.
bool are_known(const Json& inputs);

// What differs, a sentence each, with the file's name where there are several. `without`: keys of scenes that make no difference.
std::vector<std::string> changed_inputs(const Json& before, const Json& now, const std::vector<std::string>& without = {});

// Keys that the command sets itself, in each of its runs.
std::vector<std::string> keys_of_command(const std::vector<std::string>& words);
// Keys of a scene of which no number in a table of that command tells: those of its picture, and those that the command sets itself.
std::vector<std::string> keys_without_numbers(const std::vector<std::string>& words);

}  // namespace chainreel
