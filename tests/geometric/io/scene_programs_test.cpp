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
  EXPECT_THAT(std::get<PlaceStep>(scene.programs[0].steps[1]).supports,
              testing::ElementsAre("shelf"));
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

TEST(ScenePrograms, HavePosesLinesAndAlternatives) {
  const SceneFiles files;
  const auto file = files.scene(kObjects + R"(frames:
  - {name: place, on: shelf, pose: {xyz: [0, 0, 0.5]}}
program:
  - pick: can
  - line: {xyz: [0, 0, 0.1], in: palm}
  - first_of:
      - - place: place
        - move: start
      - [place: shelf]
  - move: {link: hand, in: place, xyz: [0, 0, 0.2]}
  - first_of: {near: [move: start], far: [line: {xyz: [1, 0, 0]}]}
)");
  const Scene scene = read_scene(file);
  const std::vector<ProgramStep>& steps = scene.programs.at(0).steps;
  ASSERT_EQ(steps.size(), 5U);
  EXPECT_EQ(std::get<LineStep>(steps[1]).shift, Eigen::Vector3d(0.0, 0.0, 0.1));
  EXPECT_EQ(std::get<LineStep>(steps[1]).reference, "palm");
  const auto& either = std::get<AlternativesStep>(steps[2]).programs;
  ASSERT_EQ(either.size(), 2U);
  EXPECT_EQ(either[0].steps.size(), 2U);
  EXPECT_EQ(to_string(steps[2]), "place on place or place on shelf");
  const PoseGoal& goal = std::get<PoseStep>(steps[3]).goal;
  EXPECT_EQ(goal.reference, "place");
  EXPECT_EQ(goal.X_WG.translation().z(), 0.2) << "in the frame";
  EXPECT_EQ(to_string(steps[4]), "near or far");
  write_scene(scene, file);
  const std::string first = files.read(file);
  write_scene(read_scene(file), file);
  EXPECT_EQ(files.read(file), first);
  EXPECT_EQ(std::get<AlternativesStep>(read_scene(file).programs.at(0).steps[4]).programs[1].name,
            "far");
}

TEST(ScenePrograms, WaitAndSetOutputs) {
  const SceneFiles files;
  const auto file = files.scene(kObjects + R"(program:
  - wait: 2.5
  - output: {name: do3, value: true}
  - output: {name: 'lamp: "red"', value: -0.5}
  - first_of: [[output: {name: 4, value: false}], [wait: 86400]]
)");
  const Scene scene = read_scene(file);
  const std::vector<ProgramStep>& steps = scene.programs.at(0).steps;
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_EQ(std::get<WaitStep>(steps[0]).duration, 2.5);
  EXPECT_EQ(to_string(steps[0]), "wait 2.5 s");
  EXPECT_EQ(std::get<OutputStep>(steps[1]).name, "do3");
  EXPECT_TRUE(std::get<bool>(std::get<OutputStep>(steps[1]).value));
  EXPECT_EQ(std::get<double>(std::get<OutputStep>(steps[2]).value), -0.5);
  EXPECT_EQ(to_string(steps[3]), "set 4 to false or wait 86400 s");
  write_scene(scene, file);
  const std::string first = files.read(file);
  EXPECT_THAT(first, HasSubstr("  - wait: 2.5\n  - output: {name: do3, value: true}\n"));
  const std::vector<ProgramStep> again = read_scene(file).programs.at(0).steps;
  EXPECT_EQ(std::get<OutputStep>(again[2]).name, "lamp: \"red\"");
  const auto& either = std::get<AlternativesStep>(again[3]).programs;
  EXPECT_FALSE(std::get<bool>(std::get<OutputStep>(either[0].steps[0]).value));
  EXPECT_EQ(std::get<OutputStep>(either[0].steps[0]).name, "4");
}

TEST(ScenePrograms, KeepDisabledSteps) {
  const SceneFiles files;
  const auto file = files.scene(kObjects + R"(program:
  - {pick: can, disabled: true}
  - move: start
    disabled: false
  - first_of: [[{wait: 1, disabled: true}, {move: start}], [wait: 2]]
)");
  const Scene scene = read_scene(file);
  const std::vector<ProgramStep>& steps = scene.programs.at(0).steps;
  EXPECT_TRUE(steps.at(0).disabled);
  EXPECT_EQ(std::get<PickStep>(steps[0]).object, "can");
  EXPECT_FALSE(steps.at(1).disabled);
  write_scene(scene, file);
  EXPECT_THAT(files.read(file),
              HasSubstr("  - {pick: {object: can, approach: 0.1, lift: 0.1}, disabled: true}\n"
                        "  - move: start\n"
                        "  - first_of: [[{wait: 1, disabled: true}, {move: start}], [{wait: 2}]]"));
  const std::vector<ProgramStep> again = read_scene(file).programs.at(0).steps;
  EXPECT_TRUE(again.at(0).disabled);
  EXPECT_TRUE(std::get<AlternativesStep>(again.at(2)).programs.at(0).steps.at(0).disabled);
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
  EXPECT_THAT(refusal("  - wait: 0\n"), HasSubstr("a time above 0, up to 86400 s"));
  EXPECT_THAT(refusal("  - wait: 86401\n"), HasSubstr("a time above 0, up to 86400 s"));
  EXPECT_THAT(refusal("  - wait: long\n"), HasSubstr("a finite number"));
  EXPECT_THAT(refusal("  - output: do3\n"), HasSubstr("keys and values"));
  EXPECT_THAT(refusal("  - output: {name: do3}\n"), HasSubstr("value"));
  EXPECT_THAT(refusal("  - output: {name: do3, value: maybe}\n"),
              HasSubstr("true, false or a number"));
  EXPECT_THAT(refusal("  - disabled: true\n"), HasSubstr("a map of 0 keys"));
  EXPECT_THAT(refusal("  - {wait: 1, disabled: perhaps}\n"), HasSubstr("true or false"));
  EXPECT_THAT(refusal("  - line: {xyz: [0, 0, 0]}\n"), HasSubstr("a vector of a length above 0"));
  EXPECT_THAT(refusal("  - first_of: [[move: start]]\n"), HasSubstr("at least two lists of steps"));
  EXPECT_THAT(refusal("  - first_of: [[move: start], []]\n"), HasSubstr("at least one step"));
  EXPECT_THAT(refusal("  - move: {link: can, xyz: [0, 0, 0]}\n"), HasSubstr("a link of"));
}

TEST(ScenePrograms, FollowTheNewNameOfAnObject) {
  std::vector<Program> programs{{"", {PickStep{"can"}, PlaceStep{{"shelf"}}, PostureStep{"can"}}}};
  rename_object(programs, "can", "tin");
  rename_object(programs, "shelf", "board");
  EXPECT_EQ(std::get<PickStep>(programs[0].steps[0]).object, "tin");
  EXPECT_THAT(std::get<PlaceStep>(programs[0].steps[1]).supports, testing::ElementsAre("board"));
  EXPECT_EQ(std::get<PostureStep>(programs[0].steps[2]).posture, "can");
}

TEST(ScenePrograms, KeepPlacesInTheFramesOfSeveralObjects) {
  const SceneFiles files;
  const auto file = files.scene(kObjects +
                                "program:\n  - place: [shelf, can]\n"
                                "  - place: {on: [shelf, can], pose: {xyz: [0.1, 0, 0]}}\n");
  write_scene(read_scene(file), file);
  const Scene scene = read_scene(file);
  const auto& anywhere = std::get<PlaceStep>(scene.programs[0].steps[0]);
  EXPECT_THAT(anywhere.supports, testing::ElementsAre("shelf", "can"));
  EXPECT_FALSE(anywhere.pose);
  const auto& there = std::get<PlaceStep>(scene.programs[0].steps[1]);
  EXPECT_THAT(there.supports, testing::ElementsAre("shelf", "can"));
  ASSERT_TRUE(there.pose);
  EXPECT_EQ(there.pose->translation().x(), 0.1);
}

}  // namespace
}  // namespace handway::geometric
