#include "core/search_reach.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <algorithm>

namespace handway::planning {

ReachObserver::ReachObserver(const PlanningProblem& problem, Observer& next)
    : next_(next), model_(problem.model()) {
  start_ = geometric::normalised(model_, problem.start);
  motion_ = geometric::normalised(model_, problem.goal) - start_;
}

void ReachObserver::on_node(const NodeEvent& node) {
  const double progress = std::clamp((geometric::normalised(model_, node.q) - start_).dot(motion_) /
                                         std::max(motion_.squaredNorm(), 1e-12),
                                     0.0, 1.0);
  components_.insert_or_assign(node.id, Component{node.id, progress, progress});
  if (std::vector<int>& ends = ends_[node.search]; ends.size() < 2) {
    ends.push_back(node.id);
  }
  next_.on_node(node);
}

int ReachObserver::root(int node) const {
  int up = node;
  while (components_.at(up).parent != up) {
    Component& here = components_.at(up);
    here.parent = components_.at(here.parent).parent;  // halves the path
    up = here.parent;
  }
  return up;
}

void ReachObserver::on_edge(int from, int to) {
  if (components_.contains(from) && components_.contains(to)) {
    const int a = root(from);
    const int b = root(to);
    if (a != b) {
      Component& whole = components_.at(a);
      Component& part = components_.at(b);
      part.parent = a;
      whole.first = std::min(whole.first, part.first);
      whole.last = std::max(whole.last, part.last);
      whole.nodes += part.nodes;
    }
  }
  next_.on_edge(from, to);
}

std::optional<SearchReach> ReachObserver::reach() const {
  std::optional<SearchReach> reach;
  for (const auto& [search, ends] : ends_) {
    if (ends.size() < 2) {
      continue;
    }
    const Component& start = components_.at(root(ends[0]));
    const Component& goal = components_.at(root(ends[1]));
    if (!reach) {
      reach.emplace();
    }
    reach->from_start = std::max(reach->from_start, start.last);
    reach->from_goal = std::min(reach->from_goal, goal.first);
    reach->start_nodes = std::max(reach->start_nodes, start.nodes);
    reach->goal_nodes = std::max(reach->goal_nodes, goal.nodes);
  }
  if (reach) {
    reach->nodes = components_.size();
  }
  return reach;
}

}  // namespace handway::planning
