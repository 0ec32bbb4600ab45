/// Joints that follow several others.
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

namespace handway::geometric {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kUrdf = R"(<robot name="finger">
  <link name="palm"/><link name="near"/><link name="middle"/><link name="far"/>
  <joint name="knuckle" type="revolute"><parent link="palm"/><child link="near"/>
    <axis xyz="0 1 0"/><limit lower="-0.5" upper="1.5" velocity="1" effort="1"/></joint>
  <joint name="bend" type="revolute"><parent link="near"/><child link="middle"/>
    <origin xyz="0 0 0.05"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="1.6" velocity="1" effort="1"/></joint>
  <joint name="tip" type="revolute"><parent link="middle"/><child link="far"/>
    <origin xyz="0 0 0.03" rpy="0.3 0 0"/><axis xyz="0 1 0"/>
    <limit lower="LOWER" upper="UPPER" velocity="1" effort="1"/></joint>
</robot>
)";

class Finger {
 public:
  explicit Finger(const std::string& lower = "-2", const std::string& upper = "2") {
    std::string text = kUrdf;
    text.replace(text.find("LOWER"), 5, lower);
    text.replace(text.find("UPPER"), 5, upper);
    write("finger.urdf", text);
  }

  void write(const char* name, const std::string& text) const { std::ofstream(path(name)) << text; }
  [[nodiscard]] std::filesystem::path path(const char* name) const { return folder_.path() / name; }
  [[nodiscard]] RobotDescription read() const {
    return load_robot(path("finger.urdf"))->description();
  }

 private:
  test::ScratchFolder folder_;
};

const JointCoupling kTip{"tip", {{"knuckle", 0.4}, {"bend", 0.8}}, 0.1};

RobotModel coupled(const Finger& finger, const JointCoupling& coupling = kTip) {
  RobotDescription robot = finger.read();
  couple_joint(robot, coupling, "scene.yaml", "couplings");
  return RobotModel(std::move(robot));
}

Pose far_link(const RobotModel& model, const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  return X_BL[static_cast<std::size_t>(model.find_link("far").value())];
}

TEST(JointCoupling, MovesTheLinkByTheSum) {
  const Finger finger;
  const RobotModel free(finger.read());
  const RobotModel model = coupled(finger);
  ASSERT_EQ(model.variable_count(), 2);
  std::mt19937 draws(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    Configuration q(2);
    for (int v = 0; v < 2; ++v) {
      q[v] = model.lower()[v] + share(draws) * (model.upper()[v] - model.lower()[v]);
    }
    const double tip = 0.1 + 0.4 * q[0] + 0.8 * q[1];
    EXPECT_TRUE(
        far_link(model, q).isApprox(far_link(free, Eigen::Vector3d(q[0], q[1], tip)), 1e-12));
    RobotState state(std::make_shared<const RobotModel>(model));
    state.set_configuration(q);
    EXPECT_NEAR(state.joint_value("tip"), tip, 1e-12);
    EXPECT_NEAR(joint_values(model, q).back().value, tip, 1e-12)
        << "what files and controllers get";
    EXPECT_THAT(limit_violations(model, q), IsEmpty());
  }
}

TEST(JointCoupling, KeepsTheLimitsOfTheJoint) {
  const Finger finger("0", "1");
  const RobotModel model = coupled(finger);
  EXPECT_THAT(model.description().warnings,
              Contains(AllOf(HasSubstr("knuckle, bend are limited"), HasSubstr("tip"))));
  for (const double knuckle : {model.lower()[0], model.upper()[0]}) {
    for (const double bend : {model.lower()[1], model.upper()[1]}) {
      const double tip = 0.1 + 0.4 * knuckle + 0.8 * bend;
      EXPECT_GE(tip, -1e-9);
      EXPECT_LE(tip, 1.0 + 1e-9);
    }
  }
  EXPECT_NEAR(0.1 + 0.4 * model.upper()[0] + 0.8 * model.upper()[1], 1.0, 1e-9)
      << "and goes as far as they let it";
  EXPECT_NEAR(model.lower()[0], -0.25, 1e-9);
}

TEST(JointCoupling, IsOfTheSrdf) {
  const Finger finger;
  finger.write("finger.srdf", R"(<robot name="finger">
  <coupling joint="tip" offset="0.1"><follows joint="knuckle" multiplier="0.4"/>
    <follows joint="bend" multiplier="0.8"/></coupling>
</robot>)");
  const auto model = load_robot(finger.path("finger.urdf"));
  EXPECT_EQ(model->variable_count(), 2);
  const Configuration q = Eigen::Vector2d(0.5, 0.5);
  EXPECT_TRUE(far_link(*model, q).isApprox(far_link(coupled(Finger()), q)));
}

constexpr const char* kScene = R"(handway: 1
robots:
  - name: finger
    model: finger.urdf
    couplings: {tip: {of: {knuckle: 0.4, bend: 0.8}, offset: 0.1}}
start: {knuckle: 0.5, tip: 0.7}
)";

TEST(JointCoupling, IsOfAScene) {
  const Finger finger;
  finger.write("scene.yaml", kScene);
  const std::string refused =
      test::refusal_of([&] { static_cast<void>(read_scene(finger.path("scene.yaml"))); });
  EXPECT_THAT(refused, HasSubstr("which follows from its coupling")) << "not from one value";
  std::string text = kScene;
  text.replace(text.find("tip: 0.7"), 8, "bend: 0.5");
  finger.write("scene.yaml", text);
  const Scene scene = read_scene(finger.path("scene.yaml"));
  EXPECT_EQ(scene.robots.front().model->variable_count(), 2);
  write_scene(scene, finger.path("again.yaml"));
  const Scene again = read_scene(finger.path("again.yaml"));
  EXPECT_TRUE(far_link(*again.robots.front().model, *again.start)
                  .isApprox(far_link(*scene.robots.front().model, *scene.start), 1e-12));
}

TEST(JointCoupling, RefusesWhatMakesNoSense) {
  const Finger finger;
  const auto refused = [&](const JointCoupling& coupling) {
    RobotDescription robot = finger.read();
    return test::refusal_of([&] { couple_joint(robot, coupling, "scene.yaml:3", "couplings"); });
  };
  EXPECT_THAT(refused({"tp", {{"bend", 1.0}}}),
              AllOf(HasSubstr("scene.yaml:3"), HasSubstr("\"tp\", which the robot has not"),
                    HasSubstr("Did you mean \"tip\"?")));
  EXPECT_THAT(refused({"tip", {}}), HasSubstr("no joint to follow"));
  EXPECT_THAT(refused({"tip", {{"tip", 1.0}}}), HasSubstr("which follows others itself"));
  EXPECT_THAT(refused({"tip", {{"bend", 0.0}}}), HasSubstr("the multiplier 0"));
  EXPECT_THAT(refused({"tip", {{"bend", 1.0}}, 5.0}), HasSubstr("a value within its limits"));
}

}  // namespace
}  // namespace handway::geometric
