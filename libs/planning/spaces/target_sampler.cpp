#include "handway/planning/spaces/target_sampler.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <algorithm>
#include <cmath>

namespace handway::planning {
namespace {

// Radii of the balls around start and goal: from a move of a finger's width to one that takes the
// hand out of any grasp.
constexpr double kSmallestBall = 0.005;
constexpr double kSmallestExpansion = 0.02;
constexpr double kLargestBall = 0.3;

constexpr double kWidenedInVain = 2.0;  // times, before samples are drawn anywhere

constexpr double kOnward = 0.5;  // share of expansions that go on along the edge to the node

// All sizes are equally likely. @param u uniform in [0, 1].
double length_from(double smallest, double u) {
  return smallest * std::pow(kLargestBall / smallest, u);
}

}  // namespace

TargetSampler::TargetSampler(PlanningContext& context, const TargetRegion& region, HandSpace hand,
                             std::uint64_t seed)
    : problem_(context.problem()),
      settings_(region),
      in_regions_(hand == HandSpace::kPrincipalDirections),
      region_(problem_, hand, static_cast<CorridorForm>(region.corridor)),
      planned_(problem_.planned_joints()),
      stream_(seed) {
  constexpr int kChoices = 3;  // of corridor or end, where in it, and whether the hand moves
  const int dimension = in_regions_
                            ? kChoices + space().corridor_dimension() + region_.basis().dimension()
                            : space().dimension();
  points_ = context.make_sampler(dimension, seed, [this, &context](const Eigen::VectorXd& u) {
    Eigen::VectorXd x = target(u).coordinates;
    const std::optional<Configuration> q =
        configuration(x, draw_.end == 0 ? problem_.start : problem_.goal);
    return q && !context.validator().collision(*q);
  });
}

TargetSampler::~TargetSampler() = default;

std::optional<Configuration> TargetSampler::configuration(Eigen::VectorXd& x,
                                                          const Configuration& reference) const {
  const auto& constraints = problem_.checker->world().constraints();
  std::optional<Configuration> q = space().configuration(x, reference);
  if (!q || constraints.empty()) {
    return q;
  }
  std::optional<Configuration> kept =
      geometric::project_onto_constraints(problem_.model(), constraints, planned_, *q);
  if (kept && *kept != *q) {
    x = space().coordinates(*kept);
  }
  return kept;
}

TargetSampler::Target TargetSampler::draw(std::uint64_t sample, int end, int failures) {
  const auto free_joints = static_cast<int>(region_.basis().free_joints.size());
  const int pmds = std::min(
      {static_cast<int>(region_.basis().directions.size()), settings_.max_pmds, failures + 1});
  draw_ = {sample, end, free_joints + pmds};
  return target(points_->point(sample));
}

TargetSampler::Target TargetSampler::target(const Eigen::VectorXd& u) const {
  if (!in_regions_) {
    return {in_bounds(u), 0, 0.0};
  }
  const double share = times_widened() < kWidenedInVain ? 0.0 : settings_.anywhere;
  Target target = u[0] < share                                           ? anywhere(u)
                  : (u[0] - share) / (1.0 - share) < settings_.near_ends ? near_end(u)
                                                                         : in_corridor(u);
  target.pmds = draw_.axes - static_cast<int>(region_.basis().free_joints.size());
  return target;
}

double TargetSampler::times_widened() const {
  return std::floor(static_cast<double>(draw_.sample) / settings_.samples_per_width);
}

// Maps `u` to the bounds of the first coordinates. Joints without limits go around once.
Eigen::VectorXd TargetSampler::in_bounds(const Eigen::VectorXd& u) const {
  const Eigen::VectorXd lower = space().lower().head(u.size());
  const Eigen::VectorXd range = space().upper().head(u.size()) - lower;
  return range.array().isFinite().select(lower + u.cwiseProduct(range), u);
}

TargetSampler::Target TargetSampler::anywhere(const Eigen::VectorXd& u) const {
  const int arm_size = space().corridor_dimension();
  Target target{Eigen::VectorXd(space().dimension()), 0, 0.0};
  target.coordinates << in_bounds(u.segment(2, arm_size)),
      sampling::map_to_posture(region_.basis(), u.segment(2 + arm_size, draw_.axes));
  return target;
}

TargetSampler::Target TargetSampler::in_corridor(const Eigen::VectorXd& u) const {
  const double rho = std::min(settings_.rho_max,
                              settings_.rho_a * std::pow(settings_.rho_growth, times_widened()));
  const int arm_size = space().corridor_dimension();
  Target target{Eigen::VectorXd(space().dimension()), 0, rho};
  target.coordinates << space().corridor_point(u[1], rho, u.segment(2, arm_size)),
      sampling::map_to_posture(region_.basis(), u.segment(2 + arm_size, draw_.axes));
  return target;
}

// In half of the samples the hand keeps its posture, as if it held an object.
TargetSampler::Target TargetSampler::near_end(const Eigen::VectorXd& u) const {
  const double rho = length_from(kSmallestBall, u[1]);
  const bool hand_moves = u[2] < 0.5;
  const int arm_size = space().corridor_dimension();
  Eigen::VectorXd posture = geometric::normalised(
      problem_.model(), draw_.end == 0 ? problem_.start : problem_.goal)(problem_.joints.hand);
  if (hand_moves) {
    posture +=
        std::min(1.0, rho / kLargestBall) *
        (sampling::map_to_posture(region_.basis(), u.segment(3 + arm_size, draw_.axes)) - posture);
  }
  Target target{Eigen::VectorXd(space().dimension()), 0, rho};
  target.coordinates << space().corridor_point(draw_.end, rho, u.segment(3, arm_size)), posture;
  return target;
}

// Unit vector that moves the arm alone or the hand alone.
Eigen::VectorXd TargetSampler::direction(Eigen::Index size, sampling::RandomStream& draw) const {
  const auto hand_size = static_cast<Eigen::Index>(problem_.joints.hand.size());
  const Eigen::Index arm_size = size - hand_size;
  const bool moves_arm = hand_size == 0 || (arm_size > 0 && draw.uniform() < 0.5);
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(size);
  if (moves_arm) {
    direction.head(arm_size) = 2.0 * draw.uniform(static_cast<int>(arm_size)).array() - 1.0;
  } else {
    const sampling::PmdBasis& basis = region_.basis();
    const auto posture = [&] {
      return sampling::map_to_posture(basis, draw.uniform(basis.dimension()));
    };
    const Eigen::VectorXd from = posture();
    direction.tail(hand_size) = posture() - from;
  }
  return direction.normalized();
}

TargetSampler::Target TargetSampler::draw_near_node(std::uint64_t sample,
                                                    const Eigen::VectorXd& from,
                                                    const Eigen::VectorXd& parent) const {
  sampling::RandomStream draw = stream_.fork(sample).fork(2);
  const Eigen::VectorXd aside = direction(from.size(), draw);
  const Eigen::VectorXd edge = from - parent;
  const bool onward = !edge.isZero() && draw.uniform() < kOnward;
  const Eigen::VectorXd step =
      onward ? ((0.5 + 2.0 * draw.uniform()) * edge + draw.uniform() * edge.norm() * aside).eval()
             : (length_from(kSmallestExpansion, draw.uniform()) * aside).eval();
  return {(from + step).cwiseMax(space().lower()).cwiseMin(space().upper()),
          static_cast<int>(region_.basis().directions.size()), 0.0};
}

Eigen::VectorXd TargetSampler::held(Eigen::VectorXd target, const Eigen::VectorXd& from,
                                    std::uint64_t sample, double share) const {
  if (!in_regions_) {
    return target;
  }
  const double u = stream_.fork(sample).fork(1).uniform();
  const auto hand_size = static_cast<Eigen::Index>(problem_.joints.hand.size());
  const Eigen::Index arm_size = target.size() - hand_size;
  if (u < 0.5 * share) {
    target.tail(hand_size) = from.tail(hand_size);
  } else if (u < share) {
    target.head(arm_size) = from.head(arm_size);
  }
  return target;
}

geometric::BoundParameter corridor_parameter(int& value) {
  return {
      "corridor", "Corridor", "",
      "Corridor around the straight motion of the arm's joints (joint) or of its tool (cartesian).",
      geometric::BoundChoice{&value, {"joint", "cartesian"}}};
}

void append_region_parameters(std::vector<geometric::BoundParameter>& list, TargetRegion& region) {
  list.push_back({"near_ends", "Samples near the ends", "",
                  "Share of samples drawn around start and goal.", &region.near_ends, 0.0, 1.0});
  list.push_back({"rho_a", "Corridor half-width ρₐ", "",
                  "Initial half-width of the arm's corridor, in joints normalised to [0, 1].",
                  &region.rho_a, 1e-5, 1.0});
  list.push_back({"rho_max", "Largest ρₐ", "", "Largest half-width of the corridor.",
                  &region.rho_max, 1e-5, 1.0});
  list.push_back({"rho_growth", "Widening factor", "", "Factor by which the corridor grows.",
                  &region.rho_growth, 1.0, 100.0});
  list.push_back({"samples_per_width", "Samples per width", "",
                  "Number of samples before the corridor grows.", &region.samples_per_width, 1,
                  1000000});
}

}  // namespace handway::planning
