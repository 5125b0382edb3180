// Two pictures, and two folders of them.

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "app/cli/streams.hpp"
#include "app/commands/comparison.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

Image read_picture(const std::string& path) {
  require_plain_file(path);
  note_input(path);
  return read_png(path);
}

// Names of the PNGs that lie in a folder itself.
std::set<std::string> pictures_in(const std::string& folder) {
  std::set<std::string> names;
  std::error_code trouble;
  for (fs::directory_iterator entry(folder, trouble), end; !trouble && entry != end;
       entry.increment(trouble)) {
    const fs::path name = entry->path().filename();
    if (name.extension() == ".png" && name.string().front() != '.') names.insert(name.string());
  }
  if (trouble) throw Error(ExitCode::bad_input, "cannot be listed: " + trouble.message(), {folder});
  return names;
}

Comparison compare_pair(const CompareOptions& options, const std::string& output) {
  const Image before = read_picture(options.before), after = read_picture(options.after);
  const ImageDifference difference = compare_images(before, after, options.tolerance);
  Comparison found{difference.is_equal(), difference.passes(options.tolerance), {}, {}};
  found.words = {told(difference, before, after, options.tolerance)};
  found.report = report_of(difference, before, after);
  const std::vector<std::string> remembered = explain_memories(options.before, options.after);
  found.words.insert(found.words.end(), remembered.begin(), remembered.end());
  found.report["explained"] = remembered;
  if (!output.empty()) write_difference(options, before, after, output);
  return found;
}

}  // namespace

Comparison compare_picture_files(const CompareOptions& options) {
  return compare_pair(options, options.output);
}

Comparison compare_folders(const CompareOptions& options) {
  const std::set<std::string> before = pictures_in(options.before), after = pictures_in(options.after);
  for (const auto& [names, folder] : {std::pair(&before, options.before), std::pair(&after, options.after)})
    if (names->empty()) throw Error(ExitCode::bad_input, "holds no .png", {folder});
  std::set<std::string> all = before;
  all.insert(after.begin(), after.end());
  Comparison found;
  found.report["pictures"] = Json::array();
  std::map<std::string, int> counts;
  for (const std::string& name : all) {
    throw_if_interrupted();
    Json entry{{"name", name}};
    std::string state;
    std::vector<std::string> words;
    if (!after.contains(name) || !before.contains(name)) {
      state = before.contains(name) ? "gone" : "added";
      found.equal = found.passes = false;
    } else {
      CompareOptions pair = options;
      pair.before = (fs::path(options.before) / name).string();
      pair.after = (fs::path(options.after) / name).string();
      Comparison one = compare_pair(pair, "");
      // Only now, so that folders hold what there is to look at and nothing else.
      if (!one.equal && !options.output.empty())
        write_difference(options, read_picture(pair.before), read_picture(pair.after),
                         (fs::path(options.output) / name).string());
      state = one.equal ? "equal" : one.passes ? "within tolerance" : "differs";
      found.equal = found.equal && one.equal;
      found.passes = found.passes && one.passes;
      words = one.words;
      entry.update(one.report);
    }
    entry["state"] = state;
    found.report["pictures"].push_back(entry);
    ++counts[state];
    if (state == "equal") continue;
    found.words.push_back(name + ": " + state + (words.empty() ? "" : ": " + words.front()));
    for (std::size_t i = 1; i < words.size(); ++i) found.words.push_back("  " + words[i]);
  }
  std::string sum;
  for (const auto& [state, count] : counts)
    sum += (sum.empty() ? "" : ", ") + std::to_string(count) + " " + state;
  found.words.push_back(sum);
  for (const auto& [state, count] : counts) found.report["counts"][state] = count;
  return found;
}

}  // namespace chainreel
