#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/roadmap/roadmap_recorder.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace handway::gui {

/// A roadmap with the palm's place in each of its nodes.
struct PalmRoadmap {
  static constexpr std::size_t kMostNodes = 20000;  ///< More are not kept.

  planning::RecordedRoadmap roadmap;
  std::vector<Eigen::Vector3d> palms;  ///< In the world, m; shape [nodes].
};

using SharedRoadmap = std::shared_ptr<const PalmRoadmap>;

/// Records a run's roadmap and where the palm is in its nodes. For the planner's thread.
class RoadmapWatch : public planning::RoadmapRecorder {
 public:
  /// @param problem that is planned; outlives this. @param palm_link of its robot.
  RoadmapWatch(const planning::PlanningProblem& problem, int palm_link);

  void on_node(const planning::NodeEvent& node) override;

  /// Returns whether there is news since it was last taken.
  [[nodiscard]] bool has_news() const;
  /// Returns the roadmap found so far; of several searches, the winner's once there is one.
  [[nodiscard]] SharedRoadmap take();

 private:
  [[nodiscard]] Eigen::Vector3d palm_at(const geometric::Configuration& q);

  const planning::PlanningProblem& problem_;
  int palm_link_;
  std::vector<geometric::Pose> X_BL_;
  std::vector<Eigen::Vector3d> palms_;
  std::size_t taken_nodes_ = 0;
  std::size_t taken_edges_ = 0;
};

}  // namespace handway::gui
