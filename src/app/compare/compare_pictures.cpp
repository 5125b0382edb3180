// Two pictures, and two folders of them.

#include <algorithm>
#include <filesystem>
#include <future>
#include <map>
#include <set>
#include <string_view>

#include "app/cli/streams.hpp"
#include "app/compare/comparison.hpp"
#include "app/report/compared_picture.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// A picture's file, and what its first chunks say of it.
struct PictureFile {
  std::string path, bytes;
  explicit PictureFile(const std::string& from) : path(from), bytes(read_plain_file(from)) {
    note_input(path);
  }

  bool has_sixteen_bits() const { return bytes.size() > 24 && bytes[24] == 16; }  // depth in IHDR
  // Chunks up to the pixels: length, name, that many bytes and a checksum each, behind eight bytes of
  // signature.
  bool is_animated() const {
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
      const std::string_view name = std::string_view(bytes).substr(at + 4, 4);
      if (name == "acTL") return true;
      if (name == "IDAT") return false;
      std::size_t length = 0;
      for (std::size_t i = 0; i < 4; ++i) length = 256 * length + static_cast<unsigned char>(bytes[at + i]);
      at += length + 12;
    }
    return false;
  }
  Image pixels() const {
    if (is_animated())
      throw Error(ExitCode::bad_input, "is an animated picture: named .apng, all its frames are compared",
                  {path});
    return decode_png(bytes, path);
  }
};

// PNGs in a folder and in those below it, as it sees them; hidden ones are left out.
std::set<std::string> pictures_in(const std::string& folder) {
  std::set<std::string> names;
  std::error_code trouble;
  for (fs::recursive_directory_iterator entry(folder, trouble), end; !trouble && entry != end;
       entry.increment(trouble)) {
    const fs::path name = entry->path().lexically_relative(folder);
    if (name.filename().string().front() == '.') {
      if (entry->is_directory(trouble)) entry.disable_recursion_pending();
    } else if (ends_in(name.string(), {".png"})) {
      names.insert(name.generic_string());
    }
  }
  if (trouble) throw Error(ExitCode::bad_input, "cannot be listed: " + trouble.message(), {folder});
  return names;
}

Comparison compare_pair(const CompareOptions& options, const std::string& output) {
  const PictureFile old_file(options.before), new_file(options.after);
  std::future<Image> reading;  // at the same time as the other; the same bytes are the same picture
  if (old_file.bytes != new_file.bytes)
    reading = std::async(std::launch::async, [&] { return new_file.pixels(); });
  const Image before = old_file.pixels(), other = reading.valid() ? reading.get() : Image();
  const Image& after = old_file.bytes == new_file.bytes ? before : other;
  const ImageDifference difference = compare_images(before, after, options.tolerance);
  Comparison found{difference.is_equal(), difference.passes(options.tolerance), {}, {}};
  found.words = {told(difference, before, after, options.tolerance)};
  found.report = report_of(difference, before, after);
  if (old_file.has_sixteen_bits() || new_file.has_sixteen_bits())
    found.words.push_back("channels of 16 bits are compared as those of 8");
  const std::vector<std::string> remembered = explain_memories(options.before, options.after);
  found.words.insert(found.words.end(), remembered.begin(), remembered.end());
  found.report["explained"] = remembered;
  if (!found.equal && found.passes)
    found.words.push_back("within the tolerance, which exit code 0 means: --tolerance 0 --count-edges takes every pixel for a difference");
  else if (found.equal && std::ranges::any_of(remembered, [](const std::string& words) { return words.ends_with(kByHash); }))
    found.words.push_back("the pixels do not show it, and they alone are judged: `verify` judges what stands behind pictures, "
                          "`compare` of two .urdf files models");
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
    const std::string shown = options.output.empty() ? "" : (fs::path(options.output) / name).string();
    bool has_difference = false;
    if (!after.contains(name) || !before.contains(name)) {
      state = before.contains(name) ? "gone" : "added";
      found.equal = found.passes = false;
    } else {
      CompareOptions pair = options;
      pair.before = (fs::path(options.before) / name).string();
      pair.after = (fs::path(options.after) / name).string();
      Comparison one = compare_pair(pair, "");
      // Only now, so that folders hold what there is to look at and nothing else.
      has_difference = !one.equal;
      if (has_difference && !shown.empty())
        write_difference(options, read_png(pair.before), read_png(pair.after), shown);
      state = one.equal ? "equal" : one.passes ? "within tolerance" : "differs";
      found.equal = found.equal && one.equal;
      found.passes = found.passes && one.passes;
      words = one.words;
      entry.update(one.report);
    }
    if (!has_difference && !shown.empty()) remove_compared_picture(shown);  // of an earlier run
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
