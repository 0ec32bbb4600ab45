#include "draws.h"

#include "handway/sampling/sequences/random_stream.h"

#include <limits>

namespace handway::planner_ompl {
namespace {

using ompl::base::State;

class CountedSampler final : public ompl::base::RealVectorStateSampler {
 public:
  CountedSampler(const ompl::base::StateSpace* space, Draws& draws)
      : RealVectorStateSampler(space), draws_(draws) {
    rng_.setLocalSeed(draws.next_seed());
  }

  void sampleUniform(State* state) override {
    draws_.count();
    RealVectorStateSampler::sampleUniform(state);
  }
  void sampleUniformNear(State* state, const State* near, double distance) override {
    draws_.count();
    RealVectorStateSampler::sampleUniformNear(state, near, distance);
  }
  void sampleGaussian(State* state, const State* mean, double deviation) override {
    draws_.count();
    RealVectorStateSampler::sampleGaussian(state, mean, deviation);
  }

 private:
  Draws& draws_;
};

class CountedGoal final : public ompl::base::GoalState {
 public:
  CountedGoal(const ompl::base::SpaceInformationPtr& information, Draws& draws)
      : GoalState(information), draws_(draws) {}

  void sampleGoal(State* state) const override {
    draws_.count();
    GoalState::sampleGoal(state);
  }

 private:
  Draws& draws_;
};

}  // namespace

std::uint_fast32_t Draws::next_seed() {
  sampling::RandomStream stream = sampling::RandomStream(seed_).fork(seeds_given_);
  ++seeds_given_;
  return static_cast<std::uint_fast32_t>(1 +
                                         stream.below(std::numeric_limits<std::uint32_t>::max()));
}

void draw_from(ompl::base::RealVectorStateSpace& space, Draws& draws) {
  space.setStateSamplerAllocator([&draws](const ompl::base::StateSpace* of) {
    return std::make_shared<CountedSampler>(of, draws);
  });
}

std::shared_ptr<ompl::base::GoalState> make_goal(const ompl::base::SpaceInformationPtr& information,
                                                 Draws& draws) {
  return std::make_shared<CountedGoal>(information, draws);
}

}  // namespace handway::planner_ompl
