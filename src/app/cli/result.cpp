#include "app/cli/result.hpp"

#include <cstdio>

#include "core/error.hpp"

namespace chainreel {

void print_json(const Json& found) {
  std::puts(found.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void tell_result(const CommonOptions& options, const std::function<Json()>& found, const std::function<void()>& in_words) {
  if (options.json)
    print_json(found());
  else if (!options.quiet)
    in_words();
}

Json files_json(const std::vector<std::string>& files) {
  return {{"file", files.empty() ? Json(nullptr) : Json(files.front())}, {"files", files}};
}

void tell_files(const CommonOptions& options, const std::vector<std::string>& files, const std::function<Json()>& found,
                const std::function<void()>& in_words) {
  const auto with_files = [&] {
    Json told = files_json(files);
    if (found) told.update(found());
    return told;
  };
  tell_result(options, with_files, [&] {
    if (in_words) in_words();
    for (const std::string& file : files) std::printf("%s\n", file.c_str());
  });
}

void require_room_on_output(const CommonOptions& options, const std::string& output) {
  if (output == "-" && options.json)
    throw Error(ExitCode::usage, "-o - and --json both write to standard output: name a file");
}

}  // namespace chainreel
