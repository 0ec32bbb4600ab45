#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/collision_checker.h"
#include "handway_test/paths.h"
#include "kautham_importer.h"
#include "modified_dh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace handway::import_kautham {
namespace {

namespace fs = std::filesystem;

using geometric::Configuration;
using geometric::Pose;
using geometric::RobotModel;
using test::ModifiedDhRobot;

const std::vector<std::string> kProblems = {
    "TX90_RHand_ICRA10_5PMD_TwoCanb_new.xml", "TX90_RHand_ICRA10_5PMD_CanBox_new.xml",
    "TX90_RHand_ICRA10_5PMD_ShelfCan2_new.xml", "TX90_RHand_ICRA10_5PMD-shelfT2_new.xml"};

planning::SceneState read(const std::filesystem::path& file) {
  const KauthamImporter importer;
  EXPECT_TRUE(importer.can_read(file)) << file;
  return importer.read(file);
}

std::map<std::string, double> by_name(const RobotModel& model, const Configuration& q) {
  std::map<std::string, double> values;
  for (const auto& [joint, value] : geometric::joint_values(model, q)) {
    values[std::string(joint)] = value;
  }
  return values;
}

double largest_difference(const RobotModel& model, const ModifiedDhRobot& expected,
                          const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  auto poses = expected.poses(by_name(model, q));
  double largest = 0.0;
  for (int i = 0; i < model.link_count(); ++i) {
    Pose pose = poses.at(model.link(i).name);
    pose.translation() *= 1e-3;
    largest = std::max(
        largest,
        (pose.matrix() - X_BL[static_cast<std::size_t>(i)].matrix()).cwiseAbs().maxCoeff());
  }
  return largest;
}

void expect_same_kinematics(const RobotModel& model, const ModifiedDhRobot& expected) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    Configuration q = model.lower();
    for (int v = 0; v < model.variable_count(); ++v) {
      q[v] += share(random) * (model.upper()[v] - model.lower()[v]);
    }
    ASSERT_LT(largest_difference(model, expected, q), 1e-9) << q.transpose();
  }
}

std::size_t triangle_count(const geometric::Link& link) {
  return std::get<geometric::Mesh>(link.collision.front().shape).triangles->triangles.size();
}

std::vector<double> controls(pugi::xml_node node) {
  std::istringstream text(node.child_value());
  return {std::istream_iterator<double>(text), {}};
}

class ReferenceProblem : public testing::TestWithParam<std::string> {};

TEST_P(ReferenceProblem, StartsAndEndsWhereItsControlsSay) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto file = reference / "auro" / GetParam();
  const planning::SceneState loaded = read(file);
  const RobotModel& model = *loaded.scene->robots.front().model;
  ASSERT_TRUE(loaded.scene->start && loaded.scene->goal);
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_file(file.c_str()));
  const auto query = xml.child("Problem").child("Planner").child("Queries").child("Query");
  const ModifiedDhRobot robot(reference / "auro/robots/TX90_RHand_5PMD_thumb2.rob");
  for (const auto& [q, element] :
       {std::pair(*loaded.scene->start, "Init"), std::pair(*loaded.scene->goal, "Goal")}) {
    auto expected = robot.values(controls(query.child(element)));
    for (const auto& [joint, value] : by_name(model, q)) {
      EXPECT_NEAR(value, expected.at(joint), 1e-12) << element << " " << joint;
    }
  }
}

TEST_P(ReferenceProblem, HasFreeEnds) {
  HANDWAY_NEED_REFERENCE(reference);
  const planning::SceneState loaded = read(reference / "auro" / GetParam());
  const auto world = std::make_shared<const geometric::CollisionWorld>(*loaded.scene);
  geometric::FclChecker checker(world);
  EXPECT_THAT(geometric::find_collisions(checker, *loaded.scene->start), testing::IsEmpty());
  EXPECT_THAT(geometric::find_collisions(checker, *loaded.scene->goal), testing::IsEmpty());
  const auto start = geometric::find_clearance(checker, *loaded.scene->start);
  const auto goal = geometric::find_clearance(checker, *loaded.scene->goal);
  RecordProperty("start_clearance_mm", std::to_string(1e3 * start.distance));
  RecordProperty("goal_clearance_mm", std::to_string(1e3 * goal.distance));
  EXPECT_GT(start.distance, 0.0);
  EXPECT_GT(goal.distance, 0.0);
}

TEST_P(ReferenceProblem, ChecksThePairsThatKauthamChecks) {
  HANDWAY_NEED_REFERENCE(reference);
  const planning::SceneState loaded = read(reference / "auro" / GetParam());
  const RobotModel& model = *loaded.scene->robots.front().model;
  const ModifiedDhRobot robot(reference / "auro/robots/TX90_RHand_5PMD_thumb2.rob");
  const auto& rows = robot.rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      const bool checked = j >= i + 2 && rows[i].name != "Palm";
      EXPECT_NE(
          checked,
          model.description().allowed_collisions.reason(rows[i].name, rows[j].name).has_value())
          << rows[i].name << " " << rows[j].name;
    }
  }
  // 25 links: 300 pairs, 24 of neighbours, 16 more of the palm; and 24 moving links per object.
  const geometric::CollisionWorld world(*loaded.scene);
  EXPECT_EQ(world.pairs().size(), 260U + 24U * loaded.scene->objects.size());
}

TEST_P(ReferenceProblem, NamesItsObjectsApart) {
  HANDWAY_NEED_REFERENCE(reference);
  const planning::SceneState loaded = read(reference / "auro" / GetParam());
  std::set<std::string> names;
  for (const geometric::SceneObject& object : loaded.scene->objects) {
    EXPECT_TRUE(names.insert(object.name).second) << object.name;
    EXPECT_FALSE(std::get<geometric::Mesh>(object.shape).triangles->empty()) << object.name;
  }
  EXPECT_TRUE(names.contains("can") || names.contains("cangoal"));
}

TEST_P(ReferenceProblem, LeavesThePlannerToTheDefault) {
  HANDWAY_NEED_REFERENCE(reference);
  const planning::SceneState loaded = read(reference / "auro" / GetParam());
  EXPECT_EQ(loaded.scene->planner.name, "");
  EXPECT_THAT(loaded.scene->planner.settings, testing::IsEmpty());
  EXPECT_THAT(loaded.scene->warnings, testing::ElementsAre(testing::HasSubstr("Cloud Radius = ")));
}

TEST_P(ReferenceProblem, FindsItsFilesInOtherLetters) {
  HANDWAY_NEED_REFERENCE(reference);
  const test::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "auro";
  test::copy_folder(reference / "auro", folder);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files.push_back(entry.path());
    }
  }
  for (const fs::path& file : files) {
    std::string name = file.filename().string();
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
    fs::rename(file, file.parent_path() / name);
  }
  std::string problem = GetParam();
  std::ranges::transform(problem, problem.begin(), [](unsigned char c) { return std::toupper(c); });
  const planning::SceneState loaded = read(folder / problem);
  const planning::SceneState original = read(reference / "auro" / GetParam());
  ASSERT_EQ(loaded.scene->objects.size(), original.scene->objects.size());
  for (std::size_t i = 0; i < loaded.scene->objects.size(); ++i) {
    EXPECT_EQ(
        std::get<geometric::Mesh>(loaded.scene->objects[i].shape).triangles->triangles.size(),
        std::get<geometric::Mesh>(original.scene->objects[i].shape).triangles->triangles.size())
        << "with what it includes";
  }
}

INSTANTIATE_TEST_SUITE_P(Auro, ReferenceProblem, testing::ValuesIn(kProblems),
                         [](const auto& test) {
                           std::string name;
                           for (const char c : test.param) {
                             name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           }
                           return name;
                         });

struct RobotFile {
  std::string name;
  std::vector<std::string> coupled;
  std::size_t hand_joints;
};

class ReferenceRobot : public testing::TestWithParam<RobotFile> {};

TEST_P(ReferenceRobot, MovesAsItsModifiedDhParametersSay) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto file = reference / "auro/robots" / GetParam().name;
  const planning::SceneState loaded = read(file);
  const RobotModel& model = *loaded.scene->robots.front().model;
  EXPECT_EQ(model.link_count(), 25);
  EXPECT_EQ(model.find_group("arm")->size(), 6U);
  EXPECT_EQ(model.find_group("hand")->size(), GetParam().hand_joints);
  expect_same_kinematics(model, ModifiedDhRobot(file));
}

TEST_P(ReferenceRobot, CouplesTheDistalJoints) {
  HANDWAY_NEED_REFERENCE(reference);
  const planning::SceneState loaded = read(reference / "auro/robots" / GetParam().name);
  const RobotModel& model = *loaded.scene->robots.front().model;
  std::vector<std::string> coupled;
  for (int i = 1; i < model.link_count(); ++i) {
    if (const auto& mimic = model.joint(i).mimic) {
      EXPECT_EQ(mimic->joint, model.joint(i).parent);
      coupled.push_back(model.joint(i).name);
    }
  }
  EXPECT_EQ(coupled, GetParam().coupled);
}

INSTANTIATE_TEST_SUITE_P(
    Auro, ReferenceRobot,
    testing::Values(
        RobotFile{"TX90_RHand_5PMD_thumb2.rob",
                  {"Thumb-Dist", "Index-Dist", "Mid-Dist", "Ring-Dist"},
                  13},
        RobotFile{
            "TX90_RHand_allDOF.rob", {"Thumb-Dist", "Index-Dist", "Mid-Dist", "Ring-Dist"}, 13},
        // Its control C6 gives the thumb's last two joints different factors.
        RobotFile{"TX90_RHand_13PMD_SUN.rob", {"Index-Dist", "Mid-Dist", "Ring-Dist"}, 14}),
    [](const auto& test) { return test.param.name.substr(0, test.param.name.size() - 4); });

// Check values of the frames, computed from the table by hand-written matrices
// (palm frame, mm): middle finger stretched, proximal joint bent, thumb opposed.
TEST(ReferenceFingers, StandWhereTheTableSays) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto loaded = read(reference / "auro/robots/TX90_RHand_5PMD_thumb2.rob");
  const RobotModel& model = *loaded.scene->robots.front().model;
  struct Case {
    std::map<std::string, double> degrees;
    std::string link;
    Eigen::Vector3d p_mm;
  };
  const std::vector<Case> cases = {
      {{{"Mid-Med", -4}}, "Mid-Dist", {-2.2, 0, 247.9}},
      {{{"Mid-Prox", -75}, {"Mid-Med", -4}}, "Mid-Dist", {90.6, 0, 173.4}},
      {{{"Mid-Prox", 4}, {"Mid-Med", -75}}, "Mid-Dist", {19.3, 0, 227.5}},
      {{{"Mid-Base", 15}, {"Mid-Med", -4}}, "Mid-Dist", {-2.2, -25.3, 244.5}},
      {{{"Index-Med", -4}}, "Index-Dist", {-2.2, 43.6, 243.1}},
      {{{"Ring-Med", -4}}, "Ring-Dist", {-2.2, -43.5, 243.1}},
      {{{"Thumb-Med", -4}}, "Thumb-Dist", {-9.0, 168.3, 178.2}},
      {{{"Thumb", -45}, {"Thumb-Med", -4}}, "Thumb-Dist", {92.6, 131.2, 178.2}},
      {{{"Thumb", -90}, {"Thumb-Med", -4}}, "Thumb-Dist", {138.2, 33.1, 178.2}}};
  for (const Case& test : cases) {
    Configuration q = Configuration::Zero(model.variable_count());
    for (const auto& [joint, angle] : test.degrees) {
      q[model.find_variable(joint).value()] = angle * M_PI / 180.0;
    }
    std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
    model.forward_kinematics(q, X_BL);
    const Pose& X_BP = X_BL[static_cast<std::size_t>(model.find_link("Palm").value())];
    const Pose& X_BD = X_BL[static_cast<std::size_t>(model.find_link(test.link).value())];
    const Eigen::Vector3d p_PD = 1e3 * (X_BP.inverse() * X_BD.translation());
    EXPECT_LT((p_PD - test.p_mm).cwiseAbs().maxCoeff(), 0.06) << test.link << p_PD.transpose();
  }
}

TEST(ReferenceMeshes, KeepEveryTriangle) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto loaded = read(reference / "auro/robots/TX90_RHand_5PMD_thumb2.rob");
  const RobotModel& model = *loaded.scene->robots.front().model;
  std::size_t total = 0;
  for (int i = 0; i < model.link_count(); ++i) {
    total += triangle_count(model.link(i));
    const auto& mesh = std::get<geometric::Mesh>(model.link(i).collision.front().shape);
    const double size = geometric::bounding_box(*mesh.triangles).size().maxCoeff();
    EXPECT_GT(size, 0.02) << model.link(i).name;
    EXPECT_LT(size, 1.0) << model.link(i).name;
  }
  EXPECT_EQ(total, 181846U);
}

}  // namespace
}  // namespace handway::import_kautham
