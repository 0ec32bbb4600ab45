#include "handway/planning/tasks/object_choice.h"

#include "handway/geometric/setup/placing.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using geometric::SceneObject;
using ::testing::AllOf;
using ::testing::HasSubstr;

SceneObject box(const std::string& name, const Vector3d& size, const Vector3d& p_W) {
  SceneObject object;
  object.name = name;
  object.shape = geometric::Box{size};
  object.X_PO = Pose(Eigen::Translation3d(p_W));
  return object;
}

class ObjectChoices : public testing::Test {
 protected:
  ObjectChoices() {
    auto scene = std::make_shared<geometric::Scene>();
    scene->objects = {box("table", {1, 1, 0.1}, {0, 0, 0.45}),
                      box("brick", {0.1, 0.06, 0.2}, {0.3, 0.1, 0.6 + geometric::kRestingGap}),
                      box("mug", {0.08, 0.08, 0.1}, {-0.3, 0.1, 0.55 + geometric::kRestingGap})};
    scene->objects[1].grasps = "brick_grasps.yaml";
    state_.scene = std::move(scene);
  }

  // @param entries of the list `objects`, a line each.
  [[nodiscard]] std::vector<ObjectChoice> read(const std::vector<std::string>& entries) const {
    const std::filesystem::path file = folder_.path() / "objects.yaml";
    std::ofstream stream(file);
    stream << "objects:\n";
    for (const std::string& entry : entries) {
      stream << "  - " << entry << '\n';
    }
    stream.close();
    return read_object_choices(file, *state_.scene, task_);
  }
  [[nodiscard]] std::string refusal(const std::vector<std::string>& entries) const {
    return test::refusal_of([&] { static_cast<void>(read(entries)); });
  }

  test::ScratchFolder folder_;
  SceneState state_;
  Task task_{PickStep{"brick"}, PlaceStep{{"table"}}};
};

TEST_F(ObjectChoices, AreDrawnWithSizesInTheirRanges) {
  const std::vector<ObjectChoice> choices =
      read({"{object: mug}", "{name: post, box: {size: [[0.03, 0.05], 0.04, [0.1, 0.2]]}}",
            "{sphere: {radius: [0.02, 0.04]}}", "{cylinder: {radius: 0.03, length: [0.1, 0.2]}}"});
  ASSERT_EQ(choices.size(), 4U);
  EXPECT_EQ(choices[0].name, "mug");
  EXPECT_EQ(choices[3].name, "cylinder");
  std::set<std::size_t> drawn_choices;
  std::set<double> heights;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const DrawnObject drawn = draw_object(choices, seed);
    drawn_choices.insert(drawn.choice);
    EXPECT_EQ(drawn.shape.has_value(), drawn.choice != 0);
    if (drawn.choice == 1) {
      const Vector3d size = std::get<geometric::Box>(*drawn.shape).size;
      EXPECT_GE(size.x(), 0.03);
      EXPECT_LE(size.x(), 0.05);
      EXPECT_EQ(size.y(), 0.04);
      EXPECT_GE(size.z(), 0.1);
      EXPECT_LE(size.z(), 0.2);
      heights.insert(size.z());
    }
  }
  EXPECT_EQ(drawn_choices.size(), 4U) << "each is drawn";
  EXPECT_GT(heights.size(), 5U);
}

TEST_F(ObjectChoices, DependOnTheSeedAlone) {
  const std::vector<ObjectChoice> choices =
      read({"{box: {size: [[0.03, 0.05], 0.04, 0.1]}}", "{sphere: {radius: [0.02, 0.04]}}"});
  for (const std::uint64_t seed : {1U, 7U, 8U}) {
    const DrawnObject once = draw_object(choices, seed);
    static_cast<void>(draw_object(choices, seed + 1));
    const DrawnObject again = draw_object(choices, seed);
    EXPECT_EQ(once.choice, again.choice);
    EXPECT_EQ(once.sizes, again.sizes);
  }
}

TEST_F(ObjectChoices, StandWhereThePickedObjectStood) {
  const std::vector<ObjectChoice> choices =
      read({"{cylinder: {radius: 0.03, length: 0.12}, rpy_deg: [90, 0, 0]}"});
  const SceneState changed =
      with_drawn_object(state_, "brick", choices[0], draw_object(choices, 1));
  const SceneObject& object = *changed.find("brick");
  EXPECT_TRUE(std::holds_alternative<geometric::Cylinder>(object.shape));
  EXPECT_TRUE(object.grasps.empty()) << "those are for the shape before";
  EXPECT_NEAR(object.X_PO.translation().x(), 0.3, 1e-3);
  EXPECT_NEAR(object.X_PO.translation().y(), 0.1, 1e-3);
  EXPECT_NEAR(object.X_PO.translation().z(), 0.5 + 0.03 + geometric::kRestingGap, 1e-3)
      << "it lies on the table";
  EXPECT_TRUE(std::holds_alternative<geometric::Box>(state_.find("brick")->shape));
}

TEST_F(ObjectChoices, OfTheSceneArePickedWhereTheyStand) {
  const std::vector<ObjectChoice> choices = read({"{object: mug}"});
  const DrawnObject drawn = draw_object(choices, 3);
  EXPECT_EQ(with_drawn_object(state_, "brick", choices[0], drawn).scene, state_.scene);
  const Task task = with_picked_object(task_, "brick", "mug");
  EXPECT_EQ(std::get<PickStep>(task[0]).object, "mug");
  EXPECT_EQ(std::get<PlaceStep>(task[1]).supports, std::vector<std::string>{"table"});
}

TEST_F(ObjectChoices, MeshesAreScaled) {
  std::ofstream(folder_.path() / "wedge.obj")
      << "v 0 0 0\nv 0.1 0 0\nv 0 0.2 0\nv 0 0 0.3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const std::vector<ObjectChoice> choices = read({"{mesh: {file: wedge.obj, scale: [0.5, 0.9]}}"});
  EXPECT_EQ(choices[0].name, "wedge");
  const DrawnObject drawn = draw_object(choices, 1);
  ASSERT_EQ(drawn.sizes.size(), 1U);
  EXPECT_GE(drawn.sizes[0], 0.5);
  EXPECT_LE(drawn.sizes[0], 0.9);
  const SceneState changed = with_drawn_object(state_, "brick", choices[0], drawn);
  EXPECT_TRUE(size_of_object(*changed.find("brick"))
                  .isApprox(drawn.sizes[0] * Vector3d(0.1, 0.2, 0.3), 1e-6));
}

TEST_F(ObjectChoices, WithBadRangesAreRefusedWithLineAndReason) {
  EXPECT_EQ(refusal({"{object: mug}", "{sphere: {radius: [0.04, 0.02]}}"}),
            (folder_.path() / "objects.yaml").string() +
                ":3: objects[1].sphere.radius: found the range from 0.04 to 0.02, expected "
                "[lower, upper] with a lower end that is not above the upper one.");
  EXPECT_THAT(refusal({"{sphere: {radius: 0}}"}),
              AllOf(HasSubstr("objects[0].sphere.radius"), HasSubstr("above 0 m")));
  EXPECT_THAT(refusal({"{sphere: {radius: [-0.01, 0.02]}}"}),
              HasSubstr("the range from -0.01 to 0.02"));
  EXPECT_THAT(refusal({"{box: {size: [40, 40, 100]}}"}), HasSubstr("up to 2 m"));
  EXPECT_THAT(refusal({"{box: {size: [0.01, 0.02]}}"}), HasSubstr("three edges"));
  EXPECT_THAT(refusal({"{cylinder: {radius: [0.01, 0.02, 0.03], length: 0.1}}"}),
              HasSubstr("objects[0].cylinder.radius"));
}

TEST_F(ObjectChoices, ThatCannotBePickedAreRefused) {
  EXPECT_THAT(refusal({"{object: mugg}"}), HasSubstr("Did you mean \"mug\"?"));
  EXPECT_THAT(refusal({"{object: table}"}), HasSubstr("on which the task places"));
  EXPECT_THAT(refusal({"{name: thing}"}), HasSubstr("neither a shape nor an object"));
  EXPECT_THAT(refusal({"{sphere: {radius: 0.02}, cone: {radius: 0.02, length: 0.1}}"}),
              HasSubstr("a second shape"));
  EXPECT_THAT(refusal({"{sphere: {radius: 0.02}}", "{sphere: {radius: 0.03}}"}),
              HasSubstr("a second object \"sphere\""));
  task_ = {PickStep{"brick"}, PlaceStep{{"table"}}, PickStep{"mug"}};
  EXPECT_THAT(refusal({"{sphere: {radius: 0.02}}"}), HasSubstr("2 objects: brick, mug"));
}

}  // namespace
}  // namespace handway::planning
