#include "open_problems.h"

#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/geometric/setup/mounting.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/planning/tasks/resting_places.h"
#include "scene_families.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

using Eigen::Vector3d;
using geometric::Configuration;
using geometric::Pose;
using planning::PlanningProblem;
using planning::SceneState;
using sampling::RandomStream;

constexpr int kMostDraws = 48;          // scenes for a problem
constexpr int kSameRobot = 12;          // draws until another arm and hand are chosen
constexpr int kBlockedDraws = 24;       // draws until a free straight motion is accepted
constexpr int kMostStarts = 24;         // postures for each scene
constexpr int kMostReaches = 60;        // palm poses for each scene
constexpr int kMostPlaces = 40;         // places of the object for each grasp
constexpr int kGraspSamples = 600;      // of find_pregrasps()
constexpr int kStraightSteps = 64;      // configurations on the straight motion
constexpr double kEndClearance = 1e-4;  // m, of starts and goals

/// An arm with a posture in front of the table, and its reach over the table.
struct ArmChoice {
  const char* model;
  double height;               ///< Height of its base, m.
  double yaw;                  ///< Yaw of its base, rad.
  std::array<double, 7> home;  ///< rad, of as many joints as it has.
  double nearest;              ///< Distance of targets from the base, m.
  double farthest;
};

constexpr std::array<ArmChoice, 4> kArms = {{
    {"iiwa14_class", 0.4, 0.0, {1.0472, 0.1745, 0.0, -1.5708, 1.0472, -1.0472, 0.6981}, 0.56, 0.72},
    {"panda_class", 0.4, 0.0, {0.7854, -0.5236, 0.0, -2.0944, -1.2217, 1.9199, 0.5236}, 0.52, 0.66},
    {"tx90", 0.4, 0.0, {0.5543, 0.216, 2.3278, 1.1136, -1.0914, 0.7719, 0.0}, 0.62, 0.8},
    {"ur5e_class",
     0.7,
     std::numbers::pi,
     {-0.8003, -1.0289, 1.93, -1.8792, 1.2811, -0.0757, 0.0},
     0.56,
     0.72},
}};

/// A hand with its basis.
struct HandChoice {
  const char* model;
  const char* basis;
};

constexpr std::array<HandChoice, 4> kHands = {{{"allegro_class_right", "allegro_free_hand"},
                                               {"leap_class_right", "leap_free_hand"},
                                               {"sah_right", "sah_free_hand"},
                                               {"shadow_class_right", "shadow_free_hand"}}};

constexpr std::array kTasks = {"reach", "grasp", "place"};
constexpr std::size_t kLevels = 3;

double between(RandomStream& random, double lower, double upper) {
  return lower + (upper - lower) * random.uniform();
}

/// Returns element `number` (from 0) of a sequence of shuffled blocks, each of which has all of
/// {0, …, size - 1}: so that they come equally often.
std::size_t shuffled(const RandomStream& random, std::uint64_t number, std::size_t size) {
  RandomStream block = random.fork(number / size);
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = size - 1; i > 0; --i) {
    std::swap(order[i], order[block.below(i + 1)]);
  }
  return order[number % size];
}

/// Robot, task and scene of a problem.
struct Choice {
  std::size_t arm;
  std::size_t hand;
  std::size_t family;
  std::size_t task;
  int level;

  [[nodiscard]] planning::ProblemTags tags() const {
    return {{"task", kTasks.at(task)},
            {"family", scene_families()[family].name},
            {"level", fmt::format("{}", level)},
            {"arm", kArms.at(arm).model},
            {"hand", kHands.at(hand).model}};
  }
};

Choice choice_of(const RandomStream& random, std::uint64_t number) {
  enum : std::uint64_t { kArm, kHand, kFamily, kTask, kLevel };
  return {shuffled(random.fork(kArm), number, kArms.size()),
          shuffled(random.fork(kHand), number, kHands.size()),
          shuffled(random.fork(kFamily), number, scene_families().size()),
          shuffled(random.fork(kTask), number, kTasks.size()),
          1 + static_cast<int>(shuffled(random.fork(kLevel), number, kLevels))};
}

// Rounded to 1e-5 rad, within the limits.
Configuration rounded(const geometric::RobotModel& model, const Configuration& q) {
  return model.clamped(q.unaryExpr([](double value) { return std::round(value * 1e5) / 1e5; }));
}

/// Makes the problems of one scene, and asks whether their ends are free.
class ProblemSearch {
 public:
  /// @param state with the robot at its home posture. @param target name of the object.
  ProblemSearch(SceneState state, std::string target, std::vector<std::string> supports,
                RandomStream random)
      : state_(std::move(state)),
        target_(std::move(target)),
        supports_(std::move(supports)),
        random_(random),
        problem_(
            planning::make_problem(state_.scene, state_.basis, {}, planning::GoalNeed::kOptional)),
        checker_(problem_.checker->clone()) {}

  [[nodiscard]] SceneState find(const std::string& task) {
    if (task == "place") {
      return find_place();
    }
    const std::optional<Configuration> start = free_start();
    if (!start) {
      return {};
    }
    const auto goal = task == "reach" ? reaching(*start) : grasping();
    return goal ? with_ends(state_, *start, *goal) : SceneState{};
  }

 private:
  static SceneState with_ends(const SceneState& state, const Configuration& start,
                              const Configuration& goal) {
    auto scene = std::make_shared<geometric::Scene>(*state.scene);
    scene->robots.front().configuration = start;
    scene->start = start;
    scene->goal = goal;
    return {std::move(scene), state.basis};
  }

  static bool is_free(geometric::CollisionChecker& checker, const Configuration& q) {
    return limit_violations(checker.world().model(), q).empty() && !checker.first_collision(q) &&
           !is_closer_than(checker, q, kEndClearance);
  }

  // A posture near home; farther away, the more of them were in collision.
  std::optional<Configuration> free_start() {
    const geometric::RobotModel& model = problem_.model();
    const Configuration& home = problem_.start;
    for (int i = 0; i < kMostStarts; ++i) {
      const double spread = 0.1 + 0.3 * i / kMostStarts;  // rad
      Configuration q = home;
      for (const int v : problem_.joints.arm) {
        q[v] += between(random_, -spread, spread);
      }
      q = rounded(model, q);
      if (is_free(*checker_, q)) {
        return q;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] planning::PalmIk palm_ik(const PlanningProblem& problem, int palm) const {
    return {problem.scene->robots.front().model, palm, problem.joints.arm};
  }

  [[nodiscard]] Vector3d target_middle() const {
    const geometric::SceneObject& target = *state_.find(target_);
    return target.X_PO * bounding_box(*tessellate(target.shape)).centre();
  }

  // The palm faces the middle of the object, from above or from the side of the robot.
  std::optional<Configuration> reaching(const Configuration& start) {
    const planning::PalmIk ik = palm_ik(problem_, problem_.hand.palm);
    const Pose X_BW = state_.scene->robots.front().X_WB.inverse();
    const Vector3d middle = target_middle();
    const double outwards = std::atan2(middle.y(), middle.x());
    for (int i = 0; i < kMostReaches; ++i) {
      // From the target to the palm.
      const double azimuth = outwards + std::numbers::pi + between(random_, -1.4, 1.4);
      const double elevation = between(random_, 0.1, 1.5);
      const Vector3d towards(std::cos(elevation) * std::cos(azimuth),
                             std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      Pose X_WP = Pose::Identity();
      X_WP.linear() = facing(-towards, between(random_, -std::numbers::pi, std::numbers::pi));
      const double fingers = 0.08;  // m, from the palm's origin towards the fingertips
      X_WP.translation() =
          middle + between(random_, 0.09, 0.16) * towards - fingers * X_WP.linear().col(2);
      for (const Configuration& q : ik.all(start, X_BW * X_WP)) {
        if (const Configuration goal = rounded(problem_.model(), q); is_free(*checker_, goal)) {
          return goal;
        }
      }
    }
    return std::nullopt;
  }

  // Axes of a palm with x along `direction`, turned about it.
  static Eigen::Matrix3d facing(const Vector3d& direction, double turn) {
    const Vector3d side =
        direction.cross(std::abs(direction.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX())
            .normalized();
    Eigen::Matrix3d R;
    R.col(0) = direction;
    R.col(1) = Eigen::AngleAxisd(turn, direction) * side;
    R.col(2) = R.col(0).cross(R.col(1));
    return R;
  }

  [[nodiscard]] planning::Pregrasps pregrasps(int most) {
    planning::PregraspOptions options;
    options.samples = kGraspSamples;
    options.most = most;
    options.seed = random_.bits();
    options.threads = 1;
    return find_pregrasps(problem_, target_, options);
  }

  std::optional<Configuration> grasping() {
    for (const planning::Pregrasp& grasp : pregrasps(2).found) {
      if (const Configuration goal = rounded(problem_.model(), grasp.q); is_free(*checker_, goal)) {
        return goal;
      }
    }
    return std::nullopt;
  }

  // The hand holds the object at one place, and puts it to another one.
  SceneState find_place() {
    const planning::Pregrasps grasps = pregrasps(3);
    for (const planning::Pregrasp& grasp : grasps.found) {
      const SceneState carrying = held(grasps.palm, rounded(problem_.model(), grasp.closed));
      const PlanningProblem problem =
          planning::make_problem(carrying.scene, carrying.basis, {}, planning::GoalNeed::kOptional);
      const auto checker = problem.checker->clone();
      if (!is_free(*checker, problem.start)) {
        continue;
      }
      if (const auto goal = placing(problem, *checker, grasps.palm)) {
        return with_ends(carrying, problem.start, *goal);
      }
    }
    return {};
  }

  [[nodiscard]] SceneState held(int palm, const Configuration& q) const {
    const geometric::RobotInstance& robot = state_.scene->robots.front();
    std::vector<std::string> touching = {robot.model->link(palm).name};
    for (const geometric::HandFinger& finger : problem_.hand.fingers) {
      for (const int link : finger.links) {
        touching.push_back(robot.model->link(link).name);
      }
    }
    SceneState state =
        attached(state_, q, {target_}, {robot.name, robot.model->link(palm).name}, touching);
    auto scene = std::make_shared<geometric::Scene>(*state.scene);
    scene->robots.front().configuration = q;
    scene->start = q;
    return {std::move(scene), state.basis};
  }

  std::optional<Configuration> placing(const PlanningProblem& problem,
                                       geometric::CollisionChecker& checker, int palm) {
    constexpr double kShortest = 0.12;  // m
    const geometric::SceneObject& target = *state_.find(target_);
    const planning::PalmIk ik = palm_ik(problem, palm);
    const Pose X_BP = ik.pose(problem.start);
    const Pose& X_WB = problem.scene->robots.front().X_WB;
    const std::string& support = supports_[random_.below(supports_.size())];
    for (const Pose& X_WO :
         planning::resting_places(*state_.scene, target, support, kMostPlaces, random_.bits())) {
      const Vector3d shift = X_WO.translation() - target.X_PO.translation();
      if (shift.norm() < kShortest) {
        continue;
      }
      // Raised as the attached object was.
      const Pose raised = Eigen::Translation3d(0.0, 0.0, geometric::kRestingGap) * X_WO;
      const Pose moved = X_WB.inverse() * raised * target.X_PO.inverse() * X_WB;
      for (const Configuration& q : ik.all(problem.start, moved * X_BP, 1)) {
        if (const Configuration goal = rounded(problem.model(), q); is_free(checker, goal)) {
          return goal;
        }
      }
    }
    return std::nullopt;
  }

  SceneState state_;
  std::string target_;
  std::vector<std::string> supports_;
  RandomStream random_;
  PlanningProblem problem_;
  std::unique_ptr<geometric::CollisionChecker> checker_;  ///< Checker of `problem_`.
};

// Returns whether no configuration of a sequence on the straight motion collides.
bool straight_is_free(const SceneState& state) {
  const PlanningProblem problem = planning::make_problem(state.scene, state.basis);
  const auto checker = problem.checker->clone();
  for (int i = 1; i < kStraightSteps; ++i) {
    const double share = static_cast<double>(i) / kStraightSteps;
    if (checker->first_collision(problem.start + share * (problem.goal - problem.start))) {
      return false;
    }
  }
  return true;
}

// Returns a place of the target on the table, with x away from the robot.
Pose place_of_target(const ArmChoice& arm, RandomStream& random) {
  const double azimuth = between(random, -0.6, 0.6);
  const double distance = between(random, arm.nearest, arm.farthest);
  const double turn = azimuth + between(random, -0.2, 0.2);
  return Pose(Eigen::Translation3d(distance * std::cos(azimuth), distance * std::sin(azimuth),
                                   kTableHeight) *
              Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
}

// Draws a scene, and start and goal in it; no scene if none are free.
// @param robot scene of the robot alone.
SceneState find_problem(const Choice& choice, const SceneState& robot, RandomStream& random) {
  const Pose X_WF = place_of_target(kArms.at(choice.arm), random);
  Surroundings around = draw_surroundings(choice.family, choice.level, X_WF, random);
  auto scene = std::make_shared<geometric::Scene>(*robot.scene);
  std::ranges::move(around.objects, std::back_inserter(scene->objects));
  const char* task = kTasks.at(choice.task);
  scene->description = fmt::format("The task is to {} the object \"target\": {}.", task,
                                   scene_families()[choice.family].description);
  return ProblemSearch({std::move(scene), robot.basis}, around.target, around.supports,
                       random.fork(0))
      .find(task);
}

}  // namespace

/// Every hand on every arm, at home.
class OpenProblemGenerator::Robots {
 public:
  Robots() {
    for (const ArmChoice& arm : kArms) {
      for (const HandChoice& hand : kHands) {
        robots_.push_back(mounted(arm, hand));
      }
    }
  }

  /// Returns a scene of the robot alone, with the basis of its hand.
  [[nodiscard]] const SceneState& of(const Choice& choice) const {
    return robots_[choice.arm * kHands.size() + choice.hand];
  }

 private:
  static std::shared_ptr<const geometric::RobotModel> model(const char* name) {
    return geometric::load_robot(
        geometric::find_resource(geometric::ResourceKind::kRobot, name, geometric::resource_dir()));
  }

  static SceneState mounted(const ArmChoice& arm, const HandChoice& hand) {
    geometric::RobotInstance robot;
    robot.name = "arm";
    robot.file = arm.model;
    robot.parts = {{"arm", arm.model, model(arm.model), -1, ""},
                   {"hand", hand.model, model(hand.model), 0, "flange_link"}};
    compose_parts(robot);
    robot.X_WB = Pose(Eigen::Translation3d(0.0, 0.0, arm.height) *
                      Eigen::AngleAxisd(arm.yaw, Vector3d::UnitZ()));
    const auto basis = std::make_shared<const sampling::PmdBasis>(
        sampling::read_pmd_basis(geometric::find_resource(geometric::ResourceKind::kHandBasis,
                                                          hand.basis, geometric::resource_dir())));
    robot.configuration = home(*robot.model, arm, *basis);
    geometric::Scene scene;
    scene.hand_basis = hand.basis;
    scene.robots.push_back(std::move(robot));
    geometric::SceneObject pedestal{"pedestal",
                                    geometric::Box{{0.3, 0.3, arm.height}},
                                    Pose(Eigen::Translation3d(0.0, 0.0, 0.5 * arm.height)),
                                    {0.32F, 0.35F, 0.38F},
                                    {}};
    scene.objects.push_back(std::move(pedestal));
    return {std::make_shared<const geometric::Scene>(std::move(scene)), basis};
  }

  // The hand in the mean posture of its basis.
  static Configuration home(const geometric::RobotModel& model, const ArmChoice& arm,
                            const sampling::PmdBasis& basis) {
    Configuration q = model.neutral();
    for (std::size_t i = 0; i < arm.home.size(); ++i) {
      if (const auto v = model.find_variable(fmt::format("joint_{}", i + 1))) {
        q[*v] = arm.home.at(i);
      }
    }
    for (std::size_t i = 0; i < basis.joints.size(); ++i) {
      if (const auto v = model.find_variable(basis.joints[i])) {
        const double share = basis.mean[static_cast<Eigen::Index>(i)];
        q[*v] = model.lower()[*v] + share * (model.upper()[*v] - model.lower()[*v]);
      }
    }
    return rounded(model, q);
  }

  std::vector<SceneState> robots_;
};

OpenProblemGenerator::OpenProblemGenerator(std::uint64_t seed)
    : seed_(seed), robots_(std::make_unique<const Robots>()) {}

OpenProblemGenerator::~OpenProblemGenerator() = default;

OpenProblem OpenProblemGenerator::make(int number) const {
  enum : std::uint64_t { kChoices, kScenes, kOtherRobots };
  const RandomStream random(seed_);
  const auto index = static_cast<std::uint64_t>(number - 1);
  Choice choice = choice_of(random.fork(kChoices), index);
  RandomStream others = random.fork(kOtherRobots).fork(index);
  OpenProblem problem;
  problem.number = number;
  while (!problem.state.scene && problem.draws < kMostDraws) {
    if (problem.draws > 0 && problem.draws % kSameRobot == 0) {
      choice.arm = others.below(kArms.size());
      choice.hand = others.below(kHands.size());
    }
    RandomStream draw =
        random.fork(kScenes).fork(index).fork(static_cast<std::uint64_t>(problem.draws));
    ++problem.draws;
    SceneState found = find_problem(choice, robots_->of(choice), draw);
    const bool is_to_be_blocked = choice.level > 1 && problem.draws < kBlockedDraws;
    if (found.scene && !(is_to_be_blocked && straight_is_free(found))) {
      problem.state = std::move(found);
    }
  }
  problem.tags = choice.tags();
  return problem;
}

}  // namespace handway::tools
