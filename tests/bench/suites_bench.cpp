// What pictures cost as a user has them: a suite verified in one process, one picture by a process of its
// own, two pictures compared.
//
// Rule: each command runs once to write what it needs and to fill the system's caches, then in turn with the
// others, round after round; reported are the median and the least time by the clock, and the median
// processor time. Panda's pictures need the environment variable CHAINREEL_ROBOTS.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "bench/results.hpp"
#include "core/format.hpp"
#include "support/public_robots.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel::bench {
namespace {

constexpr int kRounds = 7;

struct Case {
  std::string name;
  Words command;
  double goal_ms;  // 0: none
  int status = 0;
  std::vector<double> clock_ms{}, spent_ms{};
};

double children_seconds() {
  rusage spent{};
  getrusage(RUSAGE_CHILDREN, &spent);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(spent.ru_utime) + seconds(spent.ru_stime);
}

void run_once(const Case& one) {
  const ProgramResult result = run_command(one.command);
  if (result.status != one.status) throw std::runtime_error(one.name + ": " + result.err);
}

void time_once(Case& one) {
  const double spent = children_seconds();
  const auto begin = std::chrono::steady_clock::now();
  run_once(one);
  const std::chrono::duration<double, std::milli> clock = std::chrono::steady_clock::now() - begin;
  one.clock_ms.push_back(clock.count());
  one.spent_ms.push_back(1e3 * (children_seconds() - spent));
}

// A suite of `count` poses of a model, each joint of `joints` from 0 on by its own steps, without baselines.
std::string write_suite(const TemporaryFolder& folder, const std::string& name, const std::string& model,
                        const std::string& size, int count,
                        const std::vector<std::pair<double, double>>& joints) {
  const std::string path = folder.file(name);
  std::ofstream suite(path);
  suite << "model: " << model << "\nsize: " << size << "\nposes:\n";
  for (int pose = 0; pose < count; ++pose) {
    suite << "  pose" << pose << ": [";
    for (std::size_t i = 0; i < joints.size(); ++i)
      suite << (i == 0 ? "" : ", ")
            << format_shortest(joints[i].first + (joints[i].second - joints[i].first) * pose / count);
    suite << "]\n";
  }
  return path;
}

std::vector<Case> cases_in(const TemporaryFolder& folder) {
  const std::string program = program_path(), models = CHAINREEL_SOURCE_FOLDER "/models/";
  const auto snapshot = [&](const std::string& of, const Words& more, const std::string& to, int width,
                            int height) {
    return with({program, "snapshot", of, "-o", folder.file(to), "--force", "--quiet", "--width",
                 std::to_string(width), "--height", std::to_string(height)},
                more);
  };
  const auto verify = [&](const std::string& suite) { return Words{program, "verify", suite, "--quiet"}; };
  const std::string rr = models + "rr.urdf", scene = CHAINREEL_SOURCE_FOLDER "/assets/scenes/rr_torque.yaml";

  std::vector<Case> cases;
  // Written by the first run, then verified.
  const auto add_suite = [&](const std::string& name, const std::string& suite, double goal_ms) {
    run_once({name, with(verify(suite), {"--missing", "write"}), 0});
    cases.push_back({name, verify(suite), goal_ms});
  };
  add_suite(
      "verify 100 planar pictures 640x360",
      write_suite(folder, "planar.yaml", models + "rrr.urdf", "640x360", 100, {{0, 3}, {-1, 2}, {1, -2}}),
      4000);
  cases.push_back(
      {"snapshot of a pose 640x360", snapshot(rr, {"--pose", "0,40deg"}, "pose.png", 640, 360), 70});
  cases.push_back(
      {"snapshot of a scene 640x360", snapshot(scene, {"--at", "1.2"}, "scene.png", 640, 360), 0});
  for (const auto& [instant, to] : {std::pair("0.2", "a.png"), {"7.3", "b.png"}})
    run_once({to, snapshot(scene, {"--at", instant}, to, 1920, 1080), 0});
  run_once({"copy", {"cp", folder.file("a.png"), folder.file("copy.png")}, 0});
  const auto compare = [&](const std::string& b) {
    return Words{program, "compare", folder.file("a.png"), folder.file(b)};
  };
  cases.push_back({"compare two of 1920x1080", compare("b.png"), 30, 1});
  cases.push_back({"compare two of 1920x1080, the same", compare("copy.png"), 30});

  if (const std::string robots = public_robots_folder(); !robots.empty()) {
    const std::string panda = robots + "/panda_description/urdf/panda.urdf";
    add_suite("verify 24 pictures of panda 640x480",
              write_suite(folder, "panda.yaml", panda, "640x480", 24,
                          {{-1, 1}, {0, 1}, {-1, 1}, {-2, -1}, {0, 1}, {1, 2}, {0, 1}, {0, 0.04}}),
              6000);
    cases.push_back({"snapshot of panda 640x480",
                     snapshot(panda, {"--pose", "0,0.2,0,-1.5,0,1.5,0,0.02"}, "panda.png", 640, 480), 250});
  } else {
    std::printf("panda is left out: %s\n", kNoRobots);
  }
  return cases;
}

void run() {
  const TemporaryFolder folder;
  std::vector<Case> cases = cases_in(folder);
  for (const Case& one : cases) run_once(one);
  for (int round = 0; round < kRounds; ++round)
    for (Case& one : cases) time_once(one);
  Results results("suites", {"case", "clock_ms", "least_clock_ms", "processor_ms", "goal_ms"});
  std::printf("%-38s %10s %10s %12s %8s\n", "case, ms", "clock", "least", "processor", "goal");
  for (const Case& one : cases) {
    const std::vector<std::string> row = {
        one.name, format_fixed(median_of(one.clock_ms), 1),
        format_fixed(*std::min_element(one.clock_ms.begin(), one.clock_ms.end()), 1),
        format_fixed(median_of(one.spent_ms), 1), one.goal_ms > 0 ? format_fixed(one.goal_ms, 0) : ""};
    std::printf("%-38s %10s %10s %12s %8s\n", row[0].c_str(), row[1].c_str(), row[2].c_str(), row[3].c_str(),
                row[4].c_str());
    results.add(row);
  }
  results.write();
}

}  // namespace
}  // namespace chainreel::bench

int main() {
  return chainreel::bench::run_main(chainreel::bench::run);
}
