/// Programs of a scene: steps by the names of objects.
#include "scene_files.h"

#include <handway/geometric/formats/scene_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::SceneFiles;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const std::string kObjects =
    "objects:\n  - {name: can, sphere: {radius: 0.1}}\n  - {name: shelf, box: {size: [1, 1, 1]}}\n";

TEST(ScenePrograms, HaveDefaultLengthsUnlessTheyAreGiven) {
  const SceneFiles files;
  const Scene scene = read_scene(files.scene(
      kObjects +
      "program:\n  - pick: can\n  - place: {on: shelf, retreat: 0.2}\n  - move: start\n"));
  ASSERT_EQ(scene.programs.size(), 1U);
  EXPECT_EQ(scene.programs[0].name, "");
  ASSERT_EQ(scene.programs[0].steps.size(), 3U);
  EXPECT_EQ(std::get<PickStep>(scene.programs[0].steps[0]).object, "can");
  EXPECT_EQ(std::get<PickStep>(scene.programs[0].steps[0]).lift, 0.1);
  EXPECT_EQ(std::get<PlaceStep>(scene.programs[0].steps[1]).support, "shelf");
  EXPECT_EQ(std::get<PlaceStep>(scene.programs[0].steps[1]).retreat, 0.2);
  EXPECT_EQ(std::get<PostureStep>(scene.programs[0].steps[2]).posture, "start");
  EXPECT_THAT(scene.warnings, Not(Contains(HasSubstr("the scene has no object"))));
}

TEST(ScenePrograms, AreWrittenAsTheyWereRead) {
  const SceneFiles files;
  const auto copy = files.folder() / "copy.yaml";
  write_scene(read_scene(files.scene(kObjects +
                                     "program:\n  tidy up:\n    - pick: {object: can, lift: 0.05}\n"
                                     "    - place: {pose: {xyz: [1, 2, 3], rpy_deg: [0, 0, 90]}}\n "
                                     " home:\n    - move: start\n")),
              copy);
  EXPECT_THAT(files.read(copy),
              HasSubstr("program:\n  tidy up:\n"
                        "    - pick: {object: can, approach: 0.1, lift: 0.05}\n"
                        "    - place: {pose: {xyz: [1, 2, 3], rpy_deg: [0, 0, 90]}, lower: 0.1, "
                        "retreat: 0.1}\n  home:\n    - move: start\n"));
  const std::string first = files.read(copy);
  write_scene(read_scene(copy), copy);
  EXPECT_EQ(files.read(copy), first);
}

TEST(ScenePrograms, WarnOfObjectsThatAreGone) {
  const SceneFiles files;
  const Scene scene = read_scene(files.scene(kObjects + "program:\n  - pick: cup\n"));
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("yaml:8: the scene has no object \"cup\"")));
}

TEST(ScenePrograms, RefuseWhatIsNoStep) {
  const SceneFiles files;
  const auto refusal = [&](const std::string& program) {
    const auto file = files.scene(kObjects + "program:\n" + program);
    return input_error_of([&] { static_cast<void>(read_scene(file)); });
  };
  EXPECT_THAT(refusal("  - grab: can\n"), HasSubstr("grab"));
  EXPECT_THAT(refusal("  - {pick: can, place: shelf}\n"), HasSubstr("a map of 2 keys"));
  EXPECT_THAT(refusal("  - pick: {object: can, lift: 11}\n"), HasSubstr("a length from 0 to 10 m"));
  EXPECT_THAT(refusal("  - place: {}\n"), HasSubstr("neither on nor pose"));
  EXPECT_THAT(refusal("  home: []\n"), HasSubstr("at least one step"));
  EXPECT_THAT(refusal("  3\n"), HasSubstr("program"));
}

TEST(ScenePrograms, FollowTheNewNameOfAnObject) {
  std::vector<Program> programs{{"", {PickStep{"can"}, PlaceStep{"shelf"}, PostureStep{"can"}}}};
  rename_object(programs, "can", "tin");
  rename_object(programs, "shelf", "board");
  EXPECT_EQ(std::get<PickStep>(programs[0].steps[0]).object, "tin");
  EXPECT_EQ(std::get<PlaceStep>(programs[0].steps[1]).support, "board");
  EXPECT_EQ(std::get<PostureStep>(programs[0].steps[2]).posture, "can");
}

}  // namespace
}  // namespace handway::geometric
