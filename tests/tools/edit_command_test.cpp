/// `handway edit`: what it changes in a scene file, and its exit codes.
#include "command_line.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/setup/placing.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace handway::test {
namespace {

using testing::HasSubstr;

class EditCommand : public testing::Test {
 protected:
  static std::string shipped() { return (source_dir() / "scenes" / "can_on_table.yaml").string(); }

  /// The scene after an edit of `scene`.
  geometric::Scene edited(const std::string& scene, const std::string& edit) const {
    const std::size_t kind = edit.find(' ');
    const Outcome run = line_.run("edit " + edit.substr(0, kind) + " " + scene + edit.substr(kind) +
                                  " --out edited.yaml");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("Saved edited.yaml"));
    return geometric::read_scene(line_.folder() / "edited.yaml");
  }
  static Eigen::Vector3d place(const geometric::Scene& scene, const std::string& object) {
    return find_object(scene, object)->X_PO.translation();
  }

  /// Three boxes of 10 cm, 1 m above the floor.
  std::string boxes() const {
    std::string text = "handway: 1\nrobots:\n  - {name: arm, model: tx90}\nobjects:\n";
    for (const char* box : {"a|0", "b|0.3", "c|1"}) {
      const std::string word = box;
      text += "  - name: " + word.substr(0, 1) + "\n    box: {size: [0.1, 0.1, 0.1]}\n";
      text += "    pose: {xyz: [0, " + word.substr(2) + ", 1]}\n";
    }
    return line_.write("boxes.yaml", text).string();
  }

  CommandLine line_;
};

TEST_F(EditCommand, AlignsDistributesAndDrops) {
  EXPECT_NEAR(place(edited(boxes(), "align a b --axis y --to max"), "a").y(), 0.3, 1e-9);
  EXPECT_NEAR(place(edited(boxes(), "distribute a b c --axis y"), "b").y(), 0.5, 1e-9);
  EXPECT_NEAR(place(edited(boxes(), "drop a"), "a").z(), 0.05, 1e-9);
  EXPECT_NEAR(place(edited(boxes(), "move a b --by 0.1 0 -0.2"), "b").z(), 0.8, 1e-9);
}

TEST_F(EditCommand, AddsFrames) {
  const geometric::Scene scene =
      edited(boxes(), "frame place --on a --xyz 0 0 0.05 --rpy-deg 0 0 90");
  ASSERT_EQ(scene.frames.size(), 1U);
  EXPECT_EQ(scene.frames[0].parent, "a");
  EXPECT_NEAR(scene.frames[0].X_PF.translation().z(), 0.05, 1e-12);
  const Outcome taken = line_.run("edit frame " + boxes() + " b --out x.yaml");
  EXPECT_EQ(taken.exit_code, 3);
  EXPECT_THAT(taken.err, HasSubstr("the name \"b\", which is used"));
  EXPECT_EQ(line_.run("edit frame " + boxes() + " place --on d --out x.yaml").exit_code, 3);
}

TEST_F(EditCommand, CopiesInRowsAndAroundAnAxis) {
  const geometric::Scene rows = edited(boxes(), "array a --count 2 1 2 --spacing 0.2 0 0.3");
  EXPECT_EQ(rows.objects.size(), 6U);
  EXPECT_TRUE(place(rows, "a 4").isApprox(Eigen::Vector3d(0.2, 0.0, 1.3), 1e-9));
  const geometric::Scene ring = edited(boxes(), "array a --around z --copies 4 --centre 1 0 0");
  EXPECT_TRUE(place(ring, "a 3").isApprox(Eigen::Vector3d(2.0, 0.0, 1.0), 1e-9));
}

TEST_F(EditCommand, AttachesAndDetachesWhereTheObjectIs) {
  const geometric::Scene before = geometric::read_scene(shipped());
  const geometric::Scene held = edited(shipped(), "attach can --link palm --touching palm");
  const geometric::SceneObject& can = *find_object(held, "can");
  ASSERT_TRUE(can.attachment);
  EXPECT_EQ(can.attachment->link, "palm");
  const Eigen::Vector3d there = object_pose(held, *held.start, can).translation();
  EXPECT_NEAR((there - place(before, "can")).norm(), 0.0, 2.0 * geometric::kRestingGap);
  const Outcome free = line_.run("edit detach edited.yaml can --out free.yaml");
  EXPECT_EQ(free.exit_code, 0) << free.err;
  EXPECT_NEAR((place(geometric::read_scene(line_.folder() / "free.yaml"), "can") - there).norm(),
              0.0, 1e-9);
}

TEST_F(EditCommand, TakesAHandOffAndMountsItAgain) {
  static_cast<void>(line_.write("arm.yaml",
                                "handway: 1\nrobots:\n  - name: arm\n    model: tx90\n"
                                "  - name: hand\n    model: sah_right\n"
                                "    mount: {robot: arm, link: flange_link}\n"));
  EXPECT_EQ(edited("arm.yaml", "unmount hand").robots.size(), 2U);
  const Outcome again =
      line_.run("edit mount edited.yaml hand --link arm/flange_link --xyz 0 0 0.02 --out on.yaml");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(geometric::read_scene(line_.folder() / "on.yaml").robots.size(), 1U);
}

TEST_F(EditCommand, KeepsAFileOfGraspsForAnObject) {
  static_cast<void>(
      line_.write("grasps.json", R"([{"pose": [0.1, 0, 0, 0, 0, 0, 1], "joints": {}}])"));
  const geometric::Scene kept = edited(shipped(), "grasps can grasps.json");
  EXPECT_EQ(find_object(kept, "can")->grasps, line_.folder() / "grasps.json");
  EXPECT_THAT(line_.read("edited.yaml"), HasSubstr("    grasps: grasps.json\n"));
  const Outcome broken = line_.run("edit grasps " + shipped() + " can edited.yaml --out x.yaml");
  EXPECT_EQ(broken.exit_code, 3);
  EXPECT_THAT(broken.err, HasSubstr("grasps"));
}

TEST_F(EditCommand, RefusesInWords) {
  const Outcome unknown = line_.run("edit drop " + boxes() + " d --out x.yaml");
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("There are: a, b, c"));
  EXPECT_EQ(line_.run("edit drop " + boxes() + " a").exit_code, 2) << "no --out";
  EXPECT_EQ(line_.run("edit").exit_code, 2) << "no edit";
  EXPECT_EQ(line_.run("edit drop missing.yaml a --out x.yaml").exit_code, 3);
  EXPECT_EQ(line_.run("edit attach " + shipped() + " can --link plam --out x.yaml").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(line_.folder() / "x.yaml"));
}

}  // namespace
}  // namespace handway::test
