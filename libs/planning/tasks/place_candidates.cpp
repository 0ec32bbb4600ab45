#include "handway/geometric/mesh/shape.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/tasks/resting_places.h"
#include "step_candidates.h"

#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Pose;

/// Places for the object in the hand, with the ways to and from them.
class PlaceCandidates : public StepCandidates {
 public:
  PlaceCandidates(PlaceStep place, std::size_t step, TaskState begin, const TaskContext& context)
      : place_(std::move(place)), step_(step), begin_(std::move(begin)), context_(context) {
    const geometric::Scene& scene = *begin_.world.state.scene;
    geometric::SceneObject object = *geometric::find_object(scene, held().name);
    middle_ = geometric::bounding_box(*geometric::tessellate(object.shape)).centre();
    object.X_PO = geometric::object_pose(scene, begin_.q, object);
    object.attachment.reset();
    if (place_.supports.empty()) {
      places_ = {place_.pose.value_or(object.X_PO)};
    }
    for (const std::string& support : place_.supports) {
      add_places(object, support);
    }
  }

  std::optional<StepCandidate> next() override {
    while (index_ < places_.size()) {
      if (auto candidate = try_place(places_[index_++])) {
        return candidate;
      }
    }
    return std::nullopt;
  }

 private:
  void add_places(const geometric::SceneObject& object, const std::string& support) {
    const geometric::Scene& scene = *begin_.world.state.scene;
    const std::optional<Pose> X_WS = geometric::standing_pose(scene, support);
    if (place_.pose && X_WS) {
      places_.push_back(*X_WS * *place_.pose);
      return;
    }
    const int count = context_.options.places;
    const std::vector<Pose> found =
        geometric::find_frame(scene, support) && X_WS
            ? places_at(object, *X_WS, count)
            : resting_places(scene, object, support, count, context_.options.seed + step_);
    places_.insert(places_.end(), found.begin(), found.end());
    if (found.empty()) {
      context_.log.fail(step_, StageKind::kLower,
                        "No face of " + support + " is large enough for " + object.name, begin_.q);
    }
  }

  [[nodiscard]] const HeldObject& held() const { return *begin_.held; }
  [[nodiscard]] const GraspingHand& hand() const { return *begin_.held->hand; }

  std::optional<StepCandidate> try_place(const Pose& X_WO) {
    const std::vector<Configuration> postures = hand().reach(begin_.q, X_WO * held().X_OP);
    if (postures.empty()) {
      context_.log.fail(step_, StageKind::kLower, "The arm does not reach the place", begin_.q);
    }
    for (const Configuration& q : postures) {
      if (auto candidate = try_posture(X_WO, q)) {
        return candidate;
      }
    }
    return std::nullopt;
  }

  // @param q with the object at its place.
  std::optional<StepCandidate> try_posture(const Pose& X_WO, const Configuration& q) {
    PalmLine lower = vertical_line(hand(), begin_.world, q, place_.lower, true, context_.stop);
    if (!lower.fault.empty()) {
      context_.log.fail(step_, StageKind::kLower, lower.fault, q);
      return std::nullopt;
    }
    context_.log.succeed(step_, StageKind::kLower);
    const SceneState put_down = this->put_down(q);
    const TaskWorld contacts =
        TaskWorld::of(with_contacts(put_down, hand().links(), held().name), q, context_.stop);
    Path open{{q, opened(X_WO, q)}};
    if (const auto fault = contacts.conflict(open.waypoints, context_.stop)) {
      context_.log.fail(step_, StageKind::kOpen, *fault, open.waypoints.back());
      return std::nullopt;
    }
    context_.log.succeed(step_, StageKind::kOpen);
    StepCandidate candidate;
    candidate.stages.push_back(free_stage(StageKind::kCarry, step_, begin_.world, begin_.q,
                                          lower.path.waypoints.front(), held().name));
    candidate.stages.push_back(fixed_stage(StageKind::kLower, step_, begin_.world,
                                           std::move(lower.path), held().name, lower.deviation));
    candidate.end = {TaskWorld::of(put_down, q, context_.stop), open.waypoints.back()};
    candidate.stages.push_back(fixed_stage(StageKind::kOpen, step_, contacts, std::move(open), ""));
    add_retreat(X_WO, candidate);
    return candidate;
  }

  // Without a straight retreat the planner's next motion leaves the object.
  void add_retreat(const Pose& X_WO, StepCandidate& candidate) {
    TaskState& end = candidate.end;
    GraspingHand::WayOut retreat = hand().way_out(end.world, held().grasp, end.q, X_WO * middle_,
                                                  place_.retreat, false, context_.stop);
    if (!retreat.fault.empty()) {
      context_.log.fail(step_, StageKind::kRetreat, retreat.fault, retreat.shown);
      return;
    }
    context_.log.succeed(step_, StageKind::kRetreat);
    end.q = retreat.path.waypoints.back();
    candidate.stages.push_back(fixed_stage(StageKind::kRetreat, step_, end.world,
                                           std::move(retreat.path), "", retreat.deviation));
  }

  // The pre-grasp at the place: of a hand whose arm moves to close it, the arm moves back as well.
  [[nodiscard]] Configuration opened(const Pose& X_WO, const Configuration& q) const {
    const Configuration open = hand().with_hand(q, held().grasp.q);
    const std::vector<Configuration> postures = hand().reach(open, X_WO * held().X_OP_open);
    return postures.empty() ? open : postures.front();
  }

  // The scene with the object at its place, and the group with which the task began.
  [[nodiscard]] SceneState put_down(const Configuration& q) const {
    SceneState state = detached(begin_.world.state, q, {held().name});
    geometric::Scene scene = *state.scene;
    scene.group = held().group;
    state.scene = std::make_shared<const geometric::Scene>(std::move(scene));
    return state;
  }

  PlaceStep place_;
  std::size_t step_;
  TaskState begin_;
  const TaskContext& context_;
  std::vector<Pose> places_;  ///< Poses of the object, in the world.
  Eigen::Vector3d middle_;    ///< Middle of the object, in its frame.
  std::size_t index_ = 0;
};

}  // namespace

std::unique_ptr<StepCandidates> place_candidates(const PlaceStep& place, std::size_t step,
                                                 const TaskState& begin,
                                                 const TaskContext& context) {
  return std::make_unique<PlaceCandidates>(place, step, begin, context);
}

}  // namespace handway::planning
