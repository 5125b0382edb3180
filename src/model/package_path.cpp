#include "model/package_path.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "core/error.hpp"
#include "model/xml_text.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

// How deep a package's own folders are searched for one that stands deeper, and how many are looked at.
constexpr int kDeepest = 3, kMostLookedAt = 5000;

// The <name> of a package.xml, or "" where it has none or is broken: another place may still be right.
std::string name_in(const fs::path& package_xml) {
  try {
    const std::string text = read_xml_text(package_xml.string());
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) return "";
    const tinyxml2::XMLElement* root = document.RootElement();
    const tinyxml2::XMLElement* name = root == nullptr ? nullptr : root->FirstChildElement("name");
    const char* words = name == nullptr ? nullptr : name->GetText();
    return words == nullptr ? "" : words;
  } catch (const Error&) {
    return "";
  }
}

std::vector<std::string> folders_in(const char* variable) {
  std::vector<std::string> folders;
  const char* value = std::getenv(variable);
  std::string_view rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) folders.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return folders;
}

int hex_digit(char c) {
  const std::string_view digits = "0123456789abcdef";
  return int(digits.find(c >= 'A' && c <= 'F' ? char(c + 32) : c));
}

// %20 and the like in a file:// address.
std::string decoded(std::string_view address) {
  std::string path;
  for (std::size_t i = 0; i < address.size(); ++i) {
    const bool escaped = address[i] == '%' && i + 2 < address.size() && hex_digit(address[i + 1]) >= 0 &&
                         hex_digit(address[i + 2]) >= 0;
    path += escaped ? char(16 * hex_digit(address[i + 1]) + hex_digit(address[i + 2])) : address[i];
    if (escaped) i += 2;
  }
  return path;
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

}  // namespace

FileFinder::FileFinder(const std::string& urdf_path, std::map<std::string, std::string> packages)
    : packages_(std::move(packages)) {
  std::error_code ignored;
  folder_ = fs::absolute(urdf_path, ignored).lexically_normal().parent_path().string();
  for (fs::path at = folder_;; at = at.parent_path()) {
    if (is_file((at / "package.xml").string())) {
      package_folder_ = at.string();
      package_name_ = name_in(at / "package.xml");
      return;
    }
    if (at == at.parent_path()) return;
  }
}

std::vector<std::string> FileFinder::own_folders(const std::string& package) const {
  std::vector<std::string> folders;
  const auto given = packages_.find(package);
  if (given != packages_.end()) folders.push_back(given->second);
  if (!package_folder_.empty() && package_name_ == package) folders.push_back(package_folder_);
  for (fs::path at = folder_; at != at.parent_path(); at = at.parent_path()) {
    if (at.filename() != package) continue;
    folders.push_back(at.string());
    break;
  }
  return folders;
}

std::vector<std::string> FileFinder::package_folders(const std::string& package) const {
  std::vector<std::string> folders = own_folders(package);
  for (const std::string& folder : folders_in("ROS_PACKAGE_PATH")) {
    const bool is_itself = fs::path(folder).filename() == package;
    folders.push_back(is_itself ? folder : (fs::path(folder) / package).string());
  }
  for (const std::string& folder : folders_in("AMENT_PREFIX_PATH"))
    folders.push_back((fs::path(folder) / "share" / package).string());
  return folders;
}

const std::vector<std::string>& FileFinder::deeper_folders(const std::string& package) {
  const auto [entry, is_new] = deeper_.emplace(package, std::vector<std::string>{});
  std::vector<std::string>& found = entry->second;
  if (!is_new) return found;
  int looked_at = 0;
  for (const std::string& folder : own_folders(package)) {
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && at != fs::recursive_directory_iterator() && ++looked_at < kMostLookedAt; at.increment(error)) {
      std::error_code ignored;
      if (!at->is_directory(ignored) || at->is_symlink(ignored)) continue;
      if (at->path().filename() == package) found.push_back(at->path().string());
      if (at.depth() + 1 >= kDeepest) at.disable_recursion_pending();
    }
  }
  std::sort(found.begin(), found.end());  // a folder's order is the file system's own
  return found;
}

std::string FileFinder::find_by_tail(const std::string& package, const std::string& inside) {
  for (const std::string& folder : deeper_folders(package))
    if (const std::string place = (fs::path(folder) / inside).string(); is_file(place)) return place;
  const fs::path path(inside);
  for (fs::path at = folder_; at != at.parent_path(); at = at.parent_path()) {
    for (auto step = path.begin(); step != path.end(); ++step) {
      if (*step != at.filename()) continue;
      fs::path place = at;
      for (auto rest = std::next(step); rest != path.end(); ++rest) place /= *rest;
      if (is_file(place.string())) return place.string();
    }
  }
  return "";
}

const FoundFile& FileFinder::find(const std::string& name) {
  const auto [entry, is_new] = known_.emplace(name, FoundFile{});
  FoundFile& file = entry->second;
  if (!is_new) return file;

  const std::size_t scheme_end = name.find("://");
  const std::string scheme = scheme_end == std::string::npos ? "" : name.substr(0, scheme_end);
  const std::string rest = scheme_end == std::string::npos ? name : name.substr(scheme_end + 3);
  if (scheme == "package") {
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string package = rest.substr(0, slash);
    const fs::path inside = rest.substr(std::min(slash + 1, rest.size()));
    if (package.empty()) {
      file.remedy = "the address names no package: write package://NAME/PATH, or a path from the folder of the URDF";
      return file;
    }
    for (const std::string& folder : package_folders(package))
      file.searched.push_back((folder / inside).string());
    file.remedy = "say where the package lies with `--package " + package + "=FOLDER`";
  } else if (scheme == "file") {
    file.searched.push_back(decoded(rest));
    file.remedy = "correct the path";
  } else if (scheme.empty()) {
    file.searched.push_back((fs::path(folder_) / rest).lexically_normal().string());
    file.remedy = "correct the path, which counts from the folder of the URDF";
  } else {
    file.remedy = "only package://, file:// and plain paths are read: copy the file and name its path";
  }
  for (const std::string& place : file.searched) {
    if (!is_file(place)) continue;
    file.path = place;
    return file;
  }
  if (scheme != "package") return file;
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  file.path = find_by_tail(rest.substr(0, slash), rest.substr(std::min(slash + 1, rest.size())));
  file.by_tail = !file.path.empty();
  return file;
}

std::string missing_mesh_message(const std::string& link, const std::string& name, const FoundFile& found) {
  std::string places;
  for (const std::string& place : found.searched) places += (places.empty() ? "" : ", ") + place;
  return "link '" + link + "': the mesh '" + name + "' is not found (" +
         (places.empty() ? "no place to search" : "searched " + places) + "): " + found.remedy;
}

}  // namespace chainreel
