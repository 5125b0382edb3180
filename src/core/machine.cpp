#include "core/machine.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
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
// container sees.
double left_by_control_group() {
  double least = kUnlimited;
  const auto look = [&least](const std::string& folder, const char* most, const char* used) {
    const double limit = number_in(folder + most), now = number_in(folder + used);
    if (limit < kUnlimited) least = std::min(least, std::max(0.0, limit - (now < kUnlimited ? now : 0)));
  };
  look("/sys/fs/cgroup", "/memory.max", "/memory.current");
  look("/sys/fs/cgroup/memory", "/memory.limit_in_bytes", "/memory.usage_in_bytes");
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string path = line.substr(second + 1), controllers = line.substr(first + 1, second - first - 1);
    if (controllers.empty()) look("/sys/fs/cgroup" + path, "/memory.max", "/memory.current");
    if (controllers.find("memory") != std::string::npos)
      look("/sys/fs/cgroup/memory" + path, "/memory.limit_in_bytes", "/memory.usage_in_bytes");
  }
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

void require_memory(double bytes, const std::string& what) {
  const double limit = memory_limit();
  if (bytes <= limit) return;
  throw Error(ExitCode::limit, what + " needs some " + gigabytes(bytes) + " of memory, but there may be " +
                                   gigabytes(limit) + " only");
}

std::string processor_features() {
  std::string features;
#ifdef __x86_64__
  __builtin_cpu_init();
  const auto add = [&](bool there, const char* name) {
    if (there) features += (features.empty() ? "" : " ") + std::string(name);
  };
  add(__builtin_cpu_supports("sse4.1"), "sse4.1");
  add(__builtin_cpu_supports("avx"), "avx");
  add(__builtin_cpu_supports("avx2"), "avx2");
  add(__builtin_cpu_supports("fma"), "fma");
  add(__builtin_cpu_supports("avx512f"), "avx512f");
  add(__builtin_cpu_supports("avx512dq"), "avx512dq");
  add(__builtin_cpu_supports("avx512vl"), "avx512vl");
#endif
  return features;
}

void prefer_large_pages(void* begin, std::size_t bytes) {
  constexpr std::uintptr_t kPage = 4096, kLarge = 1 << 21;
  if (bytes < 2 * kLarge) return;  // may hold no large page
  const auto first = (reinterpret_cast<std::uintptr_t>(begin) + kPage - 1) / kPage * kPage;
  const auto end = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / kPage * kPage;
  // A refusal leaves small pages, which serve as well.
  if (end > first) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
}

}  // namespace chainreel
