#include "bench/results.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "core/format.hpp"
#include "core/machine.hpp"
#include "support/run_program.hpp"

namespace chainreel::bench {
namespace {

std::string vector_units() {
  const std::string flags = " " + value_in_file("/proc/cpuinfo", "flags", ':') + " ";
  std::string units;
  for (const char* flag : {"sse4_2", "avx", "fma", "avx2", "avx512f"})
    if (flags.find(std::string(" ") + flag + " ") != std::string::npos)
      units += (units.empty() ? "" : " ") + std::string(flag);
  return units;
}

std::string load() {
  double minutes[1] = {};
  return getloadavg(minutes, 1) == 1 ? format_fixed(minutes[0], 1) : "unknown";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}

// Of the source tree; with uncommitted changes it ends in -dirty.
std::string revision() {
  const ProgramResult git =
      run_command({"git", "-C", CHAINREEL_SOURCE_FOLDER, "describe", "--always", "--dirty", "--exclude=*"});
  return git.status == 0 ? git.out.substr(0, git.out.find('\n')) : "unknown";
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + cell;
  return line;
}

}  // namespace

Facts machine_facts() {
  return {{"date", today()},
          {"revision", revision()},
          {"processor", processor_name()},
          {"vector units", vector_units()},
          {"cores", std::to_string(std::thread::hardware_concurrency())},
          {"load at the start", load()},
          {"system", system_name()},
          {"compiler", compiler_name()},
          {"flags", CHAINREEL_BENCH_FLAGS}};
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double median_of(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("no values");
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Results::Results(std::string name, std::vector<std::string> columns)
    : name_(std::move(name)), facts_(machine_facts()), rows_{std::move(columns)} {}

void Results::add(std::vector<std::string> row) {
  if (row.size() != rows_.front().size()) throw std::invalid_argument("a row of another length");
  rows_.push_back(std::move(row));
}

void Results::write() const {
  const std::filesystem::path folder = CHAINREEL_SOURCE_FOLDER "/tests/bench/results";
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = folder / (name_ + ".csv");
  std::ofstream stream(path);
  for (const auto& [what, value] : facts_) stream << "# " << what << ": " << value << "\n";
  for (const std::vector<std::string>& row : rows_) stream << joined(row) << "\n";
  if (!stream.flush()) throw std::runtime_error("cannot write " + path.string());
  std::printf("written: %s\n", path.c_str());
}

int run_main(void (*run)()) {
  try {
    run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace chainreel::bench
