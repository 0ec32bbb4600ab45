/// Random edits, plans and motions, looked at by the reference checker (FCL, pair by pair):
///
///     soak_motions [--scene NAME] [--edits N] [--real N] [--virtual N] [--seed N]
///
/// `--edits`: edits of the scene, each followed by a plan; every path found is looked at in steps
/// of a millimetre at most. `--real`: motions of the emulated arm and hand, through sockets, in
/// scenes that are edited meanwhile. `--virtual`: the same with simulated devices, on a clock that
/// goes ten times as fast. A motion fails if a joint still moves in collision later than kReaction
/// after the edit that is in its way. Exits 1 if any path or motion fails.
#include "handway/device/arm/arm_emulator.h"
#include "handway/device/core/motion_link.h"
#include "handway/device/hand/hand_emulator.h"
#include "handway/execution/motion/motion_parts.h"
#include "handway/execution/motion/motion_run.h"
#include "handway/execution/motion/scene_watch.h"
#include "handway/geometric/collision/make_checker.h"
#include "handway/geometric/math/pose.h"
#include "handway/planning/core/planner_registry.h"
#include "handway/planning/timing/time_path.h"
#include "handway_test/known_problems.h"

#include <CLI/CLI.hpp>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <memory>
#include <mutex>
#include <random>
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

/// The program's steady clock: it can go faster than the machine's.
struct ProgramClock {
  std::atomic<std::int64_t> rate = 1;
  std::atomic<std::int64_t> machine_ns = 0;  ///< When the rate was set …
  std::atomic<std::int64_t> shown_ns = 0;    ///< … and what the clock showed then.

  [[nodiscard]] std::int64_t shown(std::int64_t machine) const {
    return shown_ns + rate * (machine - machine_ns);
  }
  void set_rate(std::int64_t faster) {
    timespec time{};
    read_machine_clock(CLOCK_MONOTONIC, &time);
    const std::int64_t now = nanoseconds(time);
    shown_ns = shown(now);
    machine_ns = now;
    rate = faster;
  }
};

ProgramClock program_clock;

}  // namespace

// What std::chrono::steady_clock reads, in this program and in the libraries.
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

// From an edit to rest: the hold, the devices' own stopping, the last sample.
constexpr double kReaction = 0.5;  // s
constexpr double kAtRest = 2e-4;   // rad, from one sample to the next
constexpr int kFaster = 10;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// A scene that changes at random: obstacles come, move, grow and go.
class ChangingScene {
 public:
  ChangingScene(const planning::LoadedScene& loaded, std::uint64_t seed)
      : basis_(loaded.basis), scene_(*loaded.scene), own_(scene_.objects.size()), random_(seed) {}

  void edit() {
    const std::size_t added = scene_.objects.size() - own_;
    switch (added == 0 ? 0 : draw(added > 4 ? 1 : 0, 3)) {
      case 0:
        add();
        break;
      case 1:
        any_added().X_PO = somewhere();
        break;
      case 2:
        any_added().shape = some_shape();
        break;
      default:
        scene_.objects.erase(scene_.objects.begin() +
                             static_cast<std::ptrdiff_t>(own_ + draw(0, added - 1)));
    }
  }

  [[nodiscard]] Problem problem() const {
    return std::make_shared<const PlanningProblem>(
        planning::make_problem(std::make_shared<const Scene>(scene_), basis_));
  }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const std::shared_ptr<const sampling::PmdBasis>& basis() const { return basis_; }

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
    return geometric::pose_from_rpy(
        {draw_real(-0.2, 1.0), draw_real(-0.8, 0.8), draw_real(0.1, 1.4)}, draw_real(-3, 3),
        draw_real(-1, 1), draw_real(-3, 3));
  }
  geometric::Shape some_shape() {
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
  void add() {
    geometric::SceneObject object;
    object.name = fmt::format("obstacle_{}", ++count_);
    object.shape = some_shape();
    object.X_PO = somewhere();
    scene_.objects.push_back(std::move(object));
  }

  std::shared_ptr<const sampling::PmdBasis> basis_;
  Scene scene_;
  std::size_t own_;
  std::mt19937_64 random_;
  int count_ = 0;
};

/// The reference: every pair, on the triangles.
class Reference {
 public:
  explicit Reference(const PlanningProblem& problem)
      : checker_(geometric::make_collision_checker(problem.checker->shared_world(),
                                                   geometric::CheckerKind::kFcl)) {}

  [[nodiscard]] bool collides(const Configuration& q) {
    return checker_->first_collision(q).has_value();
  }

 private:
  std::unique_ptr<geometric::CollisionChecker> checker_;
};

// In steps in which no point moves farther than about a millimetre: 1 mm at 1.5 m from the base.
bool path_collides(const PlanningProblem& problem, const planning::Path& path) {
  constexpr double kStep = 0.7e-3;  // rad, of all joints together
  Reference reference(problem);
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    const Configuration& from = path.waypoints[i - 1];
    const Configuration along = path.waypoints[i] - from;
    const int steps = std::max(1, static_cast<int>(std::ceil(along.lpNorm<1>() / kStep)));
    for (int s = 0; s <= steps; ++s) {
      if (reference.collides(from + static_cast<double>(s) / steps * along)) {
        return true;
      }
    }
  }
  return false;
}

planning::PlanResult plan(const PlanningProblem& problem, std::uint64_t seed) {
  planning::PlanRequest request;
  request.seed = seed;
  request.time_limit_s = 2.0;
  return planning::PlannerRegistry().create("pmd-auto")->plan(problem, request);
}

struct Tally {
  int tried = 0;
  int solved = 0;  ///< Paths found, or motions that went to their end.
  int held = 0;    ///< Motions that were held or stopped for the scene.
  int failed = 0;
  double longest_hold_ms = 0.0;  ///< From the edit until the motion was held or stopped.
};

Tally soak_plans(ChangingScene& scene, int count, std::uint64_t seed) {
  Tally tally;
  for (int i = 0; i < count; ++i) {
    scene.edit();
    const Problem problem = scene.problem();
    const planning::PlanResult result = plan(*problem, seed + static_cast<std::uint64_t>(i));
    ++tally.tried;
    if (result.solved()) {
      ++tally.solved;
      if (path_collides(*problem, result.path)) {
        ++tally.failed;
        fmt::print("edit {}: the path collides\n", i);
      }
    }
  }
  return tally;
}

/// A device that follows its trajectory to the letter, and stops at once.
class SimulatedLink final : public device::MotionLink {
 public:
  SimulatedLink(std::string name, device::JointRanges joints, Eigen::VectorXd position)
      : MotionLink(std::move(name), std::move(joints)), position_(std::move(position)) {}

 private:
  void do_connect(const std::stop_token& /*stop*/) override { add_sample(position_); }
  void do_upload(const device::JointTrajectory& /*trajectory*/,
                 const std::stop_token& /*stop*/) override {}
  void do_start() override {}
  [[nodiscard]] double do_pause(double time) override { return time; }
  void do_resume() override {}
  void do_stop() override { stopped_ = true; }
  [[nodiscard]] bool do_update(double time) override {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
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
  std::unique_ptr<device::ArmEmulator> arm;
  std::unique_ptr<device::HandEmulator> hand;
  std::vector<MotionTarget> targets;
};

Devices simulated_devices(const PlanningProblem& problem, const Configuration& start) {
  Devices devices;
  for (const char* kind : {"arm", "hand"}) {
    std::vector<int> variables = execution::device_variables(problem, kind);
    auto link = std::make_unique<SimulatedLink>(
        kind, execution::device_joints(problem.model(), variables), start(variables));
    devices.targets.push_back({kind, std::move(variables), std::move(link)});
  }
  return devices;
}

Devices emulated_devices(const PlanningProblem& problem, const Configuration& start) {
  const auto settings = [&](const char* kind, auto fresh) {
    const std::vector<int> variables = execution::device_variables(problem, kind);
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

/// A scene's problem, made when somebody needs it first: not in the loop that drives the devices.
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
      longest_hold_ = std::max(longest_hold_, seconds(held_at_ - edited_));
    }
  }

  [[nodiscard]] bool held() const { return held_; }
  [[nodiscard]] double longest_hold() const { return longest_hold_; }

  /// Did a joint move in collision, later than kReaction after the edit?
  [[nodiscard]] bool saw_collision() {
    std::shared_ptr<LaterProblem> of;
    std::unique_ptr<Reference> reference;
    return std::ranges::any_of(moved_, [&](const Place& place) {
      if (place.problem != of) {
        of = place.problem;
        reference = std::make_unique<Reference>(*of->get());
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
    if (moved && seconds(now - edited_) > kReaction) {
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
  double longest_hold_ = 0.0;
  int edits_ = 0;
  bool held_ = false;
};

template <typename MakeDevices>
Tally soak_motions(const planning::LoadedScene& loaded, int count, std::uint64_t seed,
                   const MakeDevices& make_devices) {
  Tally tally;
  for (int i = 0; tally.tried < count; ++i) {
    ChangingScene scene(loaded, seed + static_cast<std::uint64_t>(i));
    const Problem problem = scene.problem();
    const planning::PlanResult result = plan(*problem, seed + static_cast<std::uint64_t>(i));
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
  app.add_option("--edits", edits, "Edits, each followed by a plan")->capture_default_str();
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
  const planning::LoadedScene loaded = load(*found);
  int failed = 0;
  const auto report = [&](const char* what, const Tally& tally) {
    print(what, tally);
    failed += tally.failed;
  };
  ChangingScene scene(loaded, seed);
  report("plans after edits", soak_plans(scene, edits, seed));
  report("motions on emulated devices", soak_motions(loaded, real, seed, emulated_devices));
  program_clock.set_rate(kFaster);
  report("motions in virtual time", soak_motions(loaded, virtual_runs, seed, simulated_devices));
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace handway::test

int main(int argc, char** argv) { return handway::test::run(argc, argv); }
