#pragma once

#include "grasping_hand.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/tasks/task.h"
#include "task_world.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// An object in the hand.
struct HeldObject {
  std::string name;
  std::shared_ptr<const GraspingHand> hand;
  Pregrasp grasp;        ///< The grasp that holds it.
  geometric::Pose X_OP;  ///< Pose of the palm in the object's frame, while the hand holds it …
  geometric::Pose X_OP_open;       ///< … and in the pre-grasp.
  std::vector<std::string> group;  ///< Scene::group before the object was picked.
};

/// State of the scene between two steps.
struct TaskState {
  TaskWorld world;
  Configuration q;
  std::optional<HeldObject> held = {};
};

/// A stage of a candidate. Those of the planner have no path until they are planned.
struct StageDraft {
  TaskStage stage;
  TaskWorld world;
  Configuration from;
  Configuration to;
  bool is_planned = false;  ///< The planner has tried it.
};

/// One way to do a step.
struct StepCandidate {
  std::vector<std::shared_ptr<StageDraft>> stages;
  TaskState end;
};

/// Settings and results that the candidates of all steps share. It outlives them.
struct TaskContext {
  const TaskOptions& options;
  const std::stop_token& stop;
  TrialLog& log;
};

/// The ways to do one step from one state, the best first.
class StepCandidates {
 public:
  virtual ~StepCandidates() = default;
  /// Returns the next one whose straight and closing stages are free; nothing if there are no more.
  [[nodiscard]] virtual std::optional<StepCandidate> next() = 0;
};

/// @pre the hand is empty. @throws InputError as find_pregrasps().
[[nodiscard]] std::unique_ptr<StepCandidates> pick_candidates(const PickStep& pick,
                                                              std::size_t step,
                                                              const TaskState& begin,
                                                              const TaskContext& context);
/// @pre the hand carries an object.
[[nodiscard]] std::unique_ptr<StepCandidates> place_candidates(const PlaceStep& place,
                                                               std::size_t step,
                                                               const TaskState& begin,
                                                               const TaskContext& context);
[[nodiscard]] std::unique_ptr<StepCandidates> move_candidates(const MoveStep& move,
                                                              std::size_t step,
                                                              const TaskState& begin,
                                                              const TaskContext& context);

/// The configurations in which a link is at the pose, the nearest first. While the hand carries an
/// object its joints stay.
[[nodiscard]] std::unique_ptr<StepCandidates> pose_candidates(const PoseStep& move,
                                                              std::size_t step,
                                                              const TaskState& begin,
                                                              const TaskContext& context);
/// The only way along a straight line; none if it is blocked.
[[nodiscard]] std::unique_ptr<StepCandidates> line_candidates(const LineStep& line,
                                                              std::size_t step,
                                                              const TaskState& begin,
                                                              const TaskContext& context);

/// The robot rests where it is.
[[nodiscard]] std::unique_ptr<StepCandidates> wait_candidates(const WaitStep& wait,
                                                              std::size_t step,
                                                              const TaskState& begin);
/// The robot stays where it is, without a time.
[[nodiscard]] std::unique_ptr<StepCandidates> output_candidates(std::size_t step,
                                                                const TaskState& begin);

/// A stage that the planner has to plan.
[[nodiscard]] std::shared_ptr<StageDraft> free_stage(StageKind kind, std::size_t step,
                                                     const TaskWorld& world,
                                                     const Configuration& from,
                                                     const Configuration& to,
                                                     const std::string& carried);
/// A stage with a path. @param deviation as TaskStage::deviation.
[[nodiscard]] std::shared_ptr<StageDraft> fixed_stage(StageKind kind, std::size_t step,
                                                      const TaskWorld& world, Path path,
                                                      const std::string& carried,
                                                      double deviation = 0.0);

/// Returns a free straight motion of the palm upwards from `q`: by the whole height or, where that
/// is blocked, by half or a quarter of it.
/// @param downwards true: the path is turned round, and ends at `q`.
[[nodiscard]] PalmLine vertical_line(const GraspingHand& hand, const TaskWorld& world,
                                     const Configuration& q, double height, bool downwards,
                                     const std::stop_token& stop);

}  // namespace handway::planning
