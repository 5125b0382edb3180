// fuzz [--kind KIND] [--cases N] [--seconds S] [--seed N] [--keep FOLDER]: spoilt inputs for the real program. Case k of a
// kind and seed is always the same; a fault is told with what repeats it. Exit 1 where there was one.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <set>

#include "fuzz/subjects.hpp"
#include "fuzz/verdict.hpp"

namespace {

using namespace chainreel;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string kind;  // "": all, in turn
  std::uint64_t cases = 100, seed = 1, first = 0;
  double seconds = 0;  // above 0: instead of a number of cases
  std::string keep;    // where inputs of faults are kept
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i], value = argv[i + 1];
    if (name == "--kind") options.kind = value;
    else if (name == "--cases") options.cases = std::stoull(value);
    else if (name == "--first") options.first = std::stoull(value);
    else if (name == "--seconds") options.seconds = std::stod(value), options.cases = ~std::uint64_t(0);
    else if (name == "--seed") options.seed = std::stoull(value);
    else if (name == "--keep") options.keep = fs::absolute(value).string();
    else throw std::runtime_error("no option " + name);
  }
  return options;
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

// "" or the fault.
std::string try_case(const Case& one, ProgramResult& result) {
  const TemporaryFolder folder;
  fs::create_directory_symlink(fs::absolute("models"), folder.path() / "models");
  for (const auto& [name, text] : one.files) folder.write(name, text);
  const std::set<std::string> before = files_in(folder.path());
  result = run_program(one.arguments, {.folder = folder.path().string(), .environment = {}, .timeout_s = kHang});
  std::vector<std::string> fresh;
  for (const std::string& name : files_in(folder.path()))
    if (!before.contains(name)) fresh.push_back(name);
  if (std::string fault = fault_of(result, fresh); !fault.empty()) return fault;
  for (const auto& [name, text] : one.files)
    if (read_whole_file(folder.path() / name) != text) return "changes its input " + name;
  return "";
}

void tell(const Case& one, const std::string& what, const std::string& fault, const ProgramResult& result, const Options& options) {
  std::printf("%s: %s\n  chainreel", what.c_str(), fault.c_str());
  for (const std::string& word : one.arguments) std::printf(" %.200s", word.c_str());
  std::printf("\n  status %d: %.500s\n", result.status, result.err.c_str());
  std::fflush(stdout);
  if (options.keep.empty()) return;
  std::string name = what;
  for (char& c : name)
    if (c == ' ') c = '_';
  for (const auto& [file, text] : one.files) {
    const fs::path path = fs::path(options.keep) / name / file;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }
}

int run(const Options& options) {
  const std::vector<std::string> kinds = options.kind.empty() ? Subjects::kinds() : std::vector{options.kind};
  Subjects subjects;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
  std::map<std::string, std::map<int, int>> counts;  // of exit codes
  int faults = 0;
  for (std::uint64_t k = options.first; k - options.first < options.cases; ++k) {
    if (options.seconds > 0 && Clock::now() > end) break;
    for (const std::string& kind : kinds) {
      Dice dice(options.seed * 1'000'003 + k * 7919 + std::hash<char>()(kind[0]));
      const Case one = subjects.make(kind, dice);
      ProgramResult result;
      std::string fault = try_case(one, result);
      if (result.timed_out) fault = try_case(one, result);  // others may have had the processor
      ++counts[kind][result.status];
      if (fault.empty()) continue;
      ++faults;
      tell(one, kind + " seed " + std::to_string(options.seed) + " case " + std::to_string(k), fault, result, options);
    }
  }
  for (const auto& [kind, codes] : counts) {
    int all = 0;
    std::string text;
    for (const auto& [code, count] : codes) all += count, text += "  " + std::to_string(code) + ": " + std::to_string(count);
    std::printf("%-14s %6d cases; exit codes%s\n", kind.c_str(), all, text.c_str());
  }
  std::printf("%d faults\n", faults);
  return faults == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(read_options(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fuzz: %s\n", error.what());
    return 2;
  }
}
