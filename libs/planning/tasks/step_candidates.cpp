#include "step_candidates.h"

#include <algorithm>
#include <utility>

namespace handway::planning {
namespace {

/// The only way to move to a posture.
class MoveCandidates : public StepCandidates {
 public:
  explicit MoveCandidates(StepCandidate candidate) : candidate_(std::move(candidate)) {}

  std::optional<StepCandidate> next() override { return std::exchange(candidate_, std::nullopt); }

 private:
  std::optional<StepCandidate> candidate_;
};

}  // namespace

std::shared_ptr<StageDraft> free_stage(StageKind kind, std::size_t step, const TaskWorld& world,
                                       const Configuration& from, const Configuration& to,
                                       const std::string& carried) {
  auto draft = std::make_shared<StageDraft>();
  draft->stage.kind = kind;
  draft->stage.step = step;
  draft->stage.carried = carried;
  draft->world = world;
  draft->from = from;
  draft->to = to;
  return draft;
}

std::shared_ptr<StageDraft> fixed_stage(StageKind kind, std::size_t step, const TaskWorld& world,
                                        Path path, const std::string& carried, double deviation) {
  auto draft =
      free_stage(kind, step, world, path.waypoints.front(), path.waypoints.back(), carried);
  draft->stage.path = std::move(path);
  draft->stage.state = with_ends(world.state, draft->from, draft->to);
  draft->stage.deviation = deviation;
  draft->is_planned = true;
  return draft;
}

PalmLine vertical_line(const GraspingHand& hand, const TaskWorld& world, const Configuration& q,
                       double height, bool downwards, const std::stop_token& stop) {
  PalmLine first;
  for (const double share : {1.0, 0.5, 0.25}) {
    PalmLine line = hand.line(q, share * height * Eigen::Vector3d::UnitZ());
    if (line.fault.empty()) {
      if (downwards) {
        std::ranges::reverse(line.path.waypoints);
      }
      line.fault = world.conflict(line.path.waypoints, stop).value_or("");
    }
    if (line.fault.empty()) {
      return line;
    }
    first = first.fault.empty() ? std::move(line) : std::move(first);
  }
  return first;
}

std::unique_ptr<StepCandidates> move_candidates(const MoveStep& move, std::size_t step,
                                                const TaskState& begin,
                                                const TaskContext& /*context*/) {
  TaskState end = begin;
  const std::string carried = begin.held ? begin.held->name : std::string();
  end.q = begin.held ? begin.held->hand->with_hand(move.q, begin.q) : move.q;
  StepCandidate only{{free_stage(carried.empty() ? StageKind::kMove : StageKind::kCarry, step,
                                 begin.world, begin.q, end.q, carried)},
                     end};
  return std::make_unique<MoveCandidates>(std::move(only));
}

}  // namespace handway::planning
