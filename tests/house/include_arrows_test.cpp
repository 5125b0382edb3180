#include "house/include_arrows.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(IncludeArrows, EveryFolderIncludesOnlyWhatStandsBelowIt) {
  const IncludeReport report = check_includes(house(), CHAINREEL_SOURCE_FOLDER "/src");
  EXPECT_GT(report.files, 20);
  EXPECT_GT(report.includes, 100);
  EXPECT_THAT(report.faults, IsEmpty());
}

TEST(IncludeArrows, TheHouseHasNoCircle) {
  const auto expect_no_circle = [](const std::map<std::string, std::set<std::string>>& uses) {
    for (const auto& [folder, below] : uses)
      for (const std::string& target : below)
        EXPECT_FALSE(reachable(uses, target).contains(folder)) << folder << " " << target;
  };
  expect_no_circle(house().uses);
  for (const auto& [room, shelves] : house().shelves) expect_no_circle(shelves);
}

TEST(IncludeArrows, PhysicsNeverSeesThePictureNorTheRendererPhysics) {
  for (const char* physics : {"model", "dynamics", "integrate", "sim"})
    for (const char* pictures : {"picture", "render", "draw", "encode"}) {
      EXPECT_FALSE(reachable(house().uses, physics).contains(pictures)) << physics << " " << pictures;
      EXPECT_FALSE(reachable(house().uses, pictures).contains(physics) && std::string(pictures) != "draw")
          << pictures;
    }
}

TEST(IncludeArrows, AllFoldersOfTheSourceTreeStandInTheHouse) {
  for (const auto& entry : std::filesystem::directory_iterator(CHAINREEL_SOURCE_FOLDER "/src")) {
    if (!entry.is_directory()) continue;
    EXPECT_TRUE(house().uses.contains(entry.path().filename().string())) << entry.path();
  }
}

// Negative control: a made-up tree in which each line but the marked ones breaks one rule.
TEST(IncludeArrows, EveryKindOfWrongIncludeIsFoundWithItsLine) {
  const TemporaryFolder tree;
  tree.write(
      "core/good.cpp",
      "#include \"core/good.hpp\"\n#include <vector>\n#include <unistd.h>\n// #include <yaml-cpp/a.h>\n");
  tree.write("sim/through.cpp",
             "#include \"core/good.hpp\"\n#include \"model/chain.hpp\"\n#include <Eigen/Core>\n");
  tree.write("core/up.hpp", "#pragma once\n#include \"sim/through.hpp\"\n");
  tree.write("render/physics.cpp", "  #  include \"dynamics/energy.hpp\"\n");
  tree.write("draw/page/yaml.cpp", "#include <yaml-cpp/yaml.h>\n#include <Eigen/Core>\n");
  tree.write("draw/film/good.cpp", "#include \"draw/film/a.hpp\"\n#include \"draw/robot/b.hpp\"\n");
  tree.write("draw/layers/up.cpp", "#include \"draw/film/panel.hpp\"\n#include \"draw/attic/c.hpp\"\n");
  tree.write("draw/loose.cpp", "#include \"draw/film/panel.hpp\"\n");
  tree.write("app/new.cpp", "#include <boost/any.hpp>\n#include \"attic/old.hpp\"\n");
  tree.write("attic/old.cpp", "int x;\n");
  const IncludeReport report = check_includes(house(), tree.path());
  EXPECT_EQ(report.files, 10);
  EXPECT_THAT(
      report.faults,
      ElementsAre(HasSubstr("app/new.cpp:1: <boost/any.hpp> has no place"),
                  HasSubstr("app/new.cpp:2: \"attic/old.hpp\" is not in a folder of the house"),
                  HasSubstr("attic/old.cpp: attic is not a folder of the house"),
                  HasSubstr("core/up.hpp:2: \"sim/through.hpp\": core may not include sim"),
                  HasSubstr("draw/layers/up.cpp:1: \"draw/film/panel.hpp\": within draw layers may not include film"),
                  HasSubstr("draw/layers/up.cpp:2: \"draw/attic/c.hpp\" is on no shelf of draw"),
                  HasSubstr("draw/loose.cpp: is on no shelf of draw"),
                  HasSubstr("draw/page/yaml.cpp:1: <yaml-cpp/yaml.h> may be included by scene alone"),
                  HasSubstr("draw/page/yaml.cpp:2: <Eigen/Core> may be included by"),
                  HasSubstr("render/physics.cpp:1: \"dynamics/energy.hpp\": render may not include dynamics")));
}

}  // namespace
}  // namespace chainreel
