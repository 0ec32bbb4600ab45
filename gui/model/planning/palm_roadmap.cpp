#include "model/planning/palm_roadmap.h"

#include <utility>

namespace handway::gui {

RoadmapWatch::RoadmapWatch(const planning::PlanningProblem& problem, int palm_link)
    : RoadmapRecorder(PalmRoadmap::kMostNodes),
      problem_(problem),
      palm_link_(palm_link),
      X_BL_(static_cast<std::size_t>(problem.model().link_count())) {}

void RoadmapWatch::on_node(const planning::NodeEvent& node) {
  RoadmapRecorder::on_node(node);
  if (palms_.size() < roadmap().nodes.size()) {
    palms_.push_back(palm_at(node.q));
  }
}

Eigen::Vector3d RoadmapWatch::palm_at(const geometric::Configuration& q) {
  problem_.model().forward_kinematics(q, X_BL_);
  return problem_.scene->robots.front().X_WB *
         X_BL_[static_cast<std::size_t>(palm_link_)].translation();
}

bool RoadmapWatch::has_news() const {
  return roadmap().nodes.size() != taken_nodes_ || roadmap().edges.size() != taken_edges_;
}

SharedRoadmap RoadmapWatch::take() {
  taken_nodes_ = roadmap().nodes.size();
  taken_edges_ = roadmap().edges.size();
  auto result = std::make_shared<PalmRoadmap>();
  result->roadmap = roadmap().of_winner();
  for (std::size_t i = 0; i < palms_.size(); ++i) {
    if (!roadmap().winner || roadmap().nodes[i].search == *roadmap().winner) {
      result->palms.push_back(palms_[i]);
    }
  }
  return result;
}

}  // namespace handway::gui
