#include "planners/search_reach.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <algorithm>

namespace handway::planning {

ReachObserver::ReachObserver(const PlanningProblem& problem, Observer& next)
    : next_(next), problem_(problem) {}

// Only searches announce nodes: start and goal have been found valid by then.
void ReachObserver::on_node(const NodeEvent& node) {
  const auto normalised = [&](const geometric::Configuration& q) {
    return geometric::normalised(problem_.model(), q);
  };
  const Eigen::VectorXd start = normalised(problem_.start);
  const Eigen::VectorXd motion = normalised(problem_.goal) - start;
  const double progress = std::clamp(
      (normalised(node.q) - start).dot(motion) / std::max(motion.squaredNorm(), 1e-12), 0.0, 1.0);
  const auto q = std::make_shared<const geometric::Configuration>(node.q);
  components_.insert_or_assign(node.id, Component{node.id, progress, progress, q, q});
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
      if (part.first < whole.first) {
        whole.first = part.first;
        whole.first_q = part.first_q;
      }
      if (part.last > whole.last) {
        whole.last = part.last;
        whole.last_q = part.last_q;
      }
      part.first_q.reset();
      part.last_q.reset();
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
    if (start.last > reach->from_start || reach->farthest_from_start.size() == 0) {
      reach->from_start = start.last;
      reach->farthest_from_start = *start.last_q;
    }
    if (goal.first < reach->from_goal || reach->farthest_from_goal.size() == 0) {
      reach->from_goal = goal.first;
      reach->farthest_from_goal = *goal.first_q;
    }
    reach->start_nodes = std::max(reach->start_nodes, start.nodes);
    reach->goal_nodes = std::max(reach->goal_nodes, goal.nodes);
  }
  if (reach) {
    reach->nodes = components_.size();
  }
  return reach;
}

}  // namespace handway::planning
