#include "scene_files.h"

#include <handway/geometric/formats/scene_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::SceneFiles;
using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::SizeIs;

constexpr double kPi = std::numbers::pi;

std::string refusal(const std::filesystem::path& file) {
  return input_error_of([&] { static_cast<void>(read_scene(file)); });
}

TEST(SceneReader, NeedsNothingButARobot) {
  const SceneFiles files;
  const Scene scene = read_scene(files.scene(""));
  ASSERT_THAT(scene.robots, SizeIs(1));
  EXPECT_EQ(scene.robots[0].name, "arm");
  EXPECT_EQ(scene.robots[0].file, "arm.urdf");
  EXPECT_EQ(scene.robots[0].configuration, scene.robots[0].model->neutral());
  EXPECT_TRUE(scene.robots[0].X_WB.isApprox(Pose::Identity()));
  EXPECT_FALSE(scene.start);
  EXPECT_TRUE(scene.objects.empty());
}

// Limits of the slide `name`, m.
Eigen::Vector2d bounds_of(const Scene& scene, const std::string& name) {
  const RobotModel& model = *scene.robots.front().model;
  const JointLimits& limits = model.variable(model.find_variable(name).value()).limits;
  return {limits.lower, limits.upper};
}

TEST(SceneReader, LetsTheBaseOfARobotMoveWithinBounds) {
  const SceneFiles files;
  const Scene scene = read_scene(files.scene(R"(    moving_base: planar
    bounds: {base/x: [-1, 2.5]}
objects:
  - {name: table, box: {size: [1, 2, 0.1]}, pose: {xyz: [3, 0, 0]}}
start: {base/x: 1, base/y: 4, base/theta: 3, shoulder: 1}
)"));
  const RobotModel& model = *scene.robots.front().model;
  EXPECT_EQ(model.variable_count(), 5);
  EXPECT_EQ(model.link(0).name, "world");
  EXPECT_EQ(bounds_of(scene, "base/x"), Eigen::Vector2d(-1, 2.5)) << "as the scene says";
  EXPECT_EQ(bounds_of(scene, "base/y"), Eigen::Vector2d(-1.5, 4.5))
      << "half a metre beyond the table and the start";
  EXPECT_EQ((*scene.start)[*model.find_variable("base/theta")], 3.0);
}

TEST(SceneReader, FreesAHandInSpace) {
  const SceneFiles files;
  const Scene scene = read_scene(files.scene("    moving_base: floating\n"));
  EXPECT_EQ(scene.robots.front().model->variable_count(), 8);
  EXPECT_EQ(bounds_of(scene, "base/trans_z"), Eigen::Vector2d(-0.5, 0.5));
}

TEST(SceneReader, RefusesBasesThatMakeNoSense) {
  const SceneFiles files;
  EXPECT_THAT(refusal(files.scene("    moving_base: wheels\n")),
              AllOf(HasSubstr("scene.yaml:4"), HasSubstr("wheels"), HasSubstr("planar")));
  EXPECT_THAT(refusal(files.scene("    bounds: {base/x: [0, 1]}\n")),
              AllOf(HasSubstr("scene.yaml:4"), HasSubstr("moving_base")));
  EXPECT_THAT(refusal(files.scene("    moving_base: planar\n    bounds: {base/theta: [0, 1]}\n")),
              AllOf(HasSubstr("scene.yaml:5"), HasSubstr("base/theta"), HasSubstr("base/x")));
  EXPECT_THAT(refusal(files.scene("    moving_base: planar\n    bounds: {base/x: [1, 0]}\n")),
              AllOf(HasSubstr("scene.yaml:5"), HasSubstr("lower first")));
}

TEST(SceneReader, ReadsEveryPartOfAScene) {
  const SceneFiles files;
  files.write("basis.yaml", "hand: h\n");
  const Scene scene = read_scene(files.write("scene.yaml", R"(# about it
handway: 1
name: Can on a table
description: "Two lines\nof text"
robots:
  - name: left
    model: arm.urdf
    base: {xyz: [1, 2, 3], rpy_deg: [0, 0, 90]}
    configuration: {shoulder: 0.5}
objects:
  - name: table
    box: {size: [1, 2, 0.1]}
    pose: {xyz: [0, 0, -0.05]}
    color: [0.5, 0.25, 0]
  - name: ball
    sphere: {radius: 0.1}
    attach: {robot: left, link: hand, touching: [lower, tip]}
  - {name: can, cylinder: {radius: 0.03, length: 0.12}, color: [1, 0, 0, 0.5]}
  - {name: hat, cone: {radius: 0.03, length: 0.12}, group: clothes, hidden: true, locked: false, solid: false}
  - {name: plate, mesh: {file: square.obj, scale: 0.5}}
  - {name: stretched, mesh: {file: square.obj, scale: [1, 2, 3]}}
start: {elbow: 0.2}
goal: {shoulder: -1, elbow: 1}
postures: {bent: {wrist: 0.5}, "bent back": {shoulder: -0.5, elbow: 1}}
views: [{name: above, target: [1, 2, 3], distance: 1.5, azimuth_deg: -90, elevation_deg: 90}]
hand_basis: basis.yaml
planner: {name: pmd-prm, rho_a: 0.0010, corridor: joint}
)"));
  EXPECT_EQ(scene.name, "Can on a table");
  EXPECT_EQ(scene.description, "Two lines\nof text");
  EXPECT_TRUE(scene.robots[0].X_WB.isApprox(pose_from_rpy({1, 2, 3}, 0, 0, kPi / 2)));
  EXPECT_EQ(scene.robots[0].configuration, Eigen::Vector2d(0.5, 0));
  ASSERT_THAT(scene.objects, SizeIs(6));
  EXPECT_EQ(std::get<Box>(scene.objects[0].shape).size, Eigen::Vector3d(1, 2, 0.1));
  EXPECT_EQ(scene.objects[0].color, (Color{0.5F, 0.25F, 0, 1}));
  EXPECT_EQ(std::get<Sphere>(scene.objects[1].shape).radius, 0.1);
  ASSERT_TRUE(scene.objects[1].attachment);
  EXPECT_EQ(scene.objects[1].attachment->link, "hand");
  EXPECT_THAT(scene.objects[1].attachment->touching, ElementsAre("lower", "tip"));
  EXPECT_EQ(scene.objects[2].color.alpha, 0.5F);
  EXPECT_EQ(std::get<Cone>(scene.objects[3].shape).length, 0.12);
  EXPECT_EQ(scene.display.of("hat").group, "clothes");
  EXPECT_TRUE(scene.display.of("hat").hidden);
  EXPECT_FALSE(scene.display.of("hat").locked);
  EXPECT_FALSE(scene.objects[3].solid);
  EXPECT_TRUE(scene.objects[0].solid);
  const Mesh& plate = std::get<Mesh>(scene.objects[4].shape);
  EXPECT_EQ(plate.file, files.folder() / "square.obj");
  EXPECT_EQ(bounding_box(*plate.triangles).upper, Eigen::Vector3d(0.5, 0.5, 0));
  EXPECT_EQ(std::get<Mesh>(scene.objects[5].shape).scale, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(*scene.start, Eigen::Vector2d(0.5, 0.2)) << "the shoulder stands as configured";
  EXPECT_EQ(*scene.goal, Eigen::Vector2d(-1, 1));
  ASSERT_THAT(scene.postures, SizeIs(2));
  EXPECT_EQ(scene.postures[0].name, "bent");
  EXPECT_THAT(scene.postures[0].values, ElementsAre(Pair("elbow", DoubleNear(0.2, 1e-15))))
      << "which the wrist follows";
  EXPECT_THAT(scene.postures[1].values, ElementsAre(Pair("elbow", 1.0), Pair("shoulder", -0.5)));
  EXPECT_THAT(scene.display.views,
              ElementsAre(SavedView{"above", {1, 2, 3}, 1.5, -kPi / 2, kPi / 2}));
  EXPECT_EQ(scene.hand_basis, "basis.yaml");
  EXPECT_EQ(scene.planner.name, "pmd-prm");
  EXPECT_THAT(scene.planner.settings,
              ElementsAre(Pair("rho_a", "0.0010"), Pair("corridor", "joint")));
}

TEST(SceneReader, OpensWithoutAFileOfGrasps) {
  const SceneFiles files;
  const Scene scene =
      read_scene(files.scene("objects: [{name: a, sphere: {radius: 1}, grasps: lost.yaml}]\n"));
  EXPECT_EQ(scene.objects[0].grasps, files.folder() / "lost.yaml") << "it is not forgotten";
  EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("there is no file of grasps ")));
}

TEST(SceneReader, ReadsGoalsAsPosesOfALink) {
  const SceneFiles files;
  const Scene scene = read_scene(files.scene(R"(goal_pose:
  link: hand
  xyz: [0.1, 0.2, 0.3]
  rpy_deg: [0, 0, 90]
  tool: {xyz: [0, 0, 0.05]}
  tolerance: {position: [0.01, 0.02, 0], rotation_deg: 5}
)"));
  ASSERT_THAT(scene.goal_poses, SizeIs(1));
  const PoseGoal& goal = scene.goal_poses.front();
  EXPECT_EQ(goal.link, "hand");
  EXPECT_TRUE(goal.X_WG.isApprox(pose_from_rpy({0.1, 0.2, 0.3}, 0, 0, kPi / 2)));
  EXPECT_TRUE(goal.X_LT.isApprox(pose_from_rpy({0, 0, 0.05}, 0, 0, 0)));
  EXPECT_EQ(goal.position_tolerance, Eigen::Vector3d(0.01, 0.02, 0));
  EXPECT_TRUE(goal.rotation_tolerance.isApprox(Eigen::Vector3d::Constant(kPi / 36)));
  const Scene two = read_scene(
      files.scene("goal_pose: [{link: hand, xyz: [0, 0, 1]}, {link: hand, xyz: [0, 0, 2]}]\n"));
  ASSERT_THAT(two.goal_poses, SizeIs(2));
  EXPECT_EQ(two.goal_poses[1].X_WG.translation().z(), 2.0);
  EXPECT_EQ(two.goal_poses[1].position_tolerance, PoseGoal().position_tolerance);
  EXPECT_FALSE(two.goal);
}

TEST(SceneReader, ReadsGoalsInTheFrameOfAnObject) {
  const SceneFiles files;
  Scene scene = read_scene(files.scene(R"(objects:
  - {name: can, sphere: {radius: 0.1}, pose: {xyz: [1, 0, 0], rpy_deg: [0, 0, 90]}}
goal_pose: {link: hand, in: can, xyz: [0.1, 0, 0.3]}
)"));
  const Scene before = scene;
  EXPECT_EQ(scene.goal_poses[0].reference, "can");
  EXPECT_TRUE(
      scene.goal_poses[0].X_WG.isApprox(pose_from_rpy({1.0, 0.1, 0.3}, 0, 0, kPi / 2), 1e-12));
  scene.objects[0].X_PO = pose_from_rpy({2, 0, 0}, 0, 0, 0);
  follow_objects(before, scene);
  EXPECT_TRUE(scene.goal_poses[0].X_WG.isApprox(pose_from_rpy({2.1, 0, 0.3}, 0, 0, 0), 1e-12))
      << "it goes with the object";
  scene.objects.clear();
  follow_objects(before, scene);
  EXPECT_TRUE(scene.goal_poses[0].X_WG.isApprox(pose_from_rpy({2.1, 0, 0.3}, 0, 0, 0), 1e-12));
  EXPECT_EQ(scene.goal_poses[0].reference, "");
}

TEST(SceneReader, ReadsNamedFrames) {
  const SceneFiles files;
  Scene scene = read_scene(files.scene(R"(objects:
  - {name: board, box: {size: [1, 1, 0.02]}, pose: {xyz: [1, 0, 0.5]}}
frames:
  - {name: place, on: board, pose: {xyz: [0, 0.2, 0.01]}}
  - {name: nail, on: hand, pose: {xyz: [0, 0, 0.1]}}
  - {name: corner, pose: {xyz: [3, 0, 0]}}
goal_pose: {link: hand, tool: nail, in: place, xyz: [0, 0, 0.3]}
)"));
  ASSERT_THAT(scene.frames, SizeIs(3));
  EXPECT_EQ(find_frame(scene, "nail")->parent, "hand");
  EXPECT_TRUE(standing_pose(scene, "place")->isApprox(pose_from_rpy({1, 0.2, 0.51}, 0, 0, 0)));
  EXPECT_TRUE(standing_pose(scene, "corner")->isApprox(pose_from_rpy({3, 0, 0}, 0, 0, 0)));
  EXPECT_FALSE(standing_pose(scene, "nail")) << "it moves with the robot";
  EXPECT_THAT(standing_names(scene), testing::ElementsAre("board", "place", "corner"));
  const PoseGoal& goal = scene.goal_poses.at(0);
  EXPECT_TRUE(goal.X_WG.isApprox(pose_from_rpy({1, 0.2, 0.81}, 0, 0, 0)));
  EXPECT_TRUE(goal.X_LT.isApprox(pose_from_rpy({0, 0, 0.1}, 0, 0, 0)));
  const Scene before = scene;
  scene.objects[0].X_PO.translation().x() = 2.0;
  scene.frames[1].X_PF.translation().z() = 0.2;
  follow_objects(before, scene);
  EXPECT_TRUE(goal.X_WG.isApprox(pose_from_rpy({2, 0.2, 0.81}, 0, 0, 0)));
  EXPECT_TRUE(goal.X_LT.isApprox(pose_from_rpy({0, 0, 0.2}, 0, 0, 0)));
  remove_objects(scene, {"board"});
  EXPECT_THAT(scene.frames, SizeIs(2)) << "the frame on the board has gone with it";
}

TEST(SceneReader, RefusesFramesThatMakeNoSense) {
  const SceneFiles files;
  const auto refused = [&](const std::string& frames) {
    return refusal(
        files.scene("objects: [{name: can, sphere: {radius: 0.1}}]\nframes: " + frames + "\n"));
  };
  EXPECT_THAT(refused("[{on: can}]"), HasSubstr("name"));
  EXPECT_THAT(refused("[{name: can}]"), HasSubstr("can"));
  EXPECT_THAT(refused("[{name: hand}]"), HasSubstr("hand"));
  EXPECT_THAT(refused("[{name: a}, {name: a}]"), HasSubstr("frames[1]"));
  EXPECT_THAT(refused("[{name: a, on: cam}]"), HasSubstr("an object, or a link of"));
  EXPECT_THAT(refused("[{name: a, in: can}]"), HasSubstr("\"in\""));
}

TEST(SceneReader, RefusesGoalPosesThatMakeNoSense) {
  const SceneFiles files;
  const auto refused = [&](const std::string& goal) {
    return refusal(files.scene("goal_pose: " + goal + "\n"));
  };
  EXPECT_THAT(refused("[]"), HasSubstr("an empty list"));
  EXPECT_THAT(refused("{xyz: [0, 0, 1]}"), HasSubstr("link"));
  EXPECT_THAT(refused("{link: hands, xyz: [0, 0, 1]}"), HasSubstr("Did you mean \"hand\"?"));
  EXPECT_THAT(refused("{link: hand}"), HasSubstr("xyz"));
  EXPECT_THAT(refused("{link: hand, in: nothing, xyz: [0, 0, 1]}"),
              HasSubstr("an object or a frame that stands in the world"));
  EXPECT_THAT(refused("{link: hand, xyz: [0, 0, 1], tool: tip}"),
              HasSubstr("a frame on the link hand"));
  EXPECT_THAT(refused("{link: hand, xyz: [0, 0, 1], tolerance: {position: -1}}"),
              HasSubstr("0 or more"));
  EXPECT_THAT(refused("{link: hand, xyz: [0, 0, 1], tolerance: {rotation: 1}}"),
              HasSubstr("\"rotation\""));
}

TEST(SceneReader, DerivesALeaderFromItsCoupledJoint) {
  const SceneFiles files;
  EXPECT_NEAR((*read_scene(files.scene("start: {wrist: 0.5}\n")).start)[1], 0.2, 1e-15);
  EXPECT_EQ((*read_scene(files.scene("start: {wrist: 0.5, elbow: 0.2}\n")).start)[1], 0.2);
}

TEST(SceneReader, RefusesCoupledJointsThatContradictEachOther) {
  const SceneFiles files;
  EXPECT_THAT(refusal(files.scene("start: {wrist: 0.6, elbow: 0.2}\n")),
              AllOf(HasSubstr("scene.yaml:4"), HasSubstr("start.wrist"), HasSubstr("0.6"),
                    HasSubstr("\"elbow\"")));
}

TEST(SceneReader, NamesTheLineAndTheNearestKeyOfAMisspeltOne) {
  const SceneFiles files;
  EXPECT_THAT(refusal(files.scene("\nobject: []\n")),
              AllOf(HasSubstr("scene.yaml:5"), HasSubstr("\"object\""),
                    HasSubstr("Did you mean \"objects\"?")));
  EXPECT_THAT(refusal(files.scene("objects:\n  - name: a\n    box: {sise: [1, 1, 1]}\n")),
              AllOf(HasSubstr("scene.yaml:6"), HasSubstr("objects[0].box"), HasSubstr("size")));
  EXPECT_THAT(refusal(files.scene("\nobject:\n  - name: a\n    box: {size: [1, 1, 1]}\n")),
              HasSubstr("scene.yaml:5: object: found the unknown key"))
      << "where the key is, not what it holds";
  EXPECT_THAT(refusal(files.scene("start:\n  elbow: 0\nstart:\n  elbow: 1\n")),
              AllOf(HasSubstr("scene.yaml:6"), HasSubstr("a second time")));
  EXPECT_THAT(refusal(files.scene("start: {sholder: 1}\n")), HasSubstr("\"shoulder\""));
  EXPECT_THAT(refusal(files.scene("start: {tool: 1}\n")), HasSubstr("fixed joint"));
  EXPECT_THAT(refusal(files.scene("postures: {up: {sholder: 1}}\n")),
              AllOf(HasSubstr("postures.up"), HasSubstr("\"shoulder\"")));
}

TEST(SceneReader, RefusesWrongValues) {
  const SceneFiles files;
  const std::string object = "objects:\n  - name: a\n    ";
  for (const auto& [text, word] : std::initializer_list<std::pair<std::string, std::string>>{
           {object + "box: {size: [1, 1]}", "a list of 3 numbers"},
           {object + "box: {size: [1, 1, 0]}", "a size above 0"},
           {object + "box: {size: 1}", "a list of 3 numbers"},
           {object + "sphere: {radius: .nan}", "a finite number"},
           {"views: [{name: a, target: [0, 0, 0], distance: 0, azimuth_deg: 0, elevation_deg: 0}]",
            "a distance above 0 m"},
           {object + "sphere: {radius: nan}", "a finite number"},
           {object + "sphere: {radius: .inf}", "a finite number"},
           {object + "sphere: {radius: 1e999}", "a finite number"},
           {object + "sphere: {radius: 1e9}", "1000000"},
           {object + "sphere: {radius: big}", "a finite number"},
           {object + "sphere: {radius: [1]}", "a finite number"},
           {object + "sphere: {}", "no \"radius\""},
           {object + "sphere:", "no shape"},
           {object + "color: [1, 1, 1]", "no shape"},
           {object + "sphere: {radius: 1}\n    cone: {radius: 1, length: 1}", "a second shape"},
           {object + "mesh: {file: no.stl}", "no file for \"no.stl\""},
           {object + "mesh: {file: square.obj, scale: 0}", "scale"},
           {object + "mesh: {file: square.obj, scale: [1, 2]}", "a list of 3 numbers"},
           {object + "mesh: {file: arm.urdf}", "mesh"},
           {object + "sphere: {radius: 1}\n    color: [1, 2, 0]", "from 0 to 1"},
           {object + "sphere: {radius: 1}\n    color: [1, 0]", "red, green, blue"},
           {object + "sphere: {radius: 1}\n    pose: [1, 0]", "keys and values"},
           {object + "sphere: {radius: 1}\n    attach: {link: nowhere}", "a link of arm"},
           {object + "sphere: {radius: 1}\n    hidden: maybe", "true or false"},
           {object + "sphere: {radius: 1}\n    attach: {robot: x, link: hand}", "a robot"},
           {object + "sphere: {radius: 1}\n  - {name: a, sphere: {radius: 1}}", "second time"},
           {"objects: [{name: arm, sphere: {radius: 1}}]", "second time"},
           {"objects: [{sphere: {radius: 1}}]", "no \"name\""},
           {"objects: [{name: '', sphere: {radius: 1}}]", "empty name"},
           {"objects: 5", "a list"},
           {"start: 5", "keys and values"},
           {"start: {elbow: .NaN}", "a finite number"},
           {"hand_basis: none.yaml", "no file"},
           {"planner: {a: [1, 2]}", "text"},
           {"name: [x]", "text"},
           {"name: x\nname: y", "second time"},
           {"? [a, b]\n: c", "as a key"},
           {"  - model: arm.urdf", "a second time"},
           {"  - model: none", "no file for \"none\""},
       }) {
    EXPECT_THAT(refusal(files.scene(text + "\n")), AllOf(HasSubstr("scene.yaml:"), HasSubstr(word)))
        << text;
  }
}

TEST(SceneReader, RefusesWhatIsNoScene) {
  const SceneFiles files;
  const auto refused = [&](const std::string& text) {
    return refusal(files.write("s.yaml", text));
  };
  EXPECT_THAT(refused(""), HasSubstr("empty file"));
  EXPECT_THAT(refused("# only a comment\n"), HasSubstr("a scene file"));
  EXPECT_THAT(refused("just text"), HasSubstr("a scene file"));
  EXPECT_THAT(refused("robots: []"), HasSubstr("no \"handway\""));
  EXPECT_THAT(refused("handway: 2\nrobots: []"), HasSubstr("newer"));
  EXPECT_THAT(refused("handway: 1"), HasSubstr("no \"robots\""));
  EXPECT_THAT(refused("handway: 1\nrobots: []"), HasSubstr("at least one robot"));
  EXPECT_THAT(refused("handway: 1\nrobots: [\n"), HasSubstr("broken YAML"));
  EXPECT_THAT(refused("handway: 1\n\trobots: x"), HasSubstr("broken YAML"));
  EXPECT_THAT(refused("handway: 1\n---\nhandway: 1"), HasSubstr("more than one YAML document"));
  EXPECT_THAT(refused("a: &a [*a]\n"), HasSubstr("an alias within what it stands for"));
  EXPECT_THAT(refused("<robot name=\"x\"/>"), HasSubstr("s.yaml"));
  EXPECT_THAT(refused(std::string("\x89PNG\r\n\0\0\0", 9)), HasSubstr("no text"));
  EXPECT_THAT(refusal(files.folder() / "none.yaml"), HasSubstr("no such file"));
  for (const std::string bracket : {"[", "{a: ", "- "}) {
    std::string deep;
    for (int i = 0; i < 20000; ++i) {
      deep += bracket;
    }
    EXPECT_NE(refused(deep), "no error") << bracket;
  }
}

TEST(SceneReader, SurvivesEveryCutAndEveryFlippedByteOfAScene) {
  const SceneFiles files;
  const std::string whole = test::ScratchFiles::read(
      files.scene("objects:\n  - {name: a, box: {size: [1, 1, 1]}, pose: {xyz: [1, 2, 3]}}\n"
                  "start: {elbow: 0.25}\nplanner: {name: \"x\\ty\", k: 1}\n"));
  const std::string bytes("\0\xFF[}:&*!|%\"\n", 12);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    static_cast<void>(refusal(files.write("cut.yaml", whole.substr(0, i))));
    std::string flipped = whole;
    flipped[i] = bytes[i % bytes.size()];
    static_cast<void>(refusal(files.write("flipped.yaml", flipped)));
  }
}

// One key after another broken.
TEST(SceneReader, RefusesABrokenConstraintByName) {
  const SceneFiles files;
  const auto refusal_of = [&](const std::string& constraint) {
    return refusal(files.scene("constraints:\n  - " + constraint + "\n"));
  };
  EXPECT_THAT(
      refusal_of("{name: a, body: hnd, upright: {angle_deg: 10}}"),
      AllOf(HasSubstr("scene.yaml:5: constraints[0].body: found \"hnd\""), HasSubstr("\"hand\"")));
  EXPECT_THAT(
      refusal_of("{name: a, body: hand, upright: {angle_deg: 0}}"),
      HasSubstr("constraints[0].upright.angle_deg: found \"0\", expected an angle above 0"));
  EXPECT_THAT(refusal_of("{name: a, body: hand, upright: {axis: [0, 0, 0], angle_deg: 5}}"),
              HasSubstr("expected a vector that is not 0"));
  EXPECT_THAT(refusal_of("{name: a, body: hand, region: {size: [1, 0, 1]}}"),
              HasSubstr("constraints[0].region.size[1]: found \"0\", expected a size above 0 m"));
  EXPECT_THAT(refusal_of("{name: a, body: hand}"), HasSubstr("neither upright nor region"));
  EXPECT_THAT(refusal_of("{name: a, body: hand, upright: {angle_deg: 5}}\n"
                         "  - {name: a, body: tip, upright: {angle_deg: 5}}"),
              HasSubstr("a name that no other constraint has"));
}

}  // namespace
}  // namespace handway::geometric
