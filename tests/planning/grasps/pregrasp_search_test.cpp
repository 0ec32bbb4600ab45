#include "handway/planning/grasps/pregrasp_search.h"

#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway_test/input_errors.h"
#include "handway_test/known_problems.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

class PregraspSearch : public ::testing::Test {
 protected:
  static PlanningProblem shipped(const std::string& name) {
    for (const test::KnownProblem& known : test::known_problems()) {
      if (known.name == name) {
        const SceneState scene = test::load(known);
        return make_problem(scene.scene, scene.basis);
      }
    }
    throw std::runtime_error("no scene " + name);
  }
};

TEST_F(PregraspSearch, FindsWaysAroundACanThatAreFree) {
  const PlanningProblem problem = shipped("can_on_table");
  const std::vector<Pregrasp> grasps = find_pregrasps(problem, "can").found;
  ASSERT_GE(grasps.size(), 3U);
  const auto checker = problem.checker->clone();
  double last = 1.0;
  for (const Pregrasp& grasp : grasps) {
    EXPECT_FALSE(checker->first_collision(grasp.q));
    EXPECT_TRUE((grasp.q.array() >= problem.model().lower().array()).all());
    EXPECT_TRUE((grasp.q.array() <= problem.model().upper().array()).all());
    EXPECT_GE(grasp.fingers, 2);
    EXPECT_GT(grasp.clearance, 0.0);
    EXPECT_LE(grasp.score, last) << "the best first";
    last = grasp.score;
    double nearest = 1.0;
    for (const int pair : checker->world().pairs_with("can")) {
      nearest = std::min(nearest, checker->pair_distance(pair, 1.0));
    }
    EXPECT_GE(nearest, PregraspOptions{}.gap - 1e-9);
    checker->place(grasp.q);
    for (int pair = 0; pair < static_cast<int>(checker->world().pairs().size()); ++pair) {
      const auto& [a, b] = checker->world().pairs()[static_cast<std::size_t>(pair)];
      const auto is_of_hand = [&](int body) {
        const std::string& name = checker->world().body(body).name;
        return checker->world().body(body).moves() && name.rfind("link_", 0) != 0 &&
               name != "base_link";
      };
      if (is_of_hand(a) && is_of_hand(b)) {
        EXPECT_GE(checker->pair_distance(pair, 0.001), 0.0003) << "between the hand's own links";
      }
    }
    EXPECT_LT(nearest, 0.015) << "closed until near contact";
  }
}

TEST_F(PregraspSearch, SqueezesInProportionToAHeavyPayload) {
  const PlanningProblem problem = shipped("can_on_table");
  const auto squeeze = [&](double payload) {
    const Pregrasps grasps =
        find_pregrasps(problem, "can", {.samples = 1024, .most = 1, .payload = payload});
    return Eigen::VectorXd(grasps.found.front().squeezed - grasps.found.front().closed);
  };
  const Eigen::VectorXd light = squeeze(0.001);
  EXPECT_GT(light.norm(), 0.0) << "even a light object is squeezed";
  const Eigen::VectorXd heavy = squeeze(0.4);
  EXPECT_GT(heavy.norm(), 1.5 * light.norm());
  EXPECT_NEAR(squeeze(0.6).norm(), 1.5 * heavy.norm(), 0.05 * heavy.norm());
}

TEST_F(PregraspSearch, ClosesTheHandUpToContact) {
  const PlanningProblem problem = shipped("can_on_table");
  const Pregrasps grasps = find_pregrasps(problem, "can");
  ASSERT_FALSE(grasps.found.empty());
  const auto checker = problem.checker->clone();
  const geometric::Aabb box = geometric::bounding_box(
      *geometric::tessellate(geometric::find_object(*problem.scene, "can")->shape));
  for (const Pregrasp& grasp : grasps.found) {
    EXPECT_FALSE(checker->first_collision(grasp.closed)) << "contacts are not in each other";
    EXPECT_EQ(grasp.closed(problem.joints.arm), grasp.q(problem.joints.arm));
    EXPECT_TRUE((grasp.squeezed.array() >= problem.model().lower().array()).all());
    EXPECT_TRUE((grasp.squeezed.array() <= problem.model().upper().array()).all());
    EXPECT_NE(grasp.squeezed, grasp.closed);
    std::set<int> fingers;
    for (const HandContact& contact : grasp.contacts) {
      fingers.insert(contact.finger);
      EXPECT_LE(contact.distance, 0.001);
      const Eigen::Vector3d& p_O = contact.contact.p_O;
      EXPECT_NEAR(contact.contact.normal_O.norm(), 1.0, 1e-9);
      EXPECT_GT(contact.contact.normal_O.dot(box.centre() - p_O), 0.0) << "into the can";
      EXPECT_TRUE(((p_O - box.lower).array() > -1e-6).all());
      EXPECT_TRUE(((box.upper - p_O).array() > -1e-6).all());
    }
    EXPECT_GE(fingers.size(), 2U);
  }
}

TEST_F(PregraspSearch, RanksGraspsThatResistEverythingByHowMuch) {
  const std::vector<Pregrasp> grasps = find_pregrasps(shipped("panda_and_leap"), "mug").found;
  ASSERT_GE(grasps.size(), 5U);
  for (const Pregrasp& grasp : grasps) {
    EXPECT_GT(grasp.quality.epsilon, 0.0);
    EXPECT_GT(grasp.quality.volume, 0.0);
    EXPECT_TRUE(grasp.holding_force) << "what resists everything carries the payload";
    EXPECT_EQ(grasp.doubt, "");
  }
  EXPECT_GT(grasps.front().quality.epsilon, 0.1);
}

TEST_F(PregraspSearch, SaysWhyAGraspIsInDoubt) {
  PregraspOptions slippery;
  slippery.contact.friction = 0.02;
  slippery.samples = 512;  // none of them is made better yet
  const std::vector<Pregrasp> grasps =
      find_pregrasps(shipped("can_on_table"), "can", slippery).found;
  ASSERT_FALSE(grasps.empty()) << "nothing better exists";
  for (const Pregrasp& grasp : grasps) {
    EXPECT_LE(grasp.quality.epsilon, 0.0);
    EXPECT_THAT(grasp.doubt, ::testing::Not(::testing::IsEmpty()));
  }
}

TEST_F(PregraspSearch, GraspsWithHandsThatHaveNoBasis) {
  for (const auto& [scene, object] :
       {std::pair("can_on_table", "can"), std::pair("iiwa_and_allegro", "can"),
        std::pair("panda_and_leap", "mug")}) {
    const PlanningProblem problem = make_problem(shipped(scene).scene, nullptr);
    const std::vector<Pregrasp> grasps = find_pregrasps(problem, object).found;
    ASSERT_FALSE(grasps.empty()) << scene;
    const auto checker = problem.checker->clone();
    for (const Pregrasp& grasp : grasps) {
      EXPECT_FALSE(checker->first_collision(grasp.q)) << scene;
      EXPECT_GE(grasp.fingers, 2) << scene;
      EXPECT_EQ(grasp.subspace_distance, 0.0) << scene;
    }
  }
}

// Writes a gripper with two jaws that one joint moves.
void write_gripper(const std::filesystem::path& file) {
  std::ofstream(file) << R"(<robot name="gripper">
    <link name="hand"><collision><origin xyz="0 0 0.033"/>
      <geometry><box size="0.06 0.2 0.066"/></geometry></collision></link>
    <link name="left"><collision><origin xyz="0 0.0076 0.027"/>
      <geometry><box size="0.02 0.0152 0.054"/></geometry></collision></link>
    <link name="right"><collision><origin xyz="0 -0.0076 0.027"/>
      <geometry><box size="0.02 0.0152 0.054"/></geometry></collision></link>
    <joint name="open" type="prismatic"><origin xyz="0 0 0.067"/><axis xyz="0 1 0"/>
      <parent link="hand"/><child link="left"/>
      <limit lower="0.001" upper="0.04" effort="1" velocity="0.2"/></joint>
    <joint name="follow" type="prismatic"><origin xyz="0 0 0.067"/><axis xyz="0 -1 0"/>
      <parent link="hand"/><child link="right"/><mimic joint="open"/>
      <limit lower="0.001" upper="0.04" effort="1" velocity="0.2"/></joint></robot>)";
}

TEST_F(PregraspSearch, GraspsBetweenTwoJawsThatOneJointMoves) {
  const test::ScratchFolder folder;
  write_gripper(folder.path() / "gripper.urdf");
  const std::filesystem::path file = folder.path() / "scene.yaml";
  std::ofstream(file) << R"(handway: 1
robots:
  - {name: arm, model: iiwa14_class}
  - {name: hand, model: gripper.urdf, mount: {robot: arm}}
objects:
  - {name: table, box: {size: [0.5, 0.5, 0.02]}, pose: {xyz: [0.5, 0, 0.19]}}
  - {name: can, cylinder: {radius: 0.033, length: 0.12}, pose: {xyz: [0.5, 0, 0.261]}}
start: {}
goal: {}
)";
  const SceneState loaded = load_scene(file, PluginManager());
  const std::vector<Pregrasp> grasps =
      find_pregrasps(make_problem(loaded.scene, nullptr), "can").found;
  ASSERT_GE(grasps.size(), 3U);
  EXPECT_EQ(grasps.front().fingers, 2);
  EXPECT_GT(grasps.front().enclosure, 0.8);
  EXPECT_GT(grasps.front().quality.epsilon, 0.0) << "both jaws touch, with soft fingers";
  geometric::Scene scene = *loaded.scene;
  scene.objects.back().shape = geometric::Cylinder{0.05, 0.12};
  const Pregrasps none = find_pregrasps(
      make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), nullptr), "can");
  EXPECT_TRUE(none.found.empty());
  EXPECT_THAT(none.why_none,
              ::testing::StartsWith("can is too wide for the hand: it is 100 mm across"));
}

TEST_F(PregraspSearch, GraspsWithTheHandThatIsNearest) {
  const test::ScratchFolder folder;
  write_gripper(folder.path() / "gripper.urdf");
  const std::filesystem::path file = folder.path() / "scene.yaml";
  std::ofstream(file) << R"(handway: 1
robots:
  - {name: left, model: iiwa14_class}
  - {name: left_hand, model: gripper.urdf, mount: {robot: left}}
  - {name: right, model: iiwa14_class, mount: {robot: left, link: base_link, pose: {xyz: [0, -1, 0]}}}
  - {name: right_hand, model: gripper.urdf, mount: {robot: right}}
objects:
  - {name: can, cylinder: {radius: 0.033, length: 0.12}, pose: {xyz: [0.5, -1, 0.261]}}
start: {}
goal: {joint_1: 0.5}
)";
  const PlanningProblem problem = make_problem(load_scene(file, PluginManager()).scene, nullptr);
  const std::vector<Pregrasp> grasps = find_pregrasps(problem, "can").found;
  ASSERT_FALSE(grasps.empty());
  for (int v = 0; v < problem.model().variable_count(); ++v) {
    if (!problem.model().variable(v).name.starts_with("right")) {
      EXPECT_EQ(grasps.front().q[v], problem.start[v]) << problem.model().variable(v).name;
    }
  }
}

TEST_F(PregraspSearch, KeepsConstraintsOfTheHandAndOfTheArm) {
  const PlanningProblem plain = shipped("can_on_table");
  geometric::Scene scene = *plain.scene;
  geometric::PositionConstraint side;  // of the can
  side.size = Eigen::Vector3d(4.0, 2.0, 4.0);
  side.X_WR.translation().y() = -0.85;
  geometric::OrientationConstraint elbow;
  elbow.angle = 1.2;
  scene.constraints = {{"side", "palm", side}, {"elbow", "forearm_link", elbow}};
  const PlanningProblem problem =
      make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), plain.basis);
  const auto checker = problem.checker->clone();
  const std::vector<Pregrasp> kept = find_pregrasps(problem, "can").found;
  EXPECT_FALSE(kept.empty());
  for (const Pregrasp& grasp : kept) {
    EXPECT_FALSE(checker->first_collision(grasp.q));
  }
  const std::vector<Pregrasp> free = find_pregrasps(plain, "can").found;
  EXPECT_TRUE(std::ranges::any_of(free, [&](const Pregrasp& grasp) {
    return checker->first_collision(grasp.q).has_value();
  })) << "the constraints rule some out";
}

TEST_F(PregraspSearch, PutsThumbAndFingersAroundWhatItGrasps) {
  struct Case {
    const char* scene;
    const char* object;
  };
  for (const auto& [scene, object] :
       {Case{"can_on_table", "can"}, Case{"can_in_box", "can"}, Case{"cans_in_shelf", "can"},
        Case{"cans_on_desk", "can_left_above"}}) {
    const std::vector<Pregrasp> grasps = find_pregrasps(shipped(scene), object).found;
    ASSERT_FALSE(grasps.empty()) << scene;
    EXPECT_GE(grasps.front().fingers, 3) << scene;
    EXPECT_GT(grasps.front().enclosure, 0.8) << scene;
    EXPECT_GT(grasps.front().quality.epsilon, 0.07) << scene;
    EXPECT_EQ(grasps.front().doubt, "") << scene;
  }
}

// The box around a T is twice as wide as what the fingers close around.
TEST_F(PregraspSearch, HoldsALeverByItsStemOrItsBar) {
  const std::vector<Pregrasp> grasps = find_pregrasps(shipped("t_shape"), "t_shape").found;
  ASSERT_FALSE(grasps.empty());
  EXPECT_EQ(grasps.front().doubt, "");
  EXPECT_GT(grasps.front().quality.epsilon, 0.02);
}

TEST_F(PregraspSearch, TakesABroadPlateByItsRim) {
  const PlanningProblem plain = shipped("can_on_table");
  geometric::Scene scene = *plain.scene;
  geometric::SceneObject& can =
      *std::ranges::find(scene.objects, "can", &geometric::SceneObject::name);
  can.shape = geometric::Cylinder{0.12, 0.015};
  can.X_PO.translation().z() += 0.15;
  const PlanningProblem problem =
      make_problem(std::make_shared<const geometric::Scene>(scene), plain.basis);
  const std::vector<Pregrasp> grasps = find_pregrasps(problem, "can").found;
  ASSERT_FALSE(grasps.empty());
  const auto checker = problem.checker->clone();
  for (const Pregrasp& grasp : grasps) {
    EXPECT_FALSE(checker->first_collision(grasp.q));
    EXPECT_GT(grasp.enclosure, 0.5) << "thumb and fingers on both of its faces";
  }
}

TEST_F(PregraspSearch, GivesTheSameForTheSameSeed) {
  const PlanningProblem problem = shipped("can_on_table");
  PregraspOptions options;
  options.samples = 1500;
  const auto one = find_pregrasps(problem, "can", options).found;
  const auto other = find_pregrasps(problem, "can", options).found;
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].q, other[i].q);
  }
}

TEST_F(PregraspSearch, GivesTheSameForAnyNumberOfThreads) {
  const PlanningProblem problem = shipped("can_on_table");
  PregraspOptions options;
  options.samples = 600;
  options.threads = 1;
  const auto one = find_pregrasps(problem, "can", options).found;
  options.threads = 3;
  const auto three = find_pregrasps(problem, "can", options).found;
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].q, three[i].q);
    EXPECT_EQ(one[i].score, three[i].score);
    EXPECT_EQ(one[i].closed, three[i].closed);
    EXPECT_EQ(one[i].squeezed, three[i].squeezed);
    EXPECT_EQ(one[i].quality.epsilon, three[i].quality.epsilon);
  }
}

TEST_F(PregraspSearch, TellsItsFirstGraspsLongBeforeItsEnd) {
  double last = 0.0;
  double first = 1.0;
  std::size_t most = 0;
  const Pregrasps grasps = find_pregrasps(
      shipped("can_on_table"), "can", {}, {}, [&](const auto& found, double fraction) {
        EXPECT_GE(fraction, last) << "it never falls";
        last = fraction;
        first = found.empty() ? first : std::min(first, fraction);
        most = found.size();
      });
  EXPECT_EQ(last, 1.0);
  EXPECT_LT(first, 0.1);
  EXPECT_EQ(most, grasps.found.size());
}

TEST_F(PregraspSearch, KeepsWhatItHasFoundWhenItIsStopped) {
  std::stop_source stop;
  int reports = 0;
  const Pregrasps grasps = find_pregrasps(shipped("can_on_table"), "can", {}, stop.get_token(),
                                          [&](const auto& found, double /*fraction*/) {
                                            ++reports;
                                            if (!found.empty()) {
                                              stop.request_stop();
                                            }
                                          });
  EXPECT_FALSE(grasps.found.empty());
  EXPECT_EQ(grasps.why_none, "");
  EXPECT_LT(reports, 30) << "of some 250";
}

TEST_F(PregraspSearch, RanksJawsOnAChordOfWhatIsRoundLow) {
  const test::ScratchFolder folder;
  write_gripper(folder.path() / "gripper.urdf");
  const std::filesystem::path file = folder.path() / "scene.yaml";
  std::ofstream(file) << R"(handway: 1
robots:
  - {name: arm, model: iiwa14_class}
  - {name: hand, model: gripper.urdf, mount: {robot: arm}}
objects:
  - {name: can, cylinder: {radius: 0.036, length: 0.12}, pose: {xyz: [0.5, 0, 0.3]}}
start: {}
goal: {}
)";
  const PlanningProblem problem = make_problem(load_scene(file, PluginManager()).scene, nullptr);
  const std::vector<Pregrasp> grasps = find_pregrasps(problem, "can").found;
  ASSERT_FALSE(grasps.empty());
  for (const Pregrasp& grasp : grasps) {
    EXPECT_TRUE(grasp.enclosure > 0.8 || grasp.score < 0.7)
        << grasp.enclosure << " scores " << grasp.score;
  }
}

TEST_F(PregraspSearch, SaysWhyThereIsNoGrasp) {
  const auto why_none = [](const PlanningProblem& plain, const auto& change) {
    geometric::Scene scene = *plain.scene;
    change(scene, *std::ranges::find(scene.objects, "can", &geometric::SceneObject::name));
    const Pregrasps grasps = find_pregrasps(
        make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), plain.basis),
        "can");
    EXPECT_TRUE(grasps.found.empty());
    return grasps.why_none;
  };
  const PlanningProblem plain = shipped("can_on_table");
  EXPECT_EQ(find_pregrasps(plain, "can").why_none, "");
  EXPECT_EQ(find_pregrasps(plain, "table").why_none,
            "table is too large to be grasped: two of its sides are longer than 160 mm. Choose "
            "something smaller.");
  EXPECT_THAT(
      why_none(plain, [](const geometric::Scene& /*scene*/,
                         geometric::SceneObject& can) { can.X_PO.translation().x() += 3.0; }),
      ::testing::StartsWith("can is out of the arm's reach"));
  const auto cover = [](geometric::Scene& scene, const geometric::SceneObject& can) {
    const Eigen::Isometry3d X_PC = can.X_PO;  // the can moves where objects are added
    for (int side = 0; side < 4; ++side) {
      geometric::SceneObject wall;
      wall.name = "side_" + std::to_string(side);
      wall.shape = geometric::Box{{0.01, 0.16, 0.3}};
      wall.X_PO = X_PC * Eigen::AngleAxisd(0.5 * EIGEN_PI * side, Eigen::Vector3d::UnitZ()) *
                  Eigen::Translation3d(0.075, 0.0, 0.08);
      scene.objects.push_back(wall);
    }
  };
  EXPECT_THAT(why_none(plain, cover), ::testing::HasSubstr("in the way"));
}

TEST_F(PregraspSearch, EndsWhenItIsTold) {
  std::stop_source stop;
  stop.request_stop();
  const Pregrasps grasps = find_pregrasps(shipped("can_on_table"), "can", {}, stop.get_token());
  EXPECT_TRUE(grasps.found.empty());
  EXPECT_EQ(grasps.why_none, "");
}

TEST_F(PregraspSearch, RefusesWhatIsNotThere) {
  const PlanningProblem problem = shipped("can_on_table");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(find_pregrasps(problem, "cup")); }),
              ::testing::HasSubstr("cup"));
}

}  // namespace
}  // namespace handway::planning
