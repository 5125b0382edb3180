#include "house/include_arrows.hpp"

#include <algorithm>
#include <fstream>
#include <regex>

namespace chainreel {
namespace fs = std::filesystem;
namespace {

// POSIX, the compiler and the processor: open to every folder.
const std::set<std::string> kSystemHeaders = {
    "cpuid.h",        "dlfcn.h",    "elf.h",      "emmintrin.h", "fcntl.h",    "fnmatch.h",    "immintrin.h", "malloc.h", "poll.h",
    "link.h",         "pthread.h",      "quadmath.h", "sched.h",     "signal.h",   "spawn.h",     "sys/mman.h",
    "linux/fs.h",     "sys/auxv.h", "sys/file.h", "sys/ioctl.h", "sys/syscall.h", "sys/random.h", "sys/resource.h", "sys/stat.h", "sys/types.h", "sys/wait.h", "unistd.h"};

bool is_standard_or_system(const std::string& header) {
  return header.find_first_of("./") == std::string::npos || kSystemHeaders.contains(header);
}

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// What is wrong with a <header> in `folder`, or "".
std::string library_fault(const House& house, const std::string& folder, const std::string& header) {
  if (is_standard_or_system(header)) return "";
  for (const auto& [start, folders] : house.libraries)
    if (header.starts_with(start))
      return folders.contains(folder) ? ""
                                      : "<" + header + "> may be included by " + joined(folders) + " alone";
  return "<" + header + "> has no place in the house yet: name the folder that may include it";
}

// What is wrong with a "header" of our own in `folder`, or "". A name without a folder is a neighbour.
std::string arrow_fault(const House& house, const std::string& folder, const std::string& header) {
  const std::size_t slash = header.find('/');
  if (slash == std::string::npos) return "";
  const std::string target = header.substr(0, slash);
  if (!house.uses.contains(target)) return "\"" + header + "\" is not in a folder of the house";
  if (reachable(house.uses, folder).contains(target)) return "";
  return "\"" + header + "\": " + folder + " may not include " + target;
}

// The shelf on which room/shelf/file stands; "" for room/file.
std::string shelf_of(const std::string& path) {
  const std::size_t begin = path.find('/') + 1, end = path.find('/', begin);
  return end == std::string::npos ? "" : path.substr(begin, end - begin);
}

// What is wrong with a "header" that stands in the room of the file `name`, or "".
std::string shelf_fault(const House& house, const std::string& name, const std::string& header) {
  const std::string room = name.substr(0, name.find('/'));
  const auto shelves = house.shelves.find(room);
  if (shelves == house.shelves.end() || !header.starts_with(room + "/")) return "";
  const std::string from = shelf_of(name), to = shelf_of(header);
  if (!shelves->second.contains(from)) return "";  // is told once, of the file
  if (!shelves->second.contains(to)) return "\"" + header + "\" is on no shelf of " + room;
  if (reachable(shelves->second, from).contains(to)) return "";
  return "\"" + header + "\": within " + room + " " + from + " may not include " + to;
}

bool is_source(const fs::path& path) {
  static const std::set<std::string> endings = {".hpp", ".cpp", ".h", ".c", ".ipp", ".inl"};
  return endings.contains(path.extension().string());
}

void check_file(const House& house, const fs::path& src, const fs::path& path, IncludeReport& report) {
  static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  const fs::path name = path.lexically_relative(src);
  const std::string folder = name.begin()->string();
  ++report.files;
  if (!house.uses.contains(folder)) {
    report.faults.push_back(name.string() + ": " + folder + " is not a folder of the house");
    return;
  }
  const auto shelves = house.shelves.find(folder);
  if (shelves != house.shelves.end() && !shelves->second.contains(shelf_of(name.string())))
    report.faults.push_back(name.string() + ": is on no shelf of " + folder);
  std::ifstream stream(path);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    std::smatch match;
    if (!std::regex_search(line, match, include)) continue;
    ++report.includes;
    const std::string header = match[2];
    std::string fault =
        match[1] == "<" ? library_fault(house, folder, header) : arrow_fault(house, folder, header);
    if (fault.empty()) fault = shelf_fault(house, name.string(), header);
    if (!fault.empty()) report.faults.push_back(name.string() + ":" + std::to_string(number) + ": " + fault);
  }
}

}  // namespace

const House& house() {
  static const House instance = [] {
    House h;
    h.uses = {{"core", {}},
              {"compare", {"core"}},
              {"table", {"core"}},
              {"expr", {"core"}},
              {"mesh", {"core"}},
              {"integrate", {"core"}},
              {"picture", {"core"}},
              {"encode", {"core"}},
              {"model", {"core", "mesh"}},
              {"dynamics", {"model"}},
              {"symbols", {"dynamics"}},
              {"render", {"picture", "mesh"}},
              {"sim", {"dynamics", "integrate", "expr"}},
              {"scene", {"sim"}},
              {"draw", {"scene", "picture"}},
              {"app", {"draw", "render", "encode", "compare", "symbols", "table"}},
              {"python", {"app"}}};
    h.libraries = {{"nlohmann/", {"core"}},
                   {"openssl/", {"core"}},
                   {"assimp/", {"mesh"}},
                   {"ginac/", {"symbols"}},
                   {"cln/", {"symbols"}},
                   {"hb", {"picture"}},
                   {"fribidi/", {"picture"}},
                   {"ft2build.h", {"picture", "render"}},
                   {"freetype/", {"picture", "render"}},
                   {"libav", {"encode"}},
                   {"libsw", {"encode"}},
                   {"libdeflate.h", {"encode"}},
                   {"png.h", {"encode", "mesh"}},
                   {"jpeglib.h", {"mesh"}},
                   {"zlib.h", {"encode"}},
                   {"minizip/", {"table"}},
                   {"libimagequant.h", {"encode"}},
                   {"x264.h", {"encode"}},
                   {"urdf_", {"model"}},
                   {"console_bridge/", {"model"}},
                   {"tinyxml2.h", {"app", "model"}},
                   {"GL/", {"render"}},
                   {"EGL/", {"render"}},
                   {"cairo", {"render"}},
                   {"yaml-cpp/", {"scene"}},
                   {"CLI/", {"app"}},
                   {"pybind11/", {"python"}}};
    // "" are the files that stand in the room itself.
    h.shelves["draw"] = {{"robot", {}},        {"page", {"robot"}},     {"layers", {"page"}},
                         {"film", {"layers"}}, {"figures", {"layers"}}, {"charts", {"page"}}};
    h.shelves["sim"] = {
        {"drive", {}}, {"system", {"drive"}}, {"watch", {"system"}}, {"", {"watch"}}, {"choice", {""}}};
    h.shelves["scene"] = {{"", {}}, {"keys", {""}}, {"text", {"keys"}}, {"run", {"text"}}};
    h.shelves["app"] = {{"cli", {}},
                        {"film", {"cli"}},
                        {"report", {"film"}},
                        {"guide", {"film"}},
                        {"gallery", {"report"}},
                        {"verify", {"report"}},
                        {"works", {"report"}},
                        {"library", {"works"}},
                        {"paper", {"film"}},
                        {"sweep", {"works"}},
                        {"compare", {"verify"}},
                        {"today", {"paper", "compare", "works"}},
                        {"commands", {"works", "guide", "gallery", "sweep", "today"}},
                        {"", {"commands"}}};
    // Eigen is the language of everything below scene.
    for (const auto& [folder, below] : h.uses)
      if (folder != "scene" && folder != "draw" && folder != "app" && folder != "python") h.libraries["Eigen/"].insert(folder);
    return h;
  }();
  return instance;
}

std::set<std::string> reachable(const std::map<std::string, std::set<std::string>>& uses, const std::string& folder) {
  std::set<std::string> found = {folder};
  std::vector<std::string> open = {folder};
  while (!open.empty()) {
    const std::string next = open.back();
    open.pop_back();
    for (const std::string& below : uses.at(next))
      if (found.insert(below).second) open.push_back(below);
  }
  return found;
}

IncludeReport check_includes(const House& house, const fs::path& src) {
  IncludeReport report;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(src))
    if (entry.is_regular_file() && is_source(entry.path())) check_file(house, src, entry.path(), report);
  std::sort(report.faults.begin(), report.faults.end());
  return report;
}

}  // namespace chainreel
