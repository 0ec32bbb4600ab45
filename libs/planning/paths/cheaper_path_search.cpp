#include "paths/cheaper_path_search.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kLongestStep = 0.3;     // longest step of a tree, in joints normalised to [0, 1]
constexpr double kProbeSpacing = 0.05;   // of configurations checked before certification
constexpr double kSmallestAside = 0.02;  // away from the guide
constexpr double kLargestAside = 0.6;
constexpr int kMostDraws = 20;                      // samples until one is below the bound
constexpr std::uint64_t kEdgeChecksAllowed = 2000;  // an edge that needs more is refused
constexpr double kLeastLength = 1e-9;               // length of a path
constexpr double kDropped = std::numeric_limits<double>::infinity();

// For paths of this length the means of ObjectiveWeights are sums.
AdditiveCost cost_at_length(const ObjectiveWeights& weights, double length) {
  return {weights.length, weights.human_likeness / length, weights.clearance / length,
          weights.duration};
}

}  // namespace

CheaperPathSearch::CheaperPathSearch(PlanningContext& context, const ObjectiveWeights& weights,
                                     const Path& guide, double share, std::uint64_t seed)
    : context_(context),
      objective_(context.problem(), weights),
      checks_before_(context.statistics().checks()),
      random_(seed),
      planned_(context.problem().planned_joints()) {
  std::ranges::transform(guide.waypoints, std::back_inserter(guide_),
                         [&](const Configuration& q) { return objective_.point(q); });
  trees_[0].push_back({guide_.front(), -1, 0.0, true});
  trees_[1].push_back({guide_.back(), -1, 0.0, true});
  MotionSums sum;
  for (std::size_t i = 0; i + 1 < guide_.size(); ++i) {
    sum.add(objective_.measure(guide_[i], guide_[i + 1]));
  }
  cost_ = cost_at_length(weights, std::max(sum.length, kLeastLength));
  bound_ = share * cost_.of(sum);
}

std::optional<Path> CheaperPathSearch::step() {
  const int tree = samples_++ % 2;
  const std::optional<Point> target = draw();
  if (!target) {
    return std::nullopt;
  }
  const Point& root = trees_[static_cast<std::size_t>(tree)].front().point;
  const Point& other_root = trees_[static_cast<std::size_t>(1 - tree)].front().point;
  const double beyond = least(*target, other_root);
  const double cheapest = least(root, *target);
  const double allowed = cheapest + random_.uniform() * (bound_ - beyond - cheapest);
  const std::optional<int> from = nearest(tree, *target, allowed);
  if (!from) {
    return std::nullopt;
  }
  const std::optional<int> reached = grow(tree, *from, *target, beyond);
  if (!reached) {
    return std::nullopt;
  }
  const std::optional<Meeting> meeting = connect(tree, *reached);
  return meeting && verify(*meeting) ? std::optional(path_through(*meeting)) : std::nullopt;
}

// No path between the points costs less: a hand may be in the subspace, and obstacles far away.
double CheaperPathSearch::least(const Point& from, const Point& to) const {
  const double duration =
      cost_.duration > 0.0 ? least_duration(context_.problem().model(), from.q, to.q) : 0.0;
  return cost_.length * from.distance_to(to) + cost_.duration * duration;
}

std::optional<Objective::Point> CheaperPathSearch::draw() {
  const bool has_subspace = context_.problem().basis && cost_.outside > 0.0;
  for (int trial = 0; trial < kMostDraws; ++trial) {
    const bool is_informed = cost_.length > 0.0 && random_.uniform() < 0.5;
    Point point = objective_.point_of_joints(geometric::clamped_to_range(
        context_.problem().model(), is_informed ? draw_in_ellipsoid() : draw_near_guide()));
    if (has_subspace && random_.uniform() < 0.5) {
      point = objective_.towards_subspace(point, 1.0);
    }
    if (least(guide_.front(), point) + least(point, guide_.back()) < bound_) {
      return point;
    }
  }
  return std::nullopt;
}

// Uniform among the joints through which a path from start to goal can be as short as the bound.
Eigen::VectorXd CheaperPathSearch::draw_in_ellipsoid() {
  const Eigen::VectorXd start = guide_.front().joints(planned_);
  const Eigen::VectorXd goal = guide_.back().joints(planned_);
  const auto size = static_cast<int>(planned_.size());
  const double distance = (goal - start).norm();
  const double longest = std::max(distance, bound_ / cost_.length);
  Eigen::VectorXd ball = random_.normal(size).normalized();
  ball *= 0.5 * std::pow(random_.uniform(), 1.0 / size);
  const double along = longest;
  const double across = std::sqrt(longest * longest - distance * distance);
  Eigen::VectorXd offset = across * ball;
  if (distance > 0.0) {
    const Eigen::VectorXd axis = (goal - start) / distance;
    offset += (along - across) * ball.dot(axis) * axis;
  }
  Eigen::VectorXd joints = guide_.front().joints;
  joints(planned_) = 0.5 * (start + goal) + offset;
  return joints;
}

// Beside a place of the guide, with all joints, those of the arm or the hand, or one of them moved.
Eigen::VectorXd CheaperPathSearch::draw_near_guide() {
  const PlanningProblem& problem = context_.problem();
  const std::size_t edge = random_.below(guide_.size() - 1);
  const Point& from = guide_[edge];
  Eigen::VectorXd joints =
      from.joints + random_.uniform() * (guide_[edge + 1].joints - from.joints);
  const std::array<geometric::JointIndices, 4> parts = {
      planned_,
      problem.joints.arm,
      problem.joints.hand,
      {planned_[static_cast<std::size_t>(random_.below(planned_.size()))]}};
  const geometric::JointIndices& part = parts[random_.below(parts.size())];
  if (!part.empty()) {
    const double size =
        kSmallestAside * std::pow(kLargestAside / kSmallestAside, random_.uniform());
    joints(part) += size * random_.normal(static_cast<int>(part.size())).normalized();
  }
  return joints;
}

/// The nearest node that reaches `to` at a cost of at most `most`.
std::optional<int> CheaperPathSearch::nearest(int tree, const Point& to, double most) const {
  const Tree& nodes = trees_[static_cast<std::size_t>(tree)];
  std::optional<int> nearest;
  double least_distance = kDropped;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].cost > most) {
      continue;
    }
    const double distance = nodes[i].point.distance_to(to);
    if (distance < least_distance && nodes[i].cost + least(nodes[i].point, to) <= most) {
      least_distance = distance;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

/// Adds a node at `target`, or a step towards it, if the motion looks free and leaves enough of the
/// bound. @param beyond the least cost from the target to the other root.
std::optional<int> CheaperPathSearch::grow(int tree, int from, const Point& target, double beyond) {
  Tree& nodes = trees_[static_cast<std::size_t>(tree)];
  const Point begin = nodes[static_cast<std::size_t>(from)].point;
  const double length = begin.distance_to(target);
  if (length <= 0.0) {
    return std::nullopt;
  }
  const double share = std::min(1.0, kLongestStep / length);
  Point end =
      share < 1.0
          ? objective_.point_of_joints(begin.joints + share * (target.joints - begin.joints))
          : target;
  const double cost =
      nodes[static_cast<std::size_t>(from)].cost + cost_.of(objective_.measure(begin, end));
  if (cost + least(end, target) + beyond >= bound_ || context_.validator().collision(end.q) ||
      !passable(begin, end)) {
    return std::nullopt;
  }
  nodes.push_back({std::move(end), from, cost, false});
  return static_cast<int>(nodes.size()) - 1;
}

bool CheaperPathSearch::passable(const Point& from, const Point& to) {
  return context_.validator().edge_plausible(
      from.q, to.q, static_cast<int>(from.distance_to(to) / kProbeSpacing));
}

// Extends the other tree towards `reached` until it is there or a step is not free.
std::optional<CheaperPathSearch::Meeting> CheaperPathSearch::connect(int tree, int reached) {
  const Tree& own = trees_[static_cast<std::size_t>(tree)];
  const Tree& others = trees_[static_cast<std::size_t>(1 - tree)];
  const Node target = own[static_cast<std::size_t>(reached)];
  std::optional<int> at = nearest(1 - tree, target.point, bound_ - target.cost);
  while (at && !context_.interruption()) {
    const Node& node = others[static_cast<std::size_t>(*at)];
    if (node.point.distance_to(target.point) <= kLongestStep) {
      const double bridge = cost_.of(objective_.measure(node.point, target.point));
      const double cost = node.cost + bridge + target.cost;
      const std::array<int, 2> met =
          tree == 0 ? std::array{reached, *at} : std::array{*at, reached};
      return cost < bound_ && passable(node.point, target.point) ? std::optional(Meeting{met, cost})
                                                                 : std::nullopt;
    }
    at = grow(1 - tree, *at, target.point, target.cost);
  }
  return std::nullopt;
}

bool CheaperPathSearch::verify(const Meeting& meeting) {
  const Point& from = trees_[0][static_cast<std::size_t>(meeting.nodes[0])].point;
  const Point& to = trees_[1][static_cast<std::size_t>(meeting.nodes[1])].point;
  return context_.validator().edge_free(from.q, to.q, kEdgeChecksAllowed) &&
         verify_branch(0, meeting.nodes[0]) && verify_branch(1, meeting.nodes[1]);
}

// Certifies the edges from `node` to the root, and drops what is behind one that is not free.
bool CheaperPathSearch::verify_branch(int tree, int node) {
  Tree& nodes = trees_[static_cast<std::size_t>(tree)];
  for (int at = node; nodes[static_cast<std::size_t>(at)].parent >= 0;) {
    Node& child = nodes[static_cast<std::size_t>(at)];
    const Node& parent = nodes[static_cast<std::size_t>(child.parent)];
    if (!child.is_certain) {
      if (!context_.validator().edge_free(parent.point.q, child.point.q, kEdgeChecksAllowed)) {
        drop(tree, at);
        return false;
      }
      child.is_certain = true;
    }
    at = child.parent;
  }
  return true;
}

// Parents come before their children.
void CheaperPathSearch::drop(int tree, int node) {
  Tree& nodes = trees_[static_cast<std::size_t>(tree)];
  nodes[static_cast<std::size_t>(node)].cost = kDropped;
  for (auto i = static_cast<std::size_t>(node) + 1; i < nodes.size(); ++i) {
    const int parent = nodes[i].parent;
    if (parent >= node && std::isinf(nodes[static_cast<std::size_t>(parent)].cost)) {
      nodes[i].cost = kDropped;
    }
  }
}

Path CheaperPathSearch::path_through(const Meeting& meeting) const {
  std::array<std::vector<Configuration>, 2> branches;
  for (std::size_t tree = 0; tree < 2; ++tree) {
    for (int at = meeting.nodes[tree]; at >= 0;
         at = trees_[tree][static_cast<std::size_t>(at)].parent) {
      branches[tree].push_back(trees_[tree][static_cast<std::size_t>(at)].point.q);
    }
  }
  Path path;
  path.waypoints.assign(branches[0].rbegin(), branches[0].rend());
  path.waypoints.insert(path.waypoints.end(), branches[1].begin(), branches[1].end());
  return path;
}

}  // namespace handway::planning
