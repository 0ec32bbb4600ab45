#include "small_problem.h"

#include "handway/geometric/io/text_file.h"
#include "handway_test/input_errors.h"
#include "moveit_problem.h"

#include <gtest/gtest.h>

#include <fstream>

namespace handway::import_moveit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargest = 1 << 20;

constexpr const char* kUrdf = R"(<robot name="crane">
  <link name="base"/>
  <link name="tower">
    <collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.05" length="0.4"/></geometry></collision>
  </link>
  <link name="boom">
    <collision><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.04 0.04"/></geometry></collision>
  </link>
  <link name="slide">
    <collision><origin xyz="0.1 0 0"/><geometry><box size="0.2 0.03 0.03"/></geometry></collision>
  </link>
  <link name="finger">
    <collision><origin xyz="0.03 0 0"/><geometry><box size="0.06 0.01 0.02"/></geometry></collision>
  </link>
  <link name="finger_2">
    <collision><origin xyz="0.03 0 0"/><geometry><box size="0.06 0.01 0.02"/></geometry></collision>
  </link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="tower"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/>
  </joint>
  <joint name="lift" type="revolute">
    <parent link="tower"/><child link="boom"/><origin xyz="0 0 0.45"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="0.4" velocity="1" effort="1"/>
  </joint>
  <joint name="reach" type="prismatic">
    <parent link="boom"/><child link="slide"/><origin xyz="0.3 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.2" velocity="1" effort="1"/>
  </joint>
  <joint name="grip" type="prismatic">
    <parent link="slide"/><child link="finger"/><origin xyz="0.21 0.02 0"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.03" velocity="1" effort="1"/>
  </joint>
  <joint name="grip_2" type="prismatic">
    <parent link="slide"/><child link="finger_2"/><origin xyz="0.21 -0.02 0"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.03" velocity="1" effort="1"/><mimic joint="grip"/>
  </joint>
</robot>
)";

constexpr const char* kSrdf = R"(<robot name="crane">
  <group name="crane_arm"><joint name="turn"/><joint name="lift"/><joint name="reach"/></group>
  <group name="gripper"><joint name="grip"/></group>
  <disable_collisions link1="tower" link2="boom" reason="Adjacent"/>
  <disable_collisions link1="boom" link2="slide" reason="Adjacent"/>
  <disable_collisions link1="slide" link2="finger" reason="Adjacent"/>
  <disable_collisions link1="slide" link2="finger_2" reason="Adjacent"/>
  <disable_collisions link1="tower" link2="slide" reason="Never"/>
</robot>
)";

constexpr const char* kScene = R"(name: pillar
robot_model_name: crane
robot_state:
  joint_state:
    name: [turn, lift, reach, grip, grip_2]
    position: [0, 0, 0, 0.01, 0.01]
  attached_collision_objects:
    - link_name: slide
      object:
        header: {frame_id: slide}
        id: parcel
        primitives: [{type: sphere, dimensions: [0.01]}]
        primitive_poses: [{position: [0.24, 0, 0], orientation: [0, 0, 0, 1]}]
      touch_links: [finger, finger_2]
fixed_frame_transforms:
  - child_frame_id: room
    transform: {translation: {x: 0, y: 0, z: -0.1}, rotation: {w: 1}}
world:
  collision_objects:
    - id: table
      header: {frame_id: room}
      primitives:
        - {type: 1, dimensions: [2, 2, 0.1]}
      primitive_poses:
        - position: {x: 0, y: 0, z: 0.02}
          orientation: {x: 0, y: 0, z: 0, w: 1}
    - id: pillar
      pose: {position: [0.5, 0, 0]}
      primitives: [{type: cylinder, dimensions: [0.4, 0.05]}, {type: cone, dimensions: [0.1, 0.05]}]
      primitive_poses:
        - {position: [0, 0, 0.25], orientation: [0, 0, 0, 1]}
        - {position: [0, 0, 0.5], orientation: [0, 0, 0, 1]}
    - id: wedge
      meshes:
        - vertices: [[0, 0, 0], [0.1, 0, 0], {x: 0, y: 0.1}, {z: 0.1}]
          triangles: [[0, 2, 1], [0, 1, 3], {vertex_indices: [0, 3, 2]}, [1, 2, 3]]
      mesh_poses: [{position: [-0.6, 0, 0.2], orientation: [0, 0, 0, 1]}]
)";

constexpr const char* kRequest = R"(group_name: crane_arm
num_planning_attempts: 1
allowed_planning_time: 5
start_state:
  joint_state: {name: [turn, lift], position: [-0.8, 0.05]}
goal_constraints:
  - joint_constraints:
      - {joint_name: turn, position: 0.8, tolerance_above: 0.001, tolerance_below: 0.001, weight: 1}
      - {joint_name: lift, position: 0.05}
      - {joint_name: reach, position: 0.1}
)";

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace

SmallProblem::SmallProblem() {
  fs::create_directories(folder() / "robots");
  write(folder() / "robots" / "crane.urdf", kUrdf);
  write(folder() / "robots" / "crane.srdf", kSrdf);
  write(scene(), kScene);
  write(request(), kRequest);
}

void SmallProblem::replace(const fs::path& file, const std::string& from,
                           const std::string& to) const {
  std::string text = geometric::read_text_file(file, "a text", kLargest);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  ASSERT_EQ(text.find(from, at + 1), std::string::npos) << from << " twice";
  write(file, text.replace(at, from.size(), to));
}

planning::SceneState SmallProblem::read() const { return MoveitImporter().read(request()); }

std::string SmallProblem::refusal() const {
  return test::refusal_of([this] { static_cast<void>(read()); });
}

}  // namespace handway::import_moveit
