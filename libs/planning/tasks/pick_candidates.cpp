#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/grasps/given_grasps.h"
#include "step_candidates.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Pose;

/// Grasps of one object, the best first, with the ways to and from them.
class PickCandidates : public StepCandidates {
 public:
  PickCandidates(PickStep pick, std::size_t step, TaskState begin, const TaskContext& context)
      : pick_(std::move(pick)), step_(step), begin_(std::move(begin)), context_(context) {
    take_known();
    if (grasps_.found.empty()) {
      search_on();
    }
    if (grasps_.found.empty()) {
      context.log.fail(step, StageKind::kClose, "No grasp: " + grasps_.why_none, begin_.q);
      return;
    }
    hand_ = std::make_shared<const GraspingHand>(*begin_.world.problem, grasps_.palm);
    const geometric::SceneObject& object = *begin_.world.state.find(pick_.object);
    X_WO_ = object.X_PO;
    middle_W_ = X_WO_ * geometric::bounding_box(*geometric::tessellate(object.shape)).centre();
    contact_world_ = TaskWorld::of(with_contacts(begin_.world.state, hand_->links(), pick_.object),
                                   begin_.q, context.stop);
  }

  std::optional<StepCandidate> next() override {
    while (true) {
      while (index_ < grasps_.found.size()) {
        if (auto candidate = try_grasp(grasps_.found[index_++])) {
          return candidate;
        }
      }
      if ((grasps_.found.empty() && searched_ > 0) || searched_ >= context_.options.grasps.most) {
        return std::nullopt;
      }
      search_on();
    }
  }

 private:
  // The first search is short, and ends with grasps that hold: in most scenes one of them will do.
  static constexpr int kFirstGrasps = 4;
  static constexpr double kEnoughEpsilon = 0.1;  // N

  // Takes the grasps of the options, and then those that the scene keeps for the object, in the
  // order of their file.
  void take_known() {
    std::vector<GivenGrasp> known;
    const GraspsByObject& first = context_.options.first_grasps;
    if (const auto found = first.find(pick_.object); found != first.end()) {
      known = found->second;
    }
    const std::filesystem::path& file = begin_.world.state.find(pick_.object)->grasps;
    if (!file.empty()) {
      std::ranges::move(read_given_grasps(file, *begin_.world.problem, pick_.object),
                        std::back_inserter(known));
    }
    if (known.empty()) {
      return;
    }
    MeasuredGrasps measured = measure_given_grasps(*begin_.world.problem, pick_.object, known,
                                                   search_options(), context_.stop);
    geometric::end_if_stopped(context_.stop);
    for (const std::string& reason : measured.left_out) {
      context_.log.fail(step_, StageKind::kClose, reason, begin_.q);
    }
    grasps_ = std::move(measured.grasps);
  }

  [[nodiscard]] PregraspOptions search_options() const {
    PregraspOptions options = context_.options.grasps;
    options.seed = context_.options.seed;
    options.threads = context_.options.threads;
    return options;
  }

  // Searches for a few grasps at first, then for all that are wanted, and leaves out those that
  // were tried.
  void search_on() {
    std::ranges::transform(grasps_.found, std::back_inserter(tried_), &Pregrasp::closed);
    PregraspOptions options = search_options();
    if (searched_ == 0) {
      options.most = std::min(kFirstGrasps, options.most);
      options.enough_epsilon = kEnoughEpsilon;
    }
    grasps_ = find_pregrasps(*begin_.world.problem, pick_.object, options, context_.stop);
    geometric::end_if_stopped(context_.stop);
    searched_ = options.most;
    std::erase_if(grasps_.found, [&](const Pregrasp& grasp) {
      return std::ranges::count(tried_, grasp.closed) > 0;
    });
    index_ = 0;
  }

  std::optional<StepCandidate> try_grasp(const Pregrasp& grasp) {
    StepCandidate candidate;
    Path close{{grasp.q, grasp.closed}};
    if (const auto fault = contact_world_.conflict(close.waypoints, context_.stop)) {
      context_.log.fail(step_, StageKind::kClose, *fault, grasp.closed);
      return std::nullopt;
    }
    context_.log.succeed(step_, StageKind::kClose);
    const TaskWorld carrying = carrying_world(grasp);
    PalmLine lift = vertical_line(*hand_, carrying, grasp.closed, pick_.lift, false, context_.stop);
    if (!lift.fault.empty()) {
      context_.log.fail(step_, StageKind::kLift, lift.fault, grasp.closed);
      return std::nullopt;
    }
    context_.log.succeed(step_, StageKind::kLift);
    add_approach(grasp, candidate);
    candidate.stages.push_back(
        fixed_stage(StageKind::kClose, step_, contact_world_, std::move(close), ""));
    TaskStage& closing = candidate.stages.back()->stage;
    closing.squeezed = grasp.squeezed;
    closing.grasp = as_given(*begin_.world.problem, pick_.object, grasp, grasps_.palm,
                             "the grasp of the plan before");
    candidate.end = {carrying, lift.path.waypoints.back(), held(grasp, carrying)};
    candidate.stages.push_back(fixed_stage(StageKind::kLift, step_, carrying, std::move(lift.path),
                                           pick_.object, lift.deviation));
    return candidate;
  }

  // A straight reach where there is one; else the planner goes to the pre-grasp.
  void add_approach(const Pregrasp& grasp, StepCandidate& candidate) {
    GraspingHand::WayOut reach = hand_->way_out(begin_.world, grasp, grasp.q, middle_W_,
                                                pick_.approach, true, context_.stop);
    const bool is_straight = reach.fault.empty();
    candidate.stages.push_back(free_stage(StageKind::kApproach, step_, begin_.world, begin_.q,
                                          is_straight ? reach.path.waypoints.front() : grasp.q,
                                          ""));
    if (is_straight) {
      context_.log.succeed(step_, StageKind::kReach);
      candidate.stages.push_back(fixed_stage(StageKind::kReach, step_, begin_.world,
                                             std::move(reach.path), "", reach.deviation));
    } else {
      context_.log.fail(step_, StageKind::kReach, reach.fault, reach.shown);
    }
  }

  [[nodiscard]] TaskWorld carrying_world(const Pregrasp& grasp) const {
    const geometric::Scene& scene = *begin_.world.state.scene;
    SceneState state = attached(begin_.world.state, grasp.closed, {pick_.object},
                                {scene.robots.front().name, hand_->palm_name()}, hand_->links());
    if (!scene.group.empty()) {  // it would let the fingers move that hold the object
      geometric::Scene of_arm = *state.scene;
      of_arm.group = hand_->arm_names();
      state.scene = std::make_shared<const geometric::Scene>(std::move(of_arm));
    }
    return TaskWorld::of(state, grasp.closed, context_.stop);
  }

  [[nodiscard]] HeldObject held(const Pregrasp& grasp, const TaskWorld& carrying) const {
    return {pick_.object,
            hand_,
            grasp,
            carrying.state.find(pick_.object)->X_PO.inverse(),
            X_WO_.inverse() * hand_->palm_pose(grasp.q),
            begin_.world.state.scene->group};
  }

  PickStep pick_;
  std::size_t step_;
  TaskState begin_;
  const TaskContext& context_;
  Pregrasps grasps_;
  std::shared_ptr<const GraspingHand> hand_;
  Pose X_WO_;
  Eigen::Vector3d middle_W_;  ///< Middle of the object.
  TaskWorld contact_world_;   ///< The hand may touch the object.
  std::size_t index_ = 0;
  int searched_ = 0;  ///< Number of grasps that the last search was for.
  std::vector<Configuration>
      tried_;  ///< The closed hand of grasps before those of the last search.
};

}  // namespace

std::unique_ptr<StepCandidates> pick_candidates(const PickStep& pick, std::size_t step,
                                                const TaskState& begin,
                                                const TaskContext& context) {
  return std::make_unique<PickCandidates>(pick, step, begin, context);
}

}  // namespace handway::planning
