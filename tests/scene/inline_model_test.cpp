// A model in numbers stands in a scene where a file's name could.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/scene_paths.hpp"
#include "scene/text/write_scene.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ModelInNumbers : public testing::Test {
 protected:
  Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return read_scene(folder_.write("one.yaml", text), overrides);
  }
  std::string error(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      Scene scene = read(text, overrides);
      prepare(scene);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }
  TemporaryFolder folder_;
};

TEST_F(ModelInNumbers, IsReadWithAllItsKeys) {
  const Scene scene = read("model: {links: [0.5, 2/5], masses: 2, joints: RP, shape: point, damping: [0.1, 0]}\n");
  ASSERT_TRUE(scene.model.links);
  EXPECT_EQ(*scene.model.links,
            (LinkChain{.links = {0.5, 0.4}, .masses = {2, 2}, .damping = {0.1, 0}, .joints = "RP", .shape = LinkMass::point}));
  const Scene rows = read("model:\n  dh:\n    - [0.5, 90deg, 0, 0]\n    - [0.4, 0, 0.1, 0]\n  convention: modified\n");
  ASSERT_TRUE(rows.model.links);
  EXPECT_EQ(rows.model.links->dh.size(), 2u);
  EXPECT_EQ(rows.model.links->convention, DhConvention::modified);
}

TEST_F(ModelInNumbers, IsWrittenAsItIsReadAgain) {
  for (const char* model : {"{links: [0.1, 0.30000000000000004], masses: [1e-3, 12345.678], damping: 0.1}",
                            "{dh: [[0.5, 90deg, 0, 1], [0.4, 0, 0.1, 0]], joints: RP, convention: modified, shape: point}"}) {
    const Scene scene = read(std::string("model: ") + model + "\n");
    const Scene again = read(scene_text(scene));
    EXPECT_EQ(again.model.links, scene.model.links) << scene_text(scene);
    // Wherever the scene lies: numbers are no path.
    EXPECT_EQ(read(placeless_scene_text(scene)).model.links, scene.model.links);
    EXPECT_TRUE(relative_paths_in(scene_text(scene)).empty());
  }
}

TEST_F(ModelInNumbers, TakesValuesOfTheCommandLine) {
  const Scene scene = read("model: {links: [1, 1]}\n", {"model.masses=[2, 3]", "model.shape=point"});
  EXPECT_THAT(scene.model.links->masses, ElementsAre(2, 3));
  EXPECT_EQ(scene.model.links->shape, LinkMass::point);
  folder_.write("rr.urdf", "<robot/>");
  EXPECT_TRUE(read("model: rr.urdf\n", {"model={links: [1]}"}).model.links);
  EXPECT_EQ(read("model: {links: [1]}\n", {"model=rr.urdf"}).model, ModelSource(folder_.file("rr.urdf")));
}

TEST_F(ModelInNumbers, SaysWithItsLineWhatIsWrong) {
  const std::string lists = error("title: a\nmodel:\n  links: [1, 1, 1]\n  masses: [1, 2]\n  joints: RRRR\n");
  EXPECT_THAT(lists, HasSubstr("one.yaml:4:11: 'model.masses' has 2 numbers, but the chain has 3 links"));
  EXPECT_THAT(lists, HasSubstr("one.yaml:5:11: 'model.joints' 'RRRR' names 4 joints"));
  EXPECT_THAT(error("model: {links: [1], mases: [1]}\n"), HasSubstr("unknown key 'model.mases': did you mean 'masses'"));
  EXPECT_THAT(error("model: {masses: [1]}\n"), HasSubstr("'model.links' must hold the length of each link"));
  EXPECT_THAT(error("model: {links: [1, x]}\n"), HasSubstr("one.yaml:1:20: 'model.links.2'"));
  EXPECT_THAT(error("model: {links: [1], shape: disc}\n"), HasSubstr("rod or point, not 'disc'"));
  EXPECT_THAT(error("model: {dh: [[1, 2, 3]]}\n"), HasSubstr("'model.dh.1': must be four numbers a, alpha, d, theta"));
  EXPECT_THAT(error("model: {links: [1], convention: modified}\n"), HasSubstr("means nothing without rows of `dh`"));
  EXPECT_THAT(error("model: [1, 2]\n"), HasSubstr("model: {links: [0.5, 0.4], masses: [2, 1]}"));
  EXPECT_THAT(error("model: {}\n"), HasSubstr("must hold the length of each link"));
  EXPECT_THAT(error("model: {links: [1, 1]}\n", {"model.masses=[1, 2, 3]"}), HasSubstr("--set model.masses=[1, 2, 3]"));
  // What is found later, too.
  EXPECT_THAT(error("title: a\nmodel: {links: [1, 0], shape: point}\n"), HasSubstr("one.yaml:2:8: joint 'joint2' moves no mass"));
  EXPECT_THAT(error("model: {links: [1, 1]}\nstart: {q: [1]}\n"), HasSubstr("{links: [1, 1], masses: [1, 1], joints: RR, shape: rod} needs 2"));
}

TEST_F(ModelInNumbers, MayDifferFromPanelToPanel) {
  const Scene scene = read("model: {links: [1, 1]}\ncompare:\n  - {model.shape: point}\n  - {model: {links: [1, 0.5]}}\n");
  ASSERT_EQ(scene.compare.size(), 2u);
  EXPECT_EQ(scene.compare[0].model.links->shape, LinkMass::point);
  EXPECT_THAT(scene.compare[1].model.links->links, ElementsAre(1, 0.5));
  const Scene again = read(scene_text(scene));
  EXPECT_EQ(again.compare[0].model.links, scene.compare[0].model.links);
  EXPECT_EQ(again.compare[1].model.links, scene.compare[1].model.links);
}

}  // namespace
}  // namespace chainreel
