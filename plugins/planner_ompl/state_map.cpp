#include "state_map.h"

#include <ompl/base/spaces/RealVectorStateProjections.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

namespace handway::planner_ompl {
namespace {

using planning::Configuration;
using RealState = ompl::base::RealVectorStateSpace::StateType;

// The fraction of each periodic coordinate; others as they are.
Eigen::VectorXd within_period(const geometric::Periods& periods, Eigen::VectorXd x) {
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] -= periods.has(i) ? std::floor(x[i]) : 0.0;
  }
  return x;
}

/// Informed samplers take the space's default sampler, not the one that was set. Periodic
/// coordinates are in [0, 1], of which the ends are one place.
class SampledSpace final : public ompl::base::RealVectorStateSpace {
 public:
  explicit SampledSpace(const Eigen::VectorXd& periods)
      : RealVectorStateSpace(static_cast<unsigned int>(periods.size())), periods_(periods) {}

  double distance(const ompl::base::State* a, const ompl::base::State* b) const override {
    return periods_.none() ? RealVectorStateSpace::distance(a, b)
                           : std::sqrt(periods_.squared_distance(values(a), values(b)));
  }

  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double share,
                   ompl::base::State* state) const override {
    if (periods_.none()) {
      RealVectorStateSpace::interpolate(from, to, share, state);
      return;
    }
    const Eigen::VectorXd begin = values(from);
    set(state, begin + share * periods_.difference(begin, values(to)));
  }

  void enforceBounds(ompl::base::State* state) const override {
    set(state, values(state));
    RealVectorStateSpace::enforceBounds(state);
  }

  [[nodiscard]] ompl::base::StateSamplerPtr allocDefaultStateSampler() const override {
    return ssa_ ? ssa_(this) : RealVectorStateSpace::allocDefaultStateSampler();
  }

  // For one or two dimensions OMPL 1.5 takes an identity projection that fails an assertion before
  // its set-up; keeping all components is equivalent.
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

 private:
  [[nodiscard]] Eigen::Map<Eigen::VectorXd> values(const ompl::base::State* state) const {
    return {state->as<StateType>()->values, static_cast<Eigen::Index>(getDimension())};
  }
  void set(ompl::base::State* state, const Eigen::VectorXd& x) const {
    values(state) = within_period(periods_, x);
  }

  geometric::Periods periods_;
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
  const geometric::Periods& periods = coordinates_->periods();
  Eigen::VectorXd kept_periods = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(kept_.size()));
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const int i = kept_[k];
    const bool periodic = periods.has(i);
    kept_periods[static_cast<Eigen::Index>(k)] = periodic ? 1.0 : 0.0;
    bounds.low.push_back(periodic ? 0.0 : lower[i]);
    bounds.high.push_back(periodic ? 1.0 : upper[i]);
  }
  space_ = std::make_shared<SampledSpace>(kept_periods);
  space_->setBounds(bounds);
  start_ = values_of(problem().start);
  goal_ = values_of(problem().goal);
}

Eigen::VectorXd StateMap::values_of(const Configuration& q) const {
  const Eigen::VectorXd x = within_period(coordinates_->periods(), coordinates_->coordinates(q));
  return x.cwiseMax(coordinates_->lower()).cwiseMin(coordinates_->upper())(kept_);
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
