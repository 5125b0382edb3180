// What holds for the tree as a whole.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "house/packages.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSubsetOf;
using testing::UnorderedElementsAre;

const fs::path kRoot = CHAINREEL_SOURCE_FOLDER;
constexpr int kLongestFile = 500;  // lines; beyond it a file holds more than one thing

std::vector<std::string> shaders_without_partner(const fs::path& folder) {
  std::vector<std::string> alone;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    fs::path partner = entry.path();
    if (partner.extension() != ".vert" && partner.extension() != ".frag") continue;
    partner.replace_extension(entry.path().extension() == ".vert" ? ".frag" : ".vert");
    if (!fs::exists(partner)) alone.push_back(entry.path().filename().string());
  }
  return alone;
}

std::vector<std::string> files_longer_than(const fs::path& folder, int lines) {
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string text = read_whole_file(entry.path());
    if (std::count(text.begin(), text.end(), '\n') > lines) found.push_back(entry.path().filename().string());
  }
  return found;
}

std::set<std::string> all_packages() {
  std::set<std::string> all;
  for (const auto& [section, packages] : read_packages(read_whole_file(kRoot / "packages.txt")))
    all.insert(packages.begin(), packages.end());
  return all;
}

TEST(House, EveryVertexShaderHasItsFragmentShader) {
  EXPECT_THAT(shaders_without_partner(kRoot / "shaders"), IsEmpty());
}

TEST(House, NoSourceFileIsTooLongToRead) {
  EXPECT_THAT(files_longer_than(kRoot / "src", kLongestFile), IsEmpty());
}

TEST(House, TheReadmeAsksForNoPackageThatTheListLacks) {
  EXPECT_THAT(packages_named_by(read_whole_file(kRoot / "README.md")), IsSubsetOf(all_packages()));
}

TEST(House, NoPackageStandsInTwoSections) {
  std::set<std::string> seen;
  for (const auto& [section, packages] : read_packages(read_whole_file(kRoot / "packages.txt")))
    for (const std::string& package : packages) EXPECT_TRUE(seen.insert(package).second) << package;
  EXPECT_GT(seen.size(), 15u);
}

TEST(House, EveryShellScriptIsReadableByBash) {
  for (const char* script : {"dev", ".ci/run"}) {
    const ProgramResult result = run_command({"bash", "-n", (kRoot / script).string()});
    EXPECT_EQ(result.status, 0) << script << ": " << result.err;
    EXPECT_NE(fs::status(kRoot / script).permissions() & fs::perms::owner_exec, fs::perms::none) << script;
  }
}

TEST(House, DevWithoutAWordItKnowsPrintsItsUsage) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{}, {"nonsense"}, {"build", "extra"}}) {
    std::vector<std::string> command = {(kRoot / "dev").string()};
    command.insert(command.end(), words.begin(), words.end());
    const ProgramResult result = run_command(command, {.folder = "/"});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("./dev build|test|demo|sheets|deb|package|bench|sanitize|cluster|format|setup"));
  }
}

// The names between the brackets of set(NAME ..) in assets/package/public_headers.cmake.
std::set<std::string> public_headers(const std::string& text, const std::string& part) {
  const std::size_t begin = text.find("set(" + part + "_headers") + part.size() + 13;
  std::istringstream names(text.substr(begin, text.find(')', begin) - begin));
  return {std::istream_iterator<std::string>(names), {}};
}

// Those of our own that it includes.
std::set<std::string> headers_in(const std::string& text) {
  static const std::regex include("#include \"([^\"]+)\"");
  std::set<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) names.insert((*it)[1]);
  return names;
}

TEST(House, PublicHeadersIncludePublicHeadersAndEigenAlone) {
  const std::string lists = read_whole_file(kRoot / "assets/package/public_headers.cmake");
  std::set<std::string> known;
  for (const char* part : {"dynamics", "sim", "film"}) {
    const std::set<std::string> own = public_headers(lists, part);
    EXPECT_FALSE(own.empty()) << part;
    known.insert(own.begin(), own.end());
    for (const std::string& header : own) {
      const std::string text = read_whole_file(kRoot / "src" / header);
      EXPECT_THAT(headers_in(text), IsSubsetOf(known)) << header << " of chainreel::" << part;
      EXPECT_EQ(text.find("nlohmann"), std::string::npos) << header;
    }
  }
}

// Negative controls of the helpers above.

TEST(House, ListsOfPublicHeadersAreReadAsWritten) {
  EXPECT_THAT(public_headers("set(sim_headers\n  a/b.hpp c/d.hpp)\nset(film_headers e.hpp)\n", "sim"),
              UnorderedElementsAre("a/b.hpp", "c/d.hpp"));
  EXPECT_THAT(headers_in("#include <vector>\n#include \"core/error.hpp\"\n"), UnorderedElementsAre("core/error.hpp"));
}

TEST(House, TheChecksSeeWhatTheyLookFor) {
  const TemporaryFolder tree;
  tree.write("a.vert", "");
  tree.write("a.frag", "");
  tree.write("b.frag", "");
  tree.write("c.vert", std::string(11, '\n'));
  EXPECT_THAT(shaders_without_partner(tree.path()), UnorderedElementsAre("b.frag", "c.vert"));
  EXPECT_THAT(files_longer_than(tree.path(), 10), ElementsAre("c.vert"));
  EXPECT_THAT(files_longer_than(tree.path(), 11), IsEmpty());
  EXPECT_NE(run_command({"bash", "-n", tree.write("broken", "if true; then\n")}).status, 0);
}

TEST(House, PackageListsAreReadAsWritten) {
  const auto sections = read_packages("# all\n[build]\ng++  # compiler\nlibpng-dev\n\n[test]\nqemu-user\n");
  EXPECT_THAT(sections.at("build"), UnorderedElementsAre("g++", "libpng-dev"));
  EXPECT_THAT(sections.at("test"), UnorderedElementsAre("qemu-user"));
  EXPECT_THROW(read_packages("libpng-dev\n"), std::runtime_error);  // before any section
  EXPECT_THROW(read_packages("[build]\ntwo words\n"), std::runtime_error);
}

TEST(House, PackagesNamedByAPageAreThoseOfItsCommands) {
  EXPECT_THAT(
      packages_named_by("install nothing\n    sudo apt-get install --yes g++ \\\n      cmake && ./dev build\n"
                        "or `apt install libpng-dev` and go on"),
      UnorderedElementsAre("g++", "cmake", "libpng-dev"));
}

}  // namespace
}  // namespace chainreel
