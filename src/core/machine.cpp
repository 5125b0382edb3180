#include "core/machine.hpp"

#include <malloc.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {

std::string value_in_file(const char* path, const std::string& key, char separator) {
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t at = line.find_first_not_of(" \t\"", line.find(separator) + 1);
    return at == std::string::npos ? "" : line.substr(at, line.find_last_not_of('"') + 1 - at);
  }
  return "unknown";
}

std::string processor_name() {
  return value_in_file("/proc/cpuinfo", "model name", ':');
}

std::string system_name() {
  return value_in_file("/etc/os-release", "PRETTY_NAME", '=');
}

std::string compiler_name() {
  return "g++ " __VERSION__;
}

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// The first number of a file; infinite where there is none, or where it says "max".
double number_in(const std::string& path) {
  std::ifstream stream(path);
  double number = 0;
  return stream >> number ? number : kUnlimited;
}

// What this process has taken: its whole address space, or its data.
double taken(int column) {
  std::ifstream stream("/proc/self/statm");
  double pages = 0;
  for (int k = 0; k <= column; ++k) stream >> pages;
  return stream ? pages * double(sysconf(_SC_PAGESIZE)) : 0;
}

double left_by(decltype(RLIMIT_AS) resource, double taken) {
  rlimit limit = {};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  return std::max(0.0, double(limit.rlim_cur) - taken);
}

// Control groups, of both versions: this process's own, as /proc/self/cgroup names them, and that at the root of what a
// container sees. `look` is given the folder of each; of the second version, "", or the controllers that lie there.
void for_each_control_group(const std::function<void(const std::string& folder, const std::string& controllers)>& look) {
  const std::string root = "/sys/fs/cgroup";
  look(root, "");
  for (const char* controller : {"memory", "cpu"}) look(root + "/" + controller, controller);
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string path = line.substr(second + 1), controllers = line.substr(first + 1, second - first - 1);
    if (controllers.empty()) look(root + path, "");
    for (const char* controller : {"memory", "cpu"})
      if (controllers.find(controller) != std::string::npos) look(root + "/" + controller + path, controller);
  }
}

double left_by_control_group() {
  double least = kUnlimited;
  for_each_control_group([&least](const std::string& folder, const std::string& controllers) {
    const bool is_second = controllers.empty();
    if (!is_second && controllers != "memory") return;
    const double limit = number_in(folder + (is_second ? "/memory.max" : "/memory.limit_in_bytes"));
    const double now = number_in(folder + (is_second ? "/memory.current" : "/memory.usage_in_bytes"));
    if (limit < kUnlimited) least = std::min(least, std::max(0.0, limit - (now < kUnlimited ? now : 0)));
  });
  return least;
}

// How many processors' time the control groups allow.
double cores_of_control_group() {
  double least = kUnlimited;
  for_each_control_group([&least](const std::string& folder, const std::string& controllers) {
    double quota = kUnlimited, period = kUnlimited;
    if (controllers.empty()) {
      std::ifstream stream(folder + "/cpu.max");
      if (!(stream >> quota >> period)) return;  // "max 100000"
    } else if (controllers == "cpu") {
      quota = number_in(folder + "/cpu.cfs_quota_us");
      period = number_in(folder + "/cpu.cfs_period_us");
    }
    if (quota > 0 && period > 0 && quota < kUnlimited && period < kUnlimited) least = std::min(least, quota / period);
  });
  return least;
}

std::string gigabytes(double bytes) {
  return format_significant(bytes / 1e9, 2) + " GB";
}

}  // namespace

double memory_limit() {
  const double machine = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  return std::min({machine, left_by(RLIMIT_AS, taken(0)), left_by(RLIMIT_DATA, taken(5)), left_by_control_group()});
}

int usable_cores() {
  cpu_set_t bound;
  const long bound_to = sched_getaffinity(0, sizeof bound, &bound) == 0 ? CPU_COUNT(&bound) : sysconf(_SC_NPROCESSORS_ONLN);
  // Part of a processor's time is worth a thread of its own.
  return std::max(1, int(std::min(double(bound_to), std::ceil(cores_of_control_group()))));
}

void require_memory(double bytes, const std::string& what) {
  const double limit = memory_limit();
  if (bytes <= limit) return;
  throw Error(ExitCode::limit, what + " needs some " + gigabytes(bytes) + " of memory, but there may be " +
                                   gigabytes(limit) + " only");
}

std::string processor_architecture() {
#if defined(__x86_64__)
  return "x86_64";
#elif defined(__aarch64__)
  return "aarch64";
#else
  return "unknown";
#endif
}

void give_large_memory_back() {
  constexpr int kLarge = 1 << 20;  // bytes
  mallopt(M_MMAP_THRESHOLD, kLarge);
  mallopt(M_TRIM_THRESHOLD, kLarge);
}

void give_freed_memory_back() {
  malloc_trim(0);
}

}  // namespace chainreel
