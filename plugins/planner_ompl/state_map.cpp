#include "state_map.h"

#include <ompl/base/spaces/RealVectorStateProjections.h>

#include <memory>
#include <numeric>
#include <utility>

namespace handway::planner_ompl {
namespace {

using planning::Configuration;
using RealState = ompl::base::RealVectorStateSpace::StateType;

/// Informed samplers take the space's default sampler, whatever it was told to make.
class SampledSpace final : public ompl::base::RealVectorStateSpace {
 public:
  using RealVectorStateSpace::RealVectorStateSpace;

  [[nodiscard]] ompl::base::StateSamplerPtr allocDefaultStateSampler() const override {
    return ssa_ ? ssa_(this) : RealVectorStateSpace::allocDefaultStateSampler();
  }

  // Of one or two dimensions OMPL 1.5 takes an identity projection that fails an assertion before
  // its set-up; keeping all components is the same.
  void registerProjections() override {
    if (getDimension() > 2) {
      RealVectorStateSpace::registerProjections();
      return;
    }
    std::vector<unsigned int> all(getDimension());
    std::iota(all.begin(), all.end(), 0U);
    registerDefaultProjection(
        std::make_shared<ompl::base::RealVectorOrthogonalProjectionEvaluator>(this, all));
  }
};

}  // namespace

StateMap::StateMap(std::unique_ptr<planning::StateSpace> coordinates)
    : coordinates_(std::move(coordinates)) {
  constexpr double kLeastExtent = 1e-9;
  const Eigen::VectorXd& lower = coordinates_->lower();
  const Eigen::VectorXd& upper = coordinates_->upper();
  for (int i = 0; i < coordinates_->dimension(); ++i) {
    if (upper[i] - lower[i] > kLeastExtent) {
      kept_.push_back(i);
    }
  }
  ompl::base::RealVectorBounds bounds(static_cast<unsigned int>(kept_.size()));
  bounds.low.clear();
  bounds.high.clear();
  for (const int i : kept_) {
    bounds.low.push_back(lower[i]);
    bounds.high.push_back(upper[i]);
  }
  space_ = std::make_shared<SampledSpace>(static_cast<unsigned int>(kept_.size()));
  space_->setBounds(bounds);
  start_ = values_of(problem().start);
  goal_ = values_of(problem().goal);
}

Eigen::VectorXd StateMap::values_of(const Configuration& q) const {
  return coordinates_->coordinates(q)
      .cwiseMax(coordinates_->lower())
      .cwiseMin(coordinates_->upper())(kept_);
}

void StateMap::write(const Configuration& q, ompl::base::State* state) const {
  Eigen::Map<Eigen::VectorXd>(state->as<RealState>()->values, start_.size()) = values_of(q);
}

Configuration StateMap::read(const ompl::base::State* state) const {
  const Eigen::Map<const Eigen::VectorXd> values(state->as<RealState>()->values, start_.size());
  if (values == start_) {
    return problem().start;
  }
  if (values == goal_) {
    return problem().goal;
  }
  Eigen::VectorXd x = coordinates_->lower();
  x(kept_) = values;
  return coordinates_->configuration(x, problem().start).value();
}

}  // namespace handway::planner_ompl
