/// Random edits, plans and motions, looked at by the reference checker (FCL, pair by pair):
///
///     soak_motions [--scene NAME] [--edits N] [--real N] [--virtual N] [--seed N]
///
/// `--edits`: edits of the scene. After each the path that was found last is checked, and if it is
/// not free any more, another is planned; the reference looks at every path that is said to be
/// free, and at the place where one is said not to be. `--real`: motions of the emulated arm and
/// hand, through sockets, in scenes that are edited meanwhile. `--virtual`: the same with simulated
/// devices, on a clock that goes on with each step of the loop that drives them: as fast as the
/// machine allows, and the same on one that is busy. A motion fails if a joint still moves in
/// collision later than kReaction after the edit that is in its way, and as much later as a busy
/// machine let the loop stand still. Exits 1 if any path or motion
/// fails, or a verdict is wrong.
#include "handway/device/core/trajectory_client.h"
#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/execution/motion/motion_run.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/execution/motion/scene_watch.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/math/pose.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/timing/time_path.h"
#include "handway_test/known_problems.h"

#include <CLI/CLI.hpp>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <mutex>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace {

std::int64_t nanoseconds(const timespec& time) {
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

int read_machine_clock(clockid_t clock, timespec* time) {
  using Function = int (*)(clockid_t, timespec*);
  static const auto kRead = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "clock_gettime"));
  return kRead(clock, time);
}

/// The program's steady clock. It goes as the machine's does, or stands until it is advanced.
struct ProgramClock {
  std::atomic<bool> stands = false;
  std::atomic<std::int64_t> offset_ns = 0;  ///< To the machine's, while it goes.
  std::atomic<std::int64_t> shown_ns = 0;   ///< While it stands.

  [[nodiscard]] std::int64_t shown(std::int64_t machine) const {
    return stands ? shown_ns.load() : machine + offset_ns;
  }
  void halt(std::int64_t machine) {
    shown_ns = machine + offset_ns;
    stands = true;
  }
  void go_on(std::int64_t machine) {
    offset_ns = shown_ns - machine;
    stands = false;
  }
};

ProgramClock program_clock;

std::int64_t machine_time() {
  timespec time{};
  read_machine_clock(CLOCK_MONOTONIC, &time);
  return nanoseconds(time);
}

}  // namespace

// Replaces the clock of std::chrono::steady_clock, in this program and in the libraries.
extern "C" [[gnu::visibility("default")]] int clock_gettime(clockid_t clock,
                                                            timespec* time) noexcept {
  const int result = read_machine_clock(clock, time);
  if (clock == CLOCK_MONOTONIC && result == 0) {
    const std::int64_t shown = program_clock.shown(nanoseconds(*time));
    time->tv_sec = shown / 1'000'000'000;
    time->tv_nsec = shown % 1'000'000'000;
  }
  return result;
}

namespace handway::test {
namespace {

using execution::MotionTarget;
using execution::SceneWatch;
using geometric::Configuration;
using geometric::Scene;
using planning::PlanningProblem;
using Problem = std::shared_ptr<const PlanningProblem>;
using Clock = SceneWatch::Clock;

// Time from an edit to rest: the hold, the devices' own stopping, the last sample.
constexpr double kReaction = 0.5;              // s
constexpr double kAtRest = 2e-4;               // rad, from one sample to the next
constexpr std::chrono::milliseconds kStep{1};  // of a device in virtual time

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// A scene that changes at random: obstacles come, move, change and go.
class ChangingScene {
 public:
  ChangingScene(const planning::SceneState& loaded, std::uint64_t seed)
      : basis_(loaded.basis), scene_(*loaded.scene), own_(scene_.objects.size()), random_(seed) {
    Scene all = scene_;
    for (int i = 0; i < kShapes; ++i) {
      shapes_.push_back(new_shape());
      all.objects.push_back(new_object(shapes_.back()));
    }
    prepared_ =
        geometric::make_collision_checker(std::make_shared<const geometric::CollisionWorld>(all));
  }

  /// @returns the name of what came, moved or changed; empty if something went.
  std::string edit() {
    const std::size_t added = scene_.objects.size() - own_;
    switch (added == 0 ? 0 : draw(added >= kMostObstacles ? 1 : 0, 3)) {
      case 0:
        return add();
      case 1:
        return move(any_added().name);
      case 2: {
        geometric::SceneObject& changed = any_added();
        changed.shape = any_shape();
        return changed.name;
      }
      default:
        scene_.objects.erase(scene_.objects.begin() +
                             static_cast<std::ptrdiff_t>(own_ + draw(0, added - 1)));
        return "";
    }
  }

  /// Moves an object to another place. @returns its name.
  std::string move(const std::string& name) {
    geometric::SceneObject& moved =
        *std::ranges::find(scene_.objects, name, &geometric::SceneObject::name);
    moved.X_PO = somewhere();
    return name;
  }

  [[nodiscard]] Problem problem() const {
    return std::make_shared<const PlanningProblem>(
        planning::make_problem(std::make_shared<const Scene>(scene_), basis_));
  }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const std::shared_ptr<const sampling::PmdBasis>& basis() const { return basis_; }

  /// Sets places in the world, shape [3] each, m. Half of the obstacles are put near one of them
  /// from now on.
  void set_busy_places(std::vector<Eigen::Vector3d> places) { busy_places_ = std::move(places); }

  /// Uniform in [lower, upper].
  double draw_real(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }

 private:
  std::size_t draw(std::size_t lower, std::size_t upper) {
    return std::uniform_int_distribution<std::size_t>(lower, upper)(random_);
  }
  geometric::SceneObject& any_added() {
    return scene_.objects[own_ + draw(0, scene_.objects.size() - own_ - 1)];
  }
  geometric::Pose somewhere() {
    Eigen::Vector3d p_WO(draw_real(-0.2, 1.0), draw_real(-0.8, 0.8), draw_real(0.1, 1.4));
    if (!busy_places_.empty() && draw(0, 1) == 0) {
      p_WO = busy_places_[draw(0, busy_places_.size() - 1)];
      for (double& coordinate : p_WO) {
        coordinate += draw_real(-0.3, 0.3);
      }
    }
    return geometric::pose_from_rpy(p_WO, draw_real(-3, 3), draw_real(-1, 1), draw_real(-3, 3));
  }
  geometric::Shape new_shape() {
    const double size = draw_real(0.02, 0.4);
    switch (draw(0, 2)) {
      case 0:
        return geometric::Sphere{0.5 * size};
      case 1:
        return geometric::Cylinder{0.3 * size, draw_real(0.02, 0.6)};
      default:
        return geometric::Box{{size, draw_real(0.01, 0.6), draw_real(0.01, 0.6)}};
    }
  }
  const geometric::Shape& any_shape() { return shapes_[draw(0, shapes_.size() - 1)]; }
  geometric::SceneObject new_object(const geometric::Shape& shape) {
    geometric::SceneObject object;
    object.name = fmt::format("obstacle_{}", ++count_);
    object.shape = shape;
    object.X_PO = somewhere();
    return object;
  }
  std::string add() {
    scene_.objects.push_back(new_object(any_shape()));
    return scene_.objects.back().name;
  }

  static constexpr int kShapes = 20;
  static constexpr std::size_t kMostObstacles = 10;

  std::shared_ptr<const sampling::PmdBasis> basis_;
  Scene scene_;
  std::size_t own_;
  std::mt19937_64 random_;
  int count_ = 0;
  std::vector<geometric::Shape> shapes_;
  std::vector<Eigen::Vector3d> busy_places_;
  /// Checker for all shapes: what is derived from them is made once, and kept while it is used.
  std::shared_ptr<const geometric::CollisionChecker> prepared_;
};

/// The reference: pairs on their triangles.
class Reference {
 public:
  explicit Reference(const geometric::CollisionWorld& world)
      : checker_(geometric::make_collision_checker(
            std::make_shared<const geometric::CollisionWorld>(world),
            geometric::CheckerKind::kFcl)),
        motion_(world) {}

  [[nodiscard]] const geometric::CollisionWorld& world() const { return checker_->world(); }
  [[nodiscard]] bool collides(const Configuration& q) {
    return checker_->first_collision(q).has_value();
  }
  [[nodiscard]] bool is_closer_than(const Configuration& q, double distance) {
    return geometric::is_closer_than(*checker_, q, distance);
  }
  [[nodiscard]] bool path_collides(const planning::Path& path) {
    std::vector<int> all(world().pairs().size());
    std::iota(all.begin(), all.end(), 0);
    return path_collides(path, all);
  }
  [[nodiscard]] bool path_collides(const planning::Path& path, const std::vector<int>& pairs) {
    return std::ranges::any_of(pairs, [&](int pair) {
      for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
        if (edge_collides(pair, path.waypoints[i - 1], path.waypoints[i] - path.waypoints[i - 1])) {
          return true;
        }
      }
      return false;
    });
  }

 private:
  // Checks the edge in steps as far as the distance at their beginning permits, or of a millimetre.
  [[nodiscard]] bool edge_collides(int pair, const Configuration& from,
                                   const Configuration& along) {
    constexpr double kLeastStep = 1e-3;  // m
    const double travel = motion_.bound(pair, along.cwiseAbs());
    for (double share = 0.0;;) {
      const double rest = (1.0 - share) * travel;
      checker_->place(from + share * along);
      const double distance = checker_->pair_distance(pair, rest + kLeastStep);
      if (distance <= 0.0) {
        return true;
      }
      if (distance > rest) {
        return false;
      }
      share = std::min(1.0, share + std::max(distance, kLeastStep) / travel);
    }
  }

  std::unique_ptr<geometric::CollisionChecker> checker_;
  geometric::MotionBound motion_;
};

planning::PlanResult plan(const PlanningProblem& problem, std::uint64_t seed, double limit_s) {
  planning::PlanRequest request;
  request.seed = seed;
  request.time_limit_s = limit_s;
  return planning::PlannerRegistry().create("auto")->plan(problem, request);
}

struct EditTally {
  int edits = 0;
  int still_free = 0;    ///< The path from before is said to be free.
  int conflicts = 0;     ///< It is said not to be.
  int unconfirmed = 0;   ///< Conflicts with nothing near there.
  int ends_blocked = 0;  ///< Start or goal collides: nothing to plan.
  int plans = 0;         ///< With both ends free …
  int found = 0;         ///< … and a path within the time limit.
  int in_collision = 0;  ///< Paths that are said to be free, or were found, and collide.
};

void print(const EditTally& tally) {
  fmt::print(
      "{} edits: the path still free after {}, not free after {} ({} without anything near there); "
      "start or goal blocked after {}; {} plans, {} found; {} paths in collision\n",
      tally.edits, tally.still_free, tally.conflicts, tally.unconfirmed, tally.ends_blocked,
      tally.plans, tally.found, tally.in_collision);
  std::fflush(stdout);
}

/// A path that is kept while the scene changes.
class KeptPath {
 public:
  /// @param edited the object that came, moved or changed; may be empty.
  /// @returns whether both ends of the path are free.
  bool follow_edit(const Problem& problem, const std::string& edited, std::uint64_t seed,
                   EditTally& tally) {
    ++tally.edits;
    if (!edited.empty()) {
      edited_.insert(edited);
    }
    constexpr int kPlanAnywayEvery = 100;
    if (!path_.empty() && is_still_free(*problem, tally) && tally.edits % kPlanAnywayEvery != 0) {
      return true;
    }
    constexpr double kTimeLimit = 0.25;  // s
    planning::PlanResult result = plan(*problem, seed, kTimeLimit);
    if (result.status == planning::PlanStatus::kStartInvalid ||
        result.status == planning::PlanStatus::kGoalInvalid) {
      ++tally.ends_blocked;
      return false;
    }
    ++tally.plans;
    if (!result.solved()) {
      return true;
    }
    ++tally.found;
    confirm(tally);
    path_ = std::move(result.path);
    edited_.clear();
    scene_ = problem;
    if (Reference(*problem->checker->shared_world()).path_collides(path_)) {
      ++tally.in_collision;
      fmt::print("edit {}: the path that was found collides\n", tally.edits);
    }
    return true;
  }

  /// Checks with the reference what it has not checked yet.
  void confirm(EditTally& tally) {
    if (passed_.empty()) {
      return;
    }
    Scene scene = *scene_->scene;
    scene.objects.insert(scene.objects.end(), passed_.begin(), passed_.end());
    Reference reference{geometric::CollisionWorld(scene)};
    for (const geometric::SceneObject& object : passed_) {
      if (reference.path_collides(path_, reference.world().pairs_with(object.name))) {
        ++tally.in_collision;
        fmt::print("the path that is said to be free collides with {}\n", object.name);
      }
    }
    passed_.clear();
  }

  /// Returns positions of the robot's last link along the motion, shape [3] each, m, in the world.
  [[nodiscard]] std::vector<Eigen::Vector3d> places(const PlanningProblem& problem) const {
    constexpr int kPerEdge = 5;
    std::vector<Eigen::Vector3d> places;
    const std::unique_ptr<geometric::CollisionChecker> checker = problem.checker->clone();
    for (std::size_t i = 1; i < path_.waypoints.size(); ++i) {
      for (int k = 0; k < kPerEdge; ++k) {
        const double share = static_cast<double>(k) / kPerEdge;
        checker->place((1.0 - share) * path_.waypoints[i - 1] + share * path_.waypoints[i]);
        places.emplace_back(checker->world().X_WB() * checker->link_poses().back().translation());
      }
    }
    return places;
  }

 private:
  bool is_still_free(const PlanningProblem& problem, EditTally& tally) {
    const auto conflict = planning::PathConflictSearch(problem).run(path_.waypoints);
    if (conflict) {
      ++tally.conflicts;
      constexpr double kNear = 1e-4;  // m: twice the distance that paths keep
      const std::size_t next = std::min(conflict->waypoint + 1, path_.waypoints.size() - 1);
      const Configuration& from = path_.waypoints[conflict->waypoint];
      if (!Reference(*problem.checker->shared_world())
               .is_closer_than(from + conflict->share * (path_.waypoints[next] - from), kNear)) {
        ++tally.unconfirmed;
        fmt::print("edit {}: nothing is near where {}\n", tally.edits, conflict->text);
      }
      return false;
    }
    ++tally.still_free;
    for (const std::string& name : edited_) {  // nothing else moved since the path was free
      if (const auto* object = geometric::find_object(*problem.scene, name)) {
        passed_.push_back(*object);
        passed_.back().name = fmt::format("{} after edit {}", name, tally.edits);
      }
    }
    edited_.clear();
    constexpr std::size_t kMost = 64;
    if (passed_.size() >= kMost) {
      confirm(tally);
    }
    return true;
  }

  planning::Path path_;
  Problem scene_;                 ///< Problem in which the path was found.
  std::set<std::string> edited_;  ///< Since the path was free.
  /// Objects that the path is reported free of, until the reference has checked it: many at a time,
  /// as its trees take longer than the query.
  std::vector<geometric::SceneObject> passed_;
};

EditTally soak_edits(ChangingScene& scene, int count, std::uint64_t seed) {
  constexpr int kReportEvery = 5000;
  EditTally tally;
  KeptPath path;
  std::string in_the_way;
  for (int i = 0; i < count; ++i) {
    const std::string edited = in_the_way.empty() ? scene.edit() : scene.move(in_the_way);
    const Problem problem = scene.problem();
    const int found = tally.found;
    const bool ends_are_free =
        path.follow_edit(problem, edited, seed + static_cast<std::uint64_t>(i), tally);
    in_the_way = ends_are_free ? "" : edited;
    if (tally.found > found) {
      scene.set_busy_places(path.places(*problem));
    }
    if ((i + 1) % kReportEvery == 0 && i + 1 < count) {
      print(tally);
    }
  }
  path.confirm(tally);
  return tally;
}

struct Tally {
  int tried = 0;
  int solved = 0;  ///< Motions that went to their end.
  int held = 0;    ///< Motions that were held or stopped for the scene.
  int failed = 0;
  double longest_hold_ms = 0.0;   ///< From the edit until the motion was held or stopped.
  double longest_stall_ms = 0.0;  ///< Longest stall of the device loop.
};

/// The program's clock stands while this lives, but for the steps of simulated devices.
class VirtualTime {
 public:
  VirtualTime() { program_clock.halt(machine_time()); }
  ~VirtualTime() { program_clock.go_on(machine_time()); }
  VirtualTime(const VirtualTime&) = delete;
  VirtualTime& operator=(const VirtualTime&) = delete;

  /// Leaves the other threads some time of the machine for each step.
  static void advance() {
    std::this_thread::sleep_for(std::chrono::microseconds(100));
    program_clock.shown_ns += std::chrono::nanoseconds(kStep).count();
  }
};

/// A device that follows its trajectory to the letter, and stops at once.
class SimulatedLink final : public device::TrajectoryClient {
 public:
  SimulatedLink(std::string name, device::JointRanges joints, Eigen::VectorXd position)
      : TrajectoryClient(std::move(name), std::move(joints)), position_(std::move(position)) {}

 private:
  void do_connect(const std::stop_token& /*stop*/) override { add_sample(position_); }
  void do_upload(const device::JointTrajectory& /*trajectory*/,
                 const std::stop_token& /*stop*/) override {}
  void do_start() override {}
  [[nodiscard]] double do_pause(double time) override { return time; }
  void do_resume() override {}
  void do_stop() override { stopped_ = true; }
  [[nodiscard]] bool do_update(double time) override {
    VirtualTime::advance();
    if (!stopped_ && !trajectory().times.empty() && time > 0.0) {
      position_ = trajectory().at(time);
    }
    add_sample(position_);
    return true;
  }

  Eigen::VectorXd position_;
  std::atomic<bool> stopped_ = false;
};

/// The devices of one motion.
struct Devices {
  std::unique_ptr<VirtualTime> time;  ///< For simulated ones.
  std::unique_ptr<device::ArmEmulator> arm;
  std::unique_ptr<device::HandEmulator> hand;
  std::vector<MotionTarget> targets;
};

Devices simulated_devices(const PlanningProblem& problem, const Configuration& start) {
  Devices devices;
  devices.time = std::make_unique<VirtualTime>();
  for (const char* kind : {"arm", "hand"}) {
    geometric::JointIndices variables = problem.joints.of_part(kind);
    auto link = std::make_unique<SimulatedLink>(
        kind, execution::device_joints(problem.model(), variables), start(variables));
    devices.targets.push_back({kind, std::move(variables), std::move(link)});
  }
  return devices;
}

Devices emulated_devices(const PlanningProblem& problem, const Configuration& start) {
  const auto settings = [&](const char* kind, auto fresh) {
    const geometric::JointIndices variables = problem.joints.of_part(kind);
    fresh.joints = execution::device_joints(problem.model(), variables);
    fresh.position = start(variables);
    return fresh;
  };
  Devices devices;
  devices.arm =
      std::make_unique<device::ArmEmulator>(settings("arm", device::Val3ControllerSettings{}), 0);
  devices.hand =
      std::make_unique<device::HandEmulator>(settings("hand", device::HandControllerSettings{}), 0);
  devices.targets =
      execution::parse_targets(devices.arm->address() + "," + devices.hand->address(), problem);
  return devices;
}

/// A scene's problem, made at its first use: not in the loop that drives the devices.
class LaterProblem {
 public:
  LaterProblem(Scene scene, std::shared_ptr<const sampling::PmdBasis> basis)
      : scene_(std::move(scene)), basis_(std::move(basis)) {}

  [[nodiscard]] Problem get() {
    const std::scoped_lock lock(mutex_);
    if (!problem_) {
      problem_ = std::make_shared<const PlanningProblem>(
          planning::make_problem(std::make_shared<const Scene>(std::move(scene_)), basis_));
    }
    return problem_;
  }

 private:
  std::mutex mutex_;
  Scene scene_;
  std::shared_ptr<const sampling::PmdBasis> basis_;
  Problem problem_;
};

/// Edits the scene while a motion runs, and keeps where the robot was measured in which scene.
class Witness final : public execution::MotionObserver {
 public:
  Witness(ChangingScene& scene, std::vector<MotionTarget>& targets, const Configuration& start)
      : scene_(scene), targets_(targets), q_(start) {
    take_scene();
  }

  void set_watch(SceneWatch& watch, std::stop_source& stop) {
    watch_ = &watch;
    stop_ = &stop;
    next_edit_ = Clock::now() + random_pause();
  }

  void on_sample(const execution::MotionSample& /*sample*/) override {}

  void on_progress(double /*time*/, const std::vector<execution::FollowingError>& /*e*/) override {
    const auto now = Clock::now();
    note(now);
    if (now >= next_edit_ && edits_ < kEdits) {
      ++edits_;
      scene_.edit();
      take_scene();
      edited_ = Clock::now();
      stall_ = 0.0;
      next_edit_ = edited_ + random_pause();
      watch_->follow(
          [problem = problem_](const std::stop_token& /*stop*/) { return problem->get(); });
    }
    if (held_ && seconds(now - held_at_) > kReaction) {
      stop_->request_stop();
    }
  }

  void on_held(const std::string& /*reason*/) override {
    if (!held_) {
      held_ = true;
      held_at_ = Clock::now();
      if (edits_ > 0) {
        longest_hold_ = std::max(longest_hold_, seconds(held_at_ - edited_));
      }
    }
  }

  [[nodiscard]] bool held() const { return held_; }
  [[nodiscard]] double longest_hold() const { return longest_hold_; }

  [[nodiscard]] double longest_stall() const { return longest_stall_; }

  /// Returns whether a joint moved in collision, later than kReaction after the edit and the loop's
  /// stalls.
  [[nodiscard]] bool saw_collision() {
    std::shared_ptr<LaterProblem> of;
    std::unique_ptr<Reference> reference;
    return std::ranges::any_of(moved_, [&](const Place& place) {
      if (place.problem != of) {
        of = place.problem;
        reference = std::make_unique<Reference>(*of->get()->checker->shared_world());
      }
      return reference->collides(place.q);
    });
  }

 private:
  struct Place {
    std::shared_ptr<LaterProblem> problem;
    Configuration q;
  };

  static constexpr int kEdits = 5;

  void take_scene() { problem_ = std::make_shared<LaterProblem>(scene_.scene(), scene_.basis()); }

  Clock::duration random_pause() {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(scene_.draw_real(0.05, 0.8)));
  }

  void note(Clock::time_point now) {
    const Configuration q = execution::with_measured(q_, targets_);
    const bool moved = (q - q_).cwiseAbs().maxCoeff() > kAtRest;
    q_ = q;
    if (noted_ != Clock::time_point{}) {
      stall_ = std::max(stall_, seconds(now - std::max(noted_, edited_)));
      longest_stall_ = std::max(longest_stall_, stall_);
    }
    noted_ = now;
    if (moved && seconds(now - edited_) > kReaction + stall_) {
      moved_.push_back({problem_, q});
    }
  }

  ChangingScene& scene_;
  std::shared_ptr<LaterProblem> problem_;
  std::vector<MotionTarget>& targets_;
  Configuration q_;
  SceneWatch* watch_ = nullptr;
  std::stop_source* stop_ = nullptr;
  Clock::time_point next_edit_;
  Clock::time_point edited_;
  Clock::time_point held_at_;
  std::vector<Place> moved_;
  Clock::time_point noted_;
  double stall_ = 0.0;  ///< The longest that the loop got no time of the machine since the edit.
  double longest_stall_ = 0.0;
  double longest_hold_ = 0.0;
  int edits_ = 0;
  bool held_ = false;
};

template <typename MakeDevices>
Tally soak_motions(const planning::SceneState& loaded, int count, std::uint64_t seed,
                   const MakeDevices& make_devices) {
  Tally tally;
  for (int i = 0; tally.tried < count; ++i) {
    ChangingScene scene(loaded, seed + static_cast<std::uint64_t>(i));
    const Problem problem = scene.problem();
    constexpr double kTimeLimit = 2.0;  // s
    const planning::PlanResult result =
        plan(*problem, seed + static_cast<std::uint64_t>(i), kTimeLimit);
    if (!result.solved()) {
      continue;
    }
    planning::TimingOptions options;
    options.period = 0.02;
    options.speed = scene.draw_real(0.15, 0.5);
    const planning::TimedPath timed = time_path(*problem, result.path, "soak", options);
    if (!timed.cleared()) {
      continue;
    }
    ++tally.tried;
    const planning::Trajectory& trajectory = timed.motion.trajectory;
    const Configuration start = trajectory.points.front().position;
    Devices devices = make_devices(*problem, start);
    for (const MotionTarget& target : devices.targets) {
      target.link->connect();
      target.link->upload(execution::part_of(trajectory, target.variables));
    }
    std::stop_source stop;
    execution::MotionRequests requests;
    requests.stop = stop.get_token();
    SceneWatch watch(trajectory, [problem](const std::stop_token&) { return problem; });
    requests.watch = &watch;
    Witness witness(scene, devices.targets, start);
    witness.set_watch(watch, stop);
    const execution::MotionOutcome outcome = run_motion(devices.targets, {}, requests, witness);
    tally.solved += outcome.done ? 1 : 0;
    tally.held += witness.held() || !outcome.collision.empty() ? 1 : 0;
    tally.longest_hold_ms = std::max(tally.longest_hold_ms, 1e3 * witness.longest_hold());
    tally.longest_stall_ms = std::max(tally.longest_stall_ms, 1e3 * witness.longest_stall());
    if (!outcome.fault.empty() && outcome.collision.empty()) {
      fmt::print("motion {}: {}\n", i, outcome.fault);
    }
    if (witness.saw_collision()) {
      ++tally.failed;
      fmt::print("motion {}: moved in collision\n", i);
    }
  }
  return tally;
}

void print(const char* what, const Tally& tally) {
  fmt::print("{}: {} tried, {} to the end, {} held or stopped for the scene, {} in collision", what,
             tally.tried, tally.solved, tally.held, tally.failed);
  if (tally.longest_hold_ms > 0.0) {
    fmt::print("; {:.0f} ms from edit to hold at most", tally.longest_hold_ms);
  }
  if (tally.longest_stall_ms > 0.0) {
    fmt::print("; the program stood still for {:.0f} ms at most", tally.longest_stall_ms);
  }
  fmt::print("\n");
}

int run(int argc, char** argv) {
  CLI::App app("Random edits, plans and motions, looked at by the reference checker");
  std::string name = "can_on_table";
  int edits = 100;
  int real = 3;
  int virtual_runs = 10;
  std::uint64_t seed = 1;
  app.add_option("--scene", name, "A scene that ships")->capture_default_str();
  app.add_option("--edits", edits, "Edits, after each of which there is to be a path")
      ->capture_default_str();
  app.add_option("--real", real, "Motions of the emulated devices")->capture_default_str();
  app.add_option("--virtual", virtual_runs, "Motions of simulated devices")->capture_default_str();
  app.add_option("--seed", seed, "Of everything")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const std::vector<KnownProblem> problems = known_problems();
  const auto found = std::ranges::find(problems, name, &KnownProblem::name);
  if (found == problems.end()) {
    fmt::print(stderr, "no scene {}\n", name);
    return 2;
  }
  const planning::SceneState loaded = load(*found);
  int failed = 0;
  const auto report = [&](const char* what, const Tally& tally) {
    print(what, tally);
    failed += tally.failed;
  };
  ChangingScene scene(loaded, seed);
  const EditTally after_edits = soak_edits(scene, edits, seed);
  print(after_edits);
  failed += after_edits.in_collision + after_edits.unconfirmed;
  report("motions on emulated devices", soak_motions(loaded, real, seed, emulated_devices));
  report("motions in virtual time", soak_motions(loaded, virtual_runs, seed, simulated_devices));
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace handway::test

int main(int argc, char** argv) { return handway::test::run(argc, argv); }
