// Tests that every scene that ships is a problem that a user can open and plan at once.

#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway_test/paths.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastClearance = 1e-3;  // m
constexpr double kResolution = 2e-5;      // m
constexpr double kRounding = 5e-3;        // of written joint values, in normalised joints

fs::path scene_dir() { return test::source_dir() / "scenes"; }

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(scene_dir())) {
    if (entry.path().extension() == ".yaml") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Distance of `posture` from SC^h in the joints that stand off their limits: MAP
/// clamps the others, so that they don't tell where the posture came from.
double distance_before_clamping(const sampling::PmdBasis& basis, const Eigen::VectorXd& posture) {
  Eigen::MatrixXd axes = Eigen::MatrixXd::Zero(posture.size(), basis.dimension());
  Eigen::VectorXd centre = basis.mean;
  Eigen::Index column = 0;
  for (const sampling::FreeJoint& free : basis.free_joints) {
    centre[free.joint] = free.centre;
    axes(free.joint, column++) = 1.0;
  }
  for (const sampling::PrincipalDirection& direction : basis.directions) {
    axes.col(column++) = direction.vector;
  }
  Eigen::VectorXd offset = posture - centre;
  for (Eigen::Index i = 0; i < posture.size(); ++i) {
    if (posture[i] < kRounding || posture[i] > 1.0 - kRounding) {
      axes.row(i).setZero();
      offset[i] = 0.0;
    }
  }
  return (offset - axes * axes.completeOrthogonalDecomposition().solve(offset)).norm();
}

class ShippedScene : public testing::TestWithParam<std::string> {
 protected:
  ShippedScene()
      : file_(scene_dir() / (GetParam() + ".yaml")),
        loaded_(load_scene(file_, PluginManager())),
        problem_(make_problem(loaded_.scene, loaded_.basis)) {}

  [[nodiscard]] const fs::path& file() const { return file_; }
  [[nodiscard]] const geometric::Scene& scene() const { return *loaded_.scene; }
  [[nodiscard]] const PlanningProblem& problem() const { return problem_; }

  /// The hand's joints of `q`, normalised, in the basis' order.
  [[nodiscard]] Eigen::VectorXd posture(const Configuration& q) const {
    const geometric::RobotModel& model = problem_.model();
    Eigen::VectorXd c(static_cast<Eigen::Index>(problem_.joints.hand.size()));
    for (Eigen::Index i = 0; i < c.size(); ++i) {
      const int v = problem_.joints.hand[static_cast<std::size_t>(i)];
      c[i] = (q[v] - model.lower()[v]) / (model.upper()[v] - model.lower()[v]);
    }
    return c;
  }

 private:
  fs::path file_;
  SceneState loaded_;
  PlanningProblem problem_;
};

TEST(ShippedScenes, AreThePaperBenchmarkItsFourHarderTasksAndOtherRobots) {
  EXPECT_EQ(scene_names(),
            (std::vector<std::string>{"can_in_box", "can_on_table", "cans_in_shelf", "cans_on_desk",
                                      "cluttered_table", "iiwa_and_allegro", "panda_and_leap",
                                      "t_shape", "two_cans_on_table", "ur5e_and_shadow"}));
}

TEST_P(ShippedScene, LoadsWithoutWarningsAndSaysWhatItIs) {
  EXPECT_TRUE(scene().warnings.empty()) << scene().warnings.front();
  EXPECT_FALSE(scene().name.empty());
  EXPECT_FALSE(scene().description.empty());
  EXPECT_EQ(scene().planner.name, "") << "the default planner suits them all";
}

TEST_P(ShippedScene, HasAPictureOnTheStartPage) {
  const std::string picture = "thumbnails/" + GetParam() + ".jpg";
  EXPECT_TRUE(fs::is_regular_file(test::source_dir() / "resources" / picture));
  std::ifstream list(test::source_dir() / "resources/workbench.qrc");
  const std::string listed{std::istreambuf_iterator<char>(list), {}};
  EXPECT_NE(listed.find("<file>" + picture + "</file>"), std::string::npos);
}

TEST_P(ShippedScene, StartsAndEndsWithinTheLimitsAndClear) {
  const auto checker = problem().checker->clone();
  for (const Configuration& q : {problem().start, problem().goal}) {
    EXPECT_TRUE((q.array() >= problem().model().lower().array()).all());
    EXPECT_TRUE((q.array() <= problem().model().upper().array()).all());
    const geometric::NamedPair closest = find_clearance(*checker, q);
    EXPECT_GE(closest.distance, kLeastClearance) << closest.a << " and " << closest.b;
  }
}

TEST_P(ShippedScene, ShowsTheRobotAtTheStart) {
  EXPECT_EQ(scene().robots.front().configuration, problem().start);
}

TEST_P(ShippedScene, NeedsMoreThanAStraightMotion) {
  const auto checker = problem().checker->clone();
  geometric::ContinuousCollisionChecker edge(*checker, problem().motion, kResolution);
  EXPECT_FALSE(edge.check(problem().start, problem().goal).free);
}

TEST_P(ShippedScene, EndsCloserToTheObjectThanItStarts) {
  const auto checker = problem().checker->clone();
  const auto pairs = checker->world().pairs();
  const auto closest_object = [&](const Configuration& q) {
    checker->place(q);
    double closest = 1.0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!checker->world().is_self_pair(pairs[i])) {
        closest = std::min(closest, checker->pair_distance(static_cast<int>(i), closest));
      }
    }
    return closest;
  };
  const double at_goal = closest_object(problem().goal);
  EXPECT_LT(at_goal, 8e-3);
  EXPECT_GT(closest_object(problem().start), 2.0 * at_goal);
}

TEST_P(ShippedScene, TakesHandPosturesThatThePrincipalDirectionsReach) {
  ASSERT_NE(problem().basis, nullptr);
  EXPECT_EQ(problem().basis->joints.size(), problem().joints.hand.size());
  EXPECT_LT(distance_before_clamping(*problem().basis, posture(problem().start)), kRounding);
  // A goal of the grasp search need not be in the subspace (paper, section 5).
  const double at_goal = distance_before_clamping(*problem().basis, posture(problem().goal));
  EXPECT_EQ(at_goal < kRounding, GetParam() != "cluttered_table") << at_goal;
}

TEST_P(ShippedScene, IsTheSameWhenWrittenAndReadAgain) {
  const test::ScratchFolder folder;
  const fs::path copy = folder.path() / "copy.yaml";
  write_scene(scene(), copy);
  const geometric::Scene again = geometric::read_scene(copy);
  EXPECT_EQ(again.name, scene().name);
  EXPECT_EQ(again.description, scene().description);
  EXPECT_EQ(again.start, scene().start);
  EXPECT_EQ(again.goal, scene().goal);
  EXPECT_EQ(again.hand_basis, scene().hand_basis);
  EXPECT_EQ(again.planner.name, scene().planner.name);
  ASSERT_EQ(again.robots.size(), scene().robots.size());
  EXPECT_EQ(again.robots.front().configuration, scene().robots.front().configuration);
  EXPECT_TRUE(again.robots.front().X_WB.isApprox(scene().robots.front().X_WB, 1e-12));
  ASSERT_EQ(again.objects.size(), scene().objects.size());
  for (std::size_t i = 0; i < again.objects.size(); ++i) {
    EXPECT_EQ(again.objects[i].name, scene().objects[i].name);
    EXPECT_TRUE(again.objects[i].X_PO.isApprox(scene().objects[i].X_PO, 1e-12));
  }
}

TEST_P(ShippedScene, IsSolvedByThePaperPlanner) {
  const std::unique_ptr<Planner> planner = PlannerRegistry().create("pmd-prm");
  planner->set_parameter("max_samples", "20000");
  const PlanResult result = planner->plan(problem(), PlanRequest());
  ASSERT_TRUE(result.solved()) << result.reason;
  const PathCheckResult check = check_path(problem(), result.path, 5e-3);
  EXPECT_TRUE(check.valid());
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace handway::planning
