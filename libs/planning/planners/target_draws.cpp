#include "planners/target_draws.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "planners/hand_arm_space.h"

#include <algorithm>
#include <cmath>

namespace handway::planning {
namespace {

using sampling::RandomStream;

// Radii of the balls around start and goal: what is a move of a finger's width
// and what takes the hand out of any grasp.
constexpr double kSmallestBall = 0.005;
constexpr double kSmallestExpansion = 0.02;
constexpr double kLargestBall = 0.3;

constexpr double kOnward = 0.5;  // share of expansions that go on along the edge to the node

// Every size is as likely as any other.
double length_from(double smallest, RandomStream& draw) {
  return smallest * std::pow(kLargestBall / smallest, draw.uniform());
}

}  // namespace

TargetDraws::TargetDraws(const PlanningProblem& problem, const TargetRegion& region, HandSpace hand,
                         const SearchSpace& space, std::uint64_t seed)
    : problem_(problem),
      region_(region),
      space_(space),
      in_regions_(hand == HandSpace::kPrincipalDirections),
      basis_(hand_basis(problem, hand)),
      draws_(seed) {}

TargetDraws::Target TargetDraws::draw(int sample, int end, int failures) const {
  RandomStream draw = draws_.fork(static_cast<std::uint64_t>(sample));
  if (!in_regions_) {
    return {draw.uniform(static_cast<int>(problem_.arm.size() + problem_.hand.size())), 0, 0.0};
  }
  const int axes =
      std::min(basis_.dimension(), static_cast<int>(basis_.free_joints.size()) + 1 + failures);
  Target target = draw.uniform() < region_.near_ends ? draw_near_end(end, axes, draw)
                                                     : draw_in_corridor(sample, axes, draw);
  target.pmds = std::max(0, axes - static_cast<int>(basis_.free_joints.size()));
  return target;
}

TargetDraws::Target TargetDraws::draw_in_corridor(int sample, int axes, RandomStream& draw) const {
  const double widths = std::floor(static_cast<double>(sample) / region_.samples_per_width);
  const double rho =
      std::min(region_.rho_max, region_.rho_a * std::pow(region_.rho_growth, widths));
  const double step = draw.uniform();
  const Eigen::VectorXd arm = draw.uniform(space_.arm_draws());
  const Eigen::VectorXd posture = sampling::map_to_posture(basis_, draw.uniform(axes));
  return {space_.draw(step, rho, arm, posture), 0, rho};
}

// In half of the draws the hand keeps its posture: it holds on to what is between its fingers.
TargetDraws::Target TargetDraws::draw_near_end(int end, int axes, RandomStream& draw) const {
  const double rho = length_from(kSmallestBall, draw);
  const bool hand_moves = draw.uniform() < 0.5;
  const Eigen::VectorXd arm = draw.uniform(space_.arm_draws());
  Eigen::VectorXd posture = geometric::normalised(
      problem_.model(), end == 0 ? problem_.start : problem_.goal)(problem_.hand);
  if (hand_moves) {
    posture += std::min(1.0, rho / kLargestBall) *
               (sampling::map_to_posture(basis_, draw.uniform(axes)) - posture);
  }
  return {space_.draw(end, rho, arm, posture), 0, rho};
}

// Of length 1; of the arm alone or of the hand alone.
Eigen::VectorXd TargetDraws::direction(Eigen::Index size, RandomStream& draw) const {
  const auto hand_size = static_cast<Eigen::Index>(problem_.hand.size());
  const Eigen::Index arm_size = size - hand_size;
  const bool moves_arm = hand_size == 0 || (arm_size > 0 && draw.uniform() < 0.5);
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(size);
  if (moves_arm) {
    direction.head(arm_size) = 2.0 * draw.uniform(static_cast<int>(arm_size)).array() - 1.0;
  } else {
    const auto posture = [&] {
      return sampling::map_to_posture(basis_, draw.uniform(basis_.dimension()));
    };
    direction.tail(hand_size) = posture() - posture();
  }
  return direction.normalized();
}

TargetDraws::Target TargetDraws::draw_near_node(int sample, const Eigen::VectorXd& from,
                                                const Eigen::VectorXd& parent) const {
  RandomStream draw = draws_.fork(static_cast<std::uint64_t>(sample)).fork(2);
  const Eigen::VectorXd aside = direction(from.size(), draw);
  const Eigen::VectorXd edge = from - parent;
  const bool onward = !edge.isZero() && draw.uniform() < kOnward;
  const Eigen::VectorXd step =
      onward ? ((0.5 + 2.0 * draw.uniform()) * edge + draw.uniform() * edge.norm() * aside).eval()
             : (length_from(kSmallestExpansion, draw) * aside).eval();
  const int pmds = basis_.dimension() - static_cast<int>(basis_.free_joints.size());
  return {space_.within_limits(from + step), pmds, 0.0};
}

Eigen::VectorXd TargetDraws::held(Eigen::VectorXd target, const Eigen::VectorXd& from, int sample,
                                  double share) const {
  if (!in_regions_) {
    return target;
  }
  const double u = draws_.fork(static_cast<std::uint64_t>(sample)).fork(1).uniform();
  const auto hand_size = static_cast<Eigen::Index>(basis_.joints.size());
  const Eigen::Index arm_size = target.size() - hand_size;
  if (u < 0.5 * share) {
    target.tail(hand_size) = from.tail(hand_size);
  } else if (u < share) {
    target.head(arm_size) = from.head(arm_size);
  }
  return target;
}

}  // namespace handway::planning
