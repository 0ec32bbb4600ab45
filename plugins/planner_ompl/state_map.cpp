#include "state_map.h"

#include "draws.h"

#include <ompl/base/spaces/RealVectorStateProjections.h>

#include <memory>
#include <numeric>
#include <vector>

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

StateMap::~StateMap() = default;

void StateMap::make_space(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  lower_ = lower;
  upper_ = upper;
  ompl::base::RealVectorBounds bounds(static_cast<unsigned int>(lower.size()));
  bounds.low.assign(lower.begin(), lower.end());
  bounds.high.assign(upper.begin(), upper.end());
  space_ = std::make_shared<SampledSpace>(static_cast<unsigned int>(lower.size()));
  space_->setBounds(bounds);
  start_ = coordinates(problem_.start).cwiseMax(lower_).cwiseMin(upper_);
  goal_ = coordinates(problem_.goal).cwiseMax(lower_).cwiseMin(upper_);
}

void StateMap::draw_from(Draws& draws) {
  space_->setStateSamplerAllocator(
      [this, &draws](const ompl::base::StateSpace* of) { return make_sampler(of, *this, draws); });
}

void StateMap::write(const Configuration& q, ompl::base::State* state) const {
  Eigen::Map<Eigen::VectorXd>(state->as<RealState>()->values, lower_.size()) =
      coordinates(q).cwiseMax(lower_).cwiseMin(upper_);
}

Configuration StateMap::read(const ompl::base::State* state) const {
  const Eigen::Map<const Eigen::VectorXd> values(state->as<RealState>()->values, lower_.size());
  if (values == start_) {
    return problem_.start;
  }
  if (values == goal_) {
    return problem_.goal;
  }
  return configuration(values);
}

}  // namespace handway::planner_ompl
