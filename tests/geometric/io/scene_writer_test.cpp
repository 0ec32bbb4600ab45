#include "scene_files.h"

#include <handway/geometric/formats/scene_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::SceneFiles;
using testing::HasSubstr;
using testing::StartsWith;

void expect_same_shape(const Shape& a, const Shape& b) {
  ASSERT_EQ(a.index(), b.index());
  const auto ta = tessellate(a);
  const auto tb = tessellate(b);
  ASSERT_EQ(ta->vertices.size(), tb->vertices.size());
  EXPECT_EQ(ta->triangles, tb->triangles);
  for (std::size_t i = 0; i < ta->vertices.size(); ++i) {
    EXPECT_EQ(ta->vertices[i], tb->vertices[i]);
  }
  if (const Mesh* mesh = std::get_if<Mesh>(&a)) {
    EXPECT_EQ(mesh->file, std::get<Mesh>(b).file);
    EXPECT_EQ(mesh->scale, std::get<Mesh>(b).scale);
  }
}

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.description, b.description);
  EXPECT_EQ(a.hand_basis, b.hand_basis);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.goal, b.goal);
  ASSERT_EQ(a.goal_poses.size(), b.goal_poses.size());
  for (std::size_t i = 0; i < a.goal_poses.size(); ++i) {
    EXPECT_EQ(a.goal_poses[i].link, b.goal_poses[i].link);
    EXPECT_EQ(a.goal_poses[i].reference, b.goal_poses[i].reference);
    EXPECT_EQ(a.goal_poses[i].tool, b.goal_poses[i].tool);
    EXPECT_TRUE(a.goal_poses[i].X_WG.isApprox(b.goal_poses[i].X_WG, 1e-13));
    EXPECT_TRUE(a.goal_poses[i].X_LT.isApprox(b.goal_poses[i].X_LT, 1e-13));
    EXPECT_EQ(a.goal_poses[i].position_tolerance, b.goal_poses[i].position_tolerance);
    EXPECT_TRUE(
        a.goal_poses[i].rotation_tolerance.isApprox(b.goal_poses[i].rotation_tolerance, 1e-13));
  }
  EXPECT_EQ(a.frames, b.frames);
  ASSERT_EQ(a.postures.size(), b.postures.size());
  for (std::size_t i = 0; i < a.postures.size(); ++i) {
    EXPECT_EQ(a.postures[i].name, b.postures[i].name);
    EXPECT_EQ(a.postures[i].values, b.postures[i].values);
  }
  EXPECT_EQ(a.display.views, b.display.views);
  EXPECT_EQ(a.planner.name, b.planner.name);
  EXPECT_EQ(a.planner.settings, b.planner.settings);
  ASSERT_EQ(a.robots.size(), b.robots.size());
  for (std::size_t i = 0; i < a.robots.size(); ++i) {
    EXPECT_EQ(a.robots[i].name, b.robots[i].name);
    EXPECT_EQ(a.robots[i].file, b.robots[i].file);
    EXPECT_EQ(a.robots[i].configuration, b.robots[i].configuration);
    EXPECT_TRUE(a.robots[i].X_WB.isApprox(b.robots[i].X_WB, 1e-13));
  }
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(a.objects[i].name, b.objects[i].name);
    expect_same_shape(a.objects[i].shape, b.objects[i].shape);
    EXPECT_TRUE(a.objects[i].X_PO.isApprox(b.objects[i].X_PO, 1e-13));
    EXPECT_EQ(a.objects[i].color, b.objects[i].color);
    EXPECT_EQ(a.display.of(a.objects[i].name), b.display.of(b.objects[i].name));
    EXPECT_EQ(a.objects[i].solid, b.objects[i].solid);
    EXPECT_EQ(a.objects[i].grasps, b.objects[i].grasps);
    ASSERT_EQ(a.objects[i].attachment.has_value(), b.objects[i].attachment.has_value());
    if (a.objects[i].attachment) {
      EXPECT_EQ(a.objects[i].attachment->robot, b.objects[i].attachment->robot);
      EXPECT_EQ(a.objects[i].attachment->link, b.objects[i].attachment->link);
      EXPECT_EQ(a.objects[i].attachment->touching, b.objects[i].attachment->touching);
    }
  }
  ASSERT_EQ(a.constraints.size(), b.constraints.size());
  for (std::size_t i = 0; i < a.constraints.size(); ++i) {
    EXPECT_EQ(a.constraints[i].name, b.constraints[i].name);
    EXPECT_EQ(a.constraints[i].body, b.constraints[i].body);
    ASSERT_EQ(a.constraints[i].what.index(), b.constraints[i].what.index());
    if (const auto* angle = std::get_if<OrientationConstraint>(&a.constraints[i].what)) {
      const auto& other = std::get<OrientationConstraint>(b.constraints[i].what);
      EXPECT_EQ(angle->axis, other.axis);
      EXPECT_EQ(angle->direction, other.direction);
      EXPECT_DOUBLE_EQ(angle->angle, other.angle);
    } else {
      const auto& box = std::get<PositionConstraint>(a.constraints[i].what);
      const auto& other = std::get<PositionConstraint>(b.constraints[i].what);
      EXPECT_EQ(box.point, other.point);
      EXPECT_EQ(box.size, other.size);
      EXPECT_TRUE(box.X_WR.isApprox(other.X_WR));
    }
  }
}

/// A scene that uses every part of the format, with awkward numbers and texts.
Scene full_scene(const SceneFiles& files) {
  files.write("basis.yaml", "hand: h\n");
  files.write("grasps.yaml", "grasps: []\n");
  Scene scene = read_scene(files.scene(R"(    name: "robot: #1"
  - {name: other, model: arm.urdf, base: {xyz: [0.1, 0.2, 0.30000000000000004]}}
objects:
  - {name: "a, [b]", box: {size: [1, 2e-7, 3]}, pose: {rpy_deg: [12.345678901234567, 90, -33]}}
  - {name: "- x", sphere: {radius: 0.1}, pose: {rpy_deg: [0, 0, 90]}, grasps: grasps.yaml}
  - {name: null text, cylinder: {radius: 0.1, length: 3}, color: [0.1, 0.7, 0.3, 0.9]}
  - {name: "ñandú", cone: {radius: 0.1, length: 3}, group: "true", locked: true, solid: false}
  - {name: "null", mesh: {file: square.obj, scale: [1, -2, 3]}}
  - {name: one, mesh: {file: square.obj}, attach: {link: hand, touching: [tip, lower]}}
constraints:
  - {name: "up: right", body: one, upright: {axis: [0, 1, 0], angle_deg: 12.3}}
  - {name: room, body: tip, region: {point: [0, 0, 0.1], size: [1, 2, 0.3], pose: {xyz: [1, 0, 0]}}}
start: {elbow: 0.1}
goal: {shoulder: 1.0000000000000002}
goal_pose:
  - {link: hand, xyz: [0.1, 0, 0], rpy_deg: [30.5, 0, 90], tolerance: {position: 0.001, rotation_deg: [1, 2.5, 180]}}
  - {link: hand, in: "- x", xyz: [0.1, 0.2, -0.3], rpy_deg: [0, 0, 90]}
  - {link: tip, xyz: [1, 2, 3], tool: {xyz: [0, 0, 0.30000000000000004]}, tolerance: {position: [1, 0, 3]}}
postures:
  "above: the table": {shoulder: -0.1, elbow: 0.30000000000000004}
  straight: {elbow: 0}
  nowhere: {}
views:
  - {name: "front: 1", target: [0.1, 1e-7, -3], distance: 0.30000000000000004, azimuth_deg: -33.3, elevation_deg: 12.345}
  - {name: "null", target: [0, 0, 0], distance: 100, azimuth_deg: 180, elevation_deg: -90}
hand_basis: basis.yaml
planner: {name: pmd-prm, rho_a: 1e-3, flag: true, note: "a: b", empty: "", "odd key:": x}
)"));
  scene.name = "Name with \"quotes\", \\ and: colons # too ";
  scene.description = "Several\nlines\twith\ttabs\n\nand a \x01 control\n";
  scene.start = Eigen::Vector2d(1.0 / 3.0, -1e-300);
  scene.objects[0].X_PO =
      pose_from_rpy({1.0 / 3.0, 1e-9, -123456.789}, 0.123456789012345, -1.2, 3.0);
  return scene;
}

TEST(SceneWriter, KeepsMovingBasesAndHowFarTheyGo) {
  const SceneFiles files;
  const Scene scene = read_scene(files.scene(R"(    moving_base: floating
    bounds: {base/trans_x: [-1, 2.5]}
start: {base/trans_y: 1, base/yaw: 3, shoulder: 1}
)"));
  const std::filesystem::path saved = files.write("saved.yaml", "");
  write_scene(scene, saved);
  const Scene again = read_scene(saved);
  const RobotModel& model = *scene.robots.front().model;
  const RobotModel& read = *again.robots.front().model;
  EXPECT_EQ(read.lower(), model.lower());
  EXPECT_EQ(read.upper(), model.upper());
  EXPECT_EQ(again.start, scene.start);
  EXPECT_EQ(read.variable(0).name, "base/trans_x");
}

TEST(SceneWriter, WritesWhatTheReaderReadsBack) {
  const SceneFiles files;
  const Scene scene = full_scene(files);
  write_scene(scene, files.folder() / "copy.yaml");
  expect_same(read_scene(files.folder() / "copy.yaml"), scene);
}

TEST(SceneWriter, WritesTheSameTextAgain) {
  const SceneFiles files;
  const auto copy = files.folder() / "copy.yaml";
  write_scene(full_scene(files), copy);
  const std::string first = files.read(copy);
  for (int i = 0; i < 3; ++i) {
    write_scene(read_scene(copy), copy);
    EXPECT_EQ(files.read(copy), first);
  }
}

TEST(SceneWriter, KeepsRoundNumbersRound) {
  const SceneFiles files;
  const auto file = files.scene(
      "objects:\n  - {name: a, sphere: {radius: 0.1}, "
      "pose: {xyz: [0.1, 0, 0], rpy_deg: [180, 30.5, -90]}}\n");
  write_scene(read_scene(file), file);
  EXPECT_THAT(files.read(file), HasSubstr("pose: {xyz: [0.1, 0, 0], rpy_deg: [180, 30.5, -90]}"));
}

TEST(SceneWriter, KeepsTheCommentsAtTheTop) {
  const SceneFiles files;
  const auto file = files.write(
      "scene.yaml", "# First\n\n  # second\n\nhandway: 1\n# lost\nrobots: [{model: arm.urdf}]\n");
  write_scene(read_scene(file), file);
  EXPECT_THAT(files.read(file), StartsWith("# First\n\n  # second\nhandway: 1\n"));
}

TEST(SceneWriter, NamesTheSameFilesFromAnotherFolder) {
  const SceneFiles files;
  const Scene scene = full_scene(files);
  std::filesystem::create_directories(files.folder() / "sub/folder");
  const auto moved = files.folder() / "sub/folder/moved.yaml";
  write_scene(scene, moved);
  const Scene copy = read_scene(moved);
  EXPECT_EQ(copy.robots[0].file, "../../arm.urdf");
  EXPECT_EQ(copy.hand_basis, "../../basis.yaml");
  EXPECT_THAT(files.read(moved), HasSubstr("file: ../../square.obj"));
  EXPECT_THAT(files.read(moved), HasSubstr("grasps: ../../grasps.yaml"));
  EXPECT_EQ(std::get<Mesh>(copy.objects[4].shape).file, files.folder() / "square.obj");
}

TEST(SceneWriter, SavesMeshesOfProgramsBesideTheScene) {
  const SceneFiles files;
  Scene scene = read_scene(files.scene(""));
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.25, 0}};
  mesh->triangles = {{0, 1, 2}};
  for (const char* name : {"a/b", "a b"}) {
    SceneObject object;
    object.name = name;
    object.shape = Mesh{name == std::string("a b") ? "can.wrl" : "", {3, 3, 3}, mesh};
    scene.objects.push_back(object);
  }
  write_scene(scene, files.folder() / "saved.yaml");
  const Scene copy = read_scene(files.folder() / "saved.yaml");
  ASSERT_EQ(copy.objects.size(), 2U);
  for (const SceneObject& object : copy.objects) {
    EXPECT_EQ(std::get<Mesh>(object.shape).triangles->vertices, mesh->vertices);
  }
  EXPECT_EQ(std::get<Mesh>(copy.objects[1].shape).file,
            files.folder() / "saved_meshes" / "a_b_2.obj");
}

TEST(SceneWriter, LeavesTheOldFileWhereItCanNotWrite) {
  const SceneFiles files;
  const Scene scene = read_scene(files.scene(""));
  EXPECT_THAT(input_error_of([&] { write_scene(scene, files.folder() / "no/such/folder.yaml"); }),
              HasSubstr("folder.yaml"));
  if (::geteuid() != 0) {  // root may write everywhere
    const auto locked = files.write("locked/scene.yaml", "handway: 1\n");
    std::filesystem::permissions(locked.parent_path(), std::filesystem::perms::owner_read |
                                                           std::filesystem::perms::owner_exec);
    EXPECT_THROW(write_scene(scene, locked), InputError);
    EXPECT_EQ(files.read(locked), "handway: 1\n");
    std::filesystem::permissions(locked.parent_path(), std::filesystem::perms::owner_all);
  }
}

TEST(SceneWriter, SavesRobotsOfImportersBesideTheScene) {
  const SceneFiles files;
  Scene scene = read_scene(files.scene(""));
  scene.robots[0].file = files.write("arm.rob", "x");
  write_scene(scene, files.folder() / "s.yaml");
  const Scene copy = read_scene(files.folder() / "s.yaml");
  EXPECT_EQ(copy.robots[0].file, "s_arm.urdf");
  EXPECT_EQ(copy.robots[0].model->variable_count(), 2);
}

}  // namespace
}  // namespace handway::geometric
