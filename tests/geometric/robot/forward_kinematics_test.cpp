#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway_test/robots.h"
#include "random_configurations.h"

#include <gtest/gtest.h>

#include <vector>

namespace handway::geometric {
namespace {

using test::RandomConfigurations;

std::vector<Pose> link_poses(const RobotModel& model, const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  return X_BL;
}

Configuration arm_degrees(double a, double b, double c, double d, double e, double f) {
  Configuration q(6);
  q << radians(a), radians(b), radians(c), radians(d), radians(e), radians(f);
  return q;
}

Pose link_pose(const RobotModel& model, const std::string& link, const Configuration& q) {
  return link_poses(model, q)[static_cast<std::size_t>(model.find_link(link).value())];
}

/// The definition, joint by joint, with Eigen's transforms.
std::vector<Pose> by_definition(const RobotModel& model, const Configuration& q) {
  std::vector<Pose> X_BL = {Pose::Identity()};
  for (int i = 1; i < model.link_count(); ++i) {
    const Joint& joint = model.joint(i);
    const RobotModel::MimicMapping& drive = model.mimic_mapping(i);
    Pose X = X_BL[static_cast<std::size_t>(model.parent(i))] * joint.X_PJ;
    if (drive.variable >= 0) {
      const double value = drive.multiplier * q[drive.variable] + drive.offset;
      if (joint.type == JointType::kRevolute) {
        X.rotate(Eigen::AngleAxisd(value, joint.axis));
      } else {
        X.translate(Eigen::Vector3d(value * joint.axis));
      }
    }
    X_BL.push_back(X);
  }
  return X_BL;
}

double largest_difference(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, (a[i].matrix() - b[i].matrix()).cwiseAbs().maxCoeff());
  }
  return largest;
}

/// A robot with every kind of joint: skew and negative axes, sliding, couplings.
RobotDescription awkward_robot() {
  RobotDescription robot;
  robot.name = "awkward";
  robot.links.push_back({"root", {}, {}});
  const auto add = [&](const std::string& parent, JointType type, const Eigen::Vector3d& axis,
                       std::optional<Mimic> mimic = std::nullopt) {
    std::string name = "l" + std::to_string(robot.links.size());
    robot.links.push_back({name, {}, {}});
    Joint joint;
    joint.name = "j" + name;
    joint.type = type;
    joint.parent = parent;
    joint.child = name;
    joint.X_PJ = pose_from_rpy({0.1, -0.2, 0.3}, 0.4, -0.5, 0.6);
    joint.axis = axis.normalized();
    joint.limits.lower = -2.0;
    joint.limits.upper = 3.0;
    joint.mimic = std::move(mimic);
    robot.joints.push_back(joint);
    return name;
  };
  const std::string a = add("root", JointType::kRevolute, {1, 2, 3});
  const std::string b = add(a, JointType::kPrismatic, {0, -1, 1});
  const std::string c = add(b, JointType::kRevolute, {-1, 0, 0});
  add(c, JointType::kRevolute, {0, -1, 0}, Mimic{"jl1", -0.5, 0.2});
  add(c, JointType::kPrismatic, {0, 0, 1}, Mimic{"jl2", 2.0, -0.1});
  add(a, JointType::kFixed, {0, 0, 1});
  return robot;
}

TEST(ForwardKinematics, GivesThePublishedFlangePosesOfTheTx90) {
  for (const RobotDescription& robot : {test::tx90_urdf_style(), test::tx90_dh_style()}) {
    const RobotModel model(robot);
    const std::string tip = model.link(model.link_count() - 1).name;
    const Pose zero = link_pose(model, tip, arm_degrees(0, 0, 0, 0, 0, 0));
    EXPECT_TRUE(zero.translation().isApprox(Eigen::Vector3d(0.050, 0.050, 1.428), 1e-12));
    EXPECT_TRUE(zero.linear().isIdentity(1e-12));

    const Pose bent = link_pose(model, tip, arm_degrees(0, 0, 90, 0, 0, 0));
    EXPECT_TRUE(bent.translation().isApprox(Eigen::Vector3d(0.575, 0.050, 0.903), 1e-12));

    const Pose any = link_pose(model, tip, arm_degrees(30, -40, 100, 20, 50, -60));
    const Eigen::Vector3d p(0.1667455, 0.1842591, 0.9858677);
    EXPECT_LT((any.translation() - p).norm(), 1e-7);
    Eigen::Matrix3d R;
    R << 0.3237, -0.6752, 0.6628, -0.6259, 0.3725, 0.6852, -0.7096, -0.6366, -0.3020;
    EXPECT_LT((any.linear() - R).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST(ForwardKinematics, GivesTheKnownFingerPositionsOfTheSahHand) {
  const RobotModel model(test::tx90_sah());
  ASSERT_EQ(model.link_count(), 25);
  ASSERT_EQ(model.variable_count(), 19);
  Configuration q = Configuration::Zero(19);
  for (int v = 6; v < 19; ++v) {
    if (model.variable(v).name.ends_with("-Med")) {
      q[v] = radians(-4);
    }
  }
  const auto in_palm = [&](const char* link) {
    const std::vector<Pose> X_BL = link_poses(model, q);
    const auto at = [&](const char* name) {
      return X_BL[static_cast<std::size_t>(model.find_link(name).value())];
    };
    return Eigen::Vector3d((at("Palm").inverse() * at(link)).translation() / kMillimetre);
  };
  EXPECT_LT((in_palm("Mid-Dist") - Eigen::Vector3d(-2.2, 0, 247.9)).norm(), 0.1);
  EXPECT_LT((in_palm("Index-Dist") - Eigen::Vector3d(-2.2, 43.6, 243.1)).norm(), 0.1);
  EXPECT_LT((in_palm("Ring-Dist") - Eigen::Vector3d(-2.2, -43.5, 243.1)).norm(), 0.1);
  EXPECT_LT((in_palm("Thumb-Dist") - Eigen::Vector3d(-9.0, 168.3, 178.2)).norm(), 0.1);
  q[model.find_variable("Thumb").value()] = radians(-90);
  EXPECT_LT((in_palm("Thumb-Dist") - Eigen::Vector3d(138.2, 33.1, 178.2)).norm(), 0.1);
}

TEST(ForwardKinematics, AgreesWithItsDefinitionOnEveryKindOfJoint) {
  for (const RobotDescription& robot : {awkward_robot(), test::tx90_sah(), test::tx90_dh_style()}) {
    const RobotModel model(robot);
    RandomConfigurations random(model, 1);
    for (int k = 0; k < 1000; ++k) {
      const Configuration q = random.next();
      ASSERT_LT(largest_difference(link_poses(model, q), by_definition(model, q)), 1e-14);
    }
  }
}

TEST(ForwardKinematics, KeepsRotationsOrthonormal) {
  const RobotModel model(test::tx90_sah());
  RandomConfigurations random(model, 2);
  for (int k = 0; k < 1000; ++k) {
    for (const Pose& X : link_poses(model, random.next())) {
      ASSERT_TRUE((X.linear() * X.linear().transpose()).isIdentity(1e-14));
      ASSERT_EQ(X.matrix().row(3), Eigen::RowVector4d(0, 0, 0, 1));
    }
  }
}

TEST(ForwardKinematics, GivesTheSameBitsEveryTime) {
  const RobotModel model(test::tx90_sah());
  RandomConfigurations random(model, 3);
  for (int k = 0; k < 100; ++k) {
    const Configuration q = random.next();
    EXPECT_EQ(largest_difference(link_poses(model, q), link_poses(model, q)), 0.0);
  }
}

}  // namespace
}  // namespace handway::geometric
