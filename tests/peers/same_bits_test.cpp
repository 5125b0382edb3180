// The same bits on every machine: trajectories computed here, with the C library told to do without FMA and
// AVX2, and on emulated processors with and without them have the same SHA-256. QEMU does every operation of
// IEEE 754 exactly, so what differs can only be which operations were done: by the compiler's choice or by a library's.
#include <gmock/gmock.h>

#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kTrajectories = CHAINREEL_TRAJECTORY_HASHES;
const std::string kCLibrary = CHAINREEL_C_LIBRARY_HASH;

struct Machine {
  std::string name;
  std::string emulated;  // QEMU's name of the processor; "": the one that we run on
  std::string tunables;  // of the C library

  friend std::ostream& operator<<(std::ostream& out, const Machine& machine) { return out << machine.name; }
};

const Machine kHere = {"Here", "", ""};
const Machine kOldest = {"Oldest", "qemu64", ""};  // SSE2 and SSE3
const Machine kNewest = {"Newest", "max", ""};     // all that QEMU can do: AVX2, FMA
const std::vector<Machine> kOthers = {
    {"WithoutFmaAndAvx2", "", "glibc.cpu.hwcaps=-FMA,-AVX2"},
    kOldest,
    kNewest,
};

std::string output_on(const Machine& machine, std::vector<std::string> command) {
  if (!machine.emulated.empty()) command.insert(command.begin(), {"qemu-x86_64", "-cpu", machine.emulated});
  RunOptions options;
  options.folder = CHAINREEL_SOURCE_FOLDER;
  options.timeout_s = 300;
  if (!machine.tunables.empty()) options.environment["GLIBC_TUNABLES"] = machine.tunables;
  const ProgramResult result = run_command(command, options);
  EXPECT_EQ(result.status, 0) << machine.name << ": " << result.err;
  EXPECT_FALSE(result.timed_out) << machine.name;
  return result.out;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class OnMachine : public ::testing::TestWithParam<Machine> {};
INSTANTIATE_TEST_SUITE_P(SameBits, OnMachine, ::testing::ValuesIn(kOthers),
                         [](const auto& p) { return p.param.name; });

TEST_P(OnMachine, TrajectoriesHaveTheHashesThatTheyHaveHere) {
  const std::string here = output_on(kHere, {kTrajectories});
  EXPECT_THAT(here, AllOf(HasSubstr("rrr rk4"), HasSubstr("arm7_floating"), Not(HasSubstr("diverged"))));
  EXPECT_EQ(output_on(GetParam(), {kTrajectories}), here);
}

// Negative control: every run's hash is of what it computed.
TEST(SameBits, AnotherStepGivesAnotherHashOfEveryRun) {
  const std::vector<std::string> one = lines_of(output_on(kHere, {kTrajectories, "0.002"}));
  const std::vector<std::string> other = lines_of(output_on(kHere, {kTrajectories, "0.0021"}));
  ASSERT_EQ(one.size(), other.size());
  ASSERT_GT(one.size(), 15u);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NE(one[i], other[i]);
  EXPECT_EQ(std::set<std::string>(one.begin(), one.end()).size(), one.size());
}

// Negative control: the machines do differ, for programs that take the C library's functions.
TEST(SameBits, TheCLibraryDiffersBetweenTheseProcessors) {
  const std::string with_fma = output_on(kNewest, {kCLibrary});
  EXPECT_NE(output_on(kOldest, {kCLibrary}), with_fma);
  EXPECT_EQ(output_on(kNewest, {kCLibrary}), with_fma);
  // What the tunables switch off here is what the oldest processor lacks.
  EXPECT_EQ(output_on(kOthers.front(), {kCLibrary}), output_on(kOldest, {kCLibrary}));
}

}  // namespace
}  // namespace chainreel
