#include "handway/planning/queries/region_draws.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/planners/auto_planner.h"
#include "handway/planning/queries/fingertips.h"
#include "handway/planning/spaces/hand_arm_region.h"
#include "handway/sampling/sequences/random_stream.h"

#include <algorithm>
#include <cmath>

namespace handway::planning {
namespace {

using geometric::Pose;
using geometric::RobotModel;

constexpr int kMotionPieces = 64;
constexpr int kMostCentres = 65;
constexpr double kMostPalms = 0.9;  // share within RegionDraws::palm_reach

double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  const auto at =
      values.begin() + std::lround(std::floor(share * static_cast<double>(values.size() - 1)));
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace

std::optional<SamplingRegion> first_region(Planner& planner, int directions) {
  SamplingRegion region;
  region.pmds = directions;
  if (!planner.capabilities().uses_pmds) {
    region.hand = HandSpace::kAllJoints;
  }
  const std::vector<Parameter> parameters = planner.parameters();
  const Parameter* rho = parameter_called(parameters, "rho_a");
  if (!rho) {
    return planner.capabilities().uses_pmds ? std::optional(region) : std::nullopt;
  }
  region.rho_a = *std::get<double*>(rho->value);
  if (const Parameter* corridor = parameter_called(parameters, "corridor")) {
    region.corridor = static_cast<CorridorForm>(*std::get<ChoiceValue>(corridor->value).index);
  }
  if (const Parameter* pmds = parameter_called(parameters, "max_pmds")) {
    region.pmds = std::min(directions, *std::get<int*>(pmds->value));
  }
  return region;
}

std::vector<SamplingRegion> first_regions(Planner& planner, int directions) {
  std::vector<SamplingRegion> regions;
  if (const std::optional<SamplingRegion> first = first_region(planner, directions)) {
    regions.push_back(*first);
  }
  if (const auto* race = dynamic_cast<const AutoPlanner*>(&planner)) {
    const SamplingRegion common = regions.front();
    regions.clear();
    for (const TargetRegion& region : race->regions(true)) {
      regions.push_back(common);
      regions.back().corridor = static_cast<CorridorForm>(region.corridor);
      regions.back().rho_a = region.rho_a;
    }
  }
  return regions;
}

RegionPreview::RegionPreview(const PlanningProblem& problem, int palm)
    : problem_(problem), palm_(palm) {
  for (const int link : fingertips(problem.model(), problem.hand)) {
    tips_.push_back({link, middle_of(problem.model().link(link))});
  }
}

RegionDraws RegionPreview::draw(const SamplingRegion& region, int configurations,
                                const std::stop_token& stop) const {
  if (region.hand == HandSpace::kPrincipalDirections && !problem_.basis) {
    throw geometric::InputError({problem_.scene->file.string(), "hand_basis", "nothing",
                                 "a PMD basis", "Name one in the scene"});
  }
  const HandArmRegion hand_arm(problem_, region.hand, region.corridor);
  const CorridorSpace& space = hand_arm.space();
  const RobotModel& model = problem_.model();
  const Pose& X_WB = problem_.scene->robots.front().X_WB;
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  const auto place = [&](int link, const Eigen::Vector3d& p_L) -> Eigen::Vector3d {
    return X_WB * X_BL[static_cast<std::size_t>(link)] * p_L;
  };
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(space.corridor_dimension(), 0.5);
  const auto on_motion = [&](double step) -> std::optional<Eigen::Vector3d> {
    const std::optional<Configuration> q = hand_arm.arm_at(step, 0.0, middle);
    if (!q) {
      return std::nullopt;
    }
    model.forward_kinematics(*q, X_BL);
    return place(palm_, Eigen::Vector3d::Zero());
  };

  RegionDraws result;
  const int pieces = space.steps(region.rho_a);
  result.hypercubes = pieces + 1;
  for (int i = 0; i <= pieces && result.hypercubes <= kMostCentres; ++i) {
    if (const auto palm = on_motion(static_cast<double>(i) / pieces)) {
      result.centres.push_back(*palm);
    }
  }
  for (int i = 0; i <= kMotionPieces; ++i) {
    if (const auto palm = on_motion(static_cast<double>(i) / kMotionPieces)) {
      result.motion.push_back(*palm);
    }
  }
  const int free_joints = static_cast<int>(hand_arm.basis().free_joints.size());
  const int axes = region.hand == HandSpace::kAllJoints
                       ? hand_arm.basis().dimension()
                       : std::min(hand_arm.basis().dimension(), free_joints + region.pmds);
  std::vector<double> distances;
  for (int i = 0; i < configurations && !stop.stop_requested(); ++i) {
    sampling::RandomStream draw = sampling::RandomStream(1).fork(static_cast<std::uint64_t>(i));
    const double step = draw.uniform();
    const auto arm = hand_arm.arm_at(step, region.rho_a, draw.uniform(space.corridor_dimension()));
    const auto centre = on_motion(step);
    if (!arm || !centre) {
      continue;
    }
    model.forward_kinematics(hand_arm.with_hand(*arm, draw.uniform(axes)), X_BL);
    result.palms.push_back(place(palm_, Eigen::Vector3d::Zero()));
    distances.push_back((result.palms.back() - *centre).norm());
    for (const Tip& tip : tips_) {
      result.fingertips.push_back(place(tip.link, tip.p_LTip));
    }
  }
  result.palm_reach = quantile(std::move(distances), kMostPalms);
  return result;
}

}  // namespace handway::planning
