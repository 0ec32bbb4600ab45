#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway_test/paths.h"
#include "kautham_importer.h"
#include "kautham_model.h"
#include "reference_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace handway::test {
namespace {

using sampling::PmdBasis;

PmdBasis shipped_basis() {
  return sampling::read_pmd_basis(source_dir() / "resources/bases/sah_auro.yaml");
}

TEST(ShippedHandBasis, IsThePapersThumbAndFourDirections) {
  const PmdBasis basis = shipped_basis();
  EXPECT_EQ(basis.hand, "sah_right");
  EXPECT_FALSE(basis.source.empty());
  ASSERT_EQ(basis.free_joints.size(), 1U);
  EXPECT_EQ(basis.joints[static_cast<std::size_t>(basis.free_joints[0].joint)], "thumb_base");
  ASSERT_EQ(basis.directions.size(), 4U);
  for (std::size_t i = 1; i < basis.directions.size(); ++i) {
    EXPECT_LE(basis.directions[i].half_side, basis.directions[i - 1].half_side);
  }
}

TEST(ShippedHandBasis, FitsTheShippedRobots) {
  const PmdBasis basis = shipped_basis();
  for (const char* robot : {"sah_right", "tx90_sah"}) {
    const auto model = geometric::load_robot(source_dir() / "resources/robots" / robot /
                                             (std::string(robot) + ".urdf"));
    const std::vector<int> variables = model->find_group("hand").value();
    std::vector<std::string> hand;
    hand.reserve(variables.size());
    for (const int variable : variables) {
      hand.push_back(model->variable(variable).name);
    }
    EXPECT_THAT(basis.joints, testing::UnorderedElementsAreArray(hand)) << robot;
  }
}

TEST(ShippedHandBasis, TakesThePosturesOfTheReferenceControls) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto file = reference / "auro/robots/TX90_RHand_5PMD_thumb2.rob";
  const import_kautham::KauthamRobot theirs = import_kautham::read_kautham_robot(file);
  const auto their_model = import_kautham::KauthamImporter().read(file).scene->robots.front().model;
  const auto our_model =
      geometric::load_robot(source_dir() / "resources/robots/sah_right/sah_right.urdf");
  const PmdBasis basis = shipped_basis();

  // Axis of the basis by the control's name; its arm controls have none.
  std::map<std::string, int> axes = {{"Thumb", 0}};
  for (const sampling::PrincipalDirection& direction : basis.directions) {
    axes.emplace(direction.name, static_cast<int>(axes.size()));
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int sample = 0; sample < 100; ++sample) {
    Eigen::VectorXd u(basis.dimension());
    Eigen::VectorXd controls =
        Eigen::VectorXd::Constant(static_cast<Eigen::Index>(theirs.controls.size()), 0.5);
    int used = 0;
    for (std::size_t i = 0; i < theirs.controls.size(); ++i) {
      if (const auto axis = axes.find(theirs.controls[i].name); axis != axes.end()) {
        controls[static_cast<Eigen::Index>(i)] = u[axis->second] = unit(random);
        ++used;
      }
    }
    ASSERT_EQ(used, basis.dimension());
    const geometric::Configuration expected = import_kautham::configuration_at(
        theirs, *their_model, controls, import_kautham::BaseLimits{}, geometric::Pose::Identity());
    const Eigen::VectorXd posture = sampling::map_to_posture(basis, u);
    for (int i = 0; i < their_model->variable_count(); ++i) {
      const std::string name = joint_name_of(their_model->variable(i).name);
      const auto joint = std::find(basis.joints.begin(), basis.joints.end(), name);
      const auto variable = our_model->find_variable(name);
      if (!variable) {
        continue;  // of the arm
      }
      ASSERT_NE(joint, basis.joints.end()) << name;
      const double lower = our_model->lower()[*variable];
      const double range = our_model->upper()[*variable] - lower;
      EXPECT_NEAR(lower + range * posture[joint - basis.joints.begin()], expected[i], 1e-9) << name;
    }
  }
}

}  // namespace
}  // namespace handway::test
