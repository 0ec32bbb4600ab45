#include "draws.h"

#include "handway/sampling/sequences/random_stream.h"

#include <ompl/base/samplers/UniformValidStateSampler.h>
#include <ompl/util/RandomNumbers.h>

#include <limits>

namespace handway::planner_ompl {
namespace {

using ompl::base::State;

// Draws for a valid state between two looks at clock and sample budget.
constexpr unsigned int kValidStateAttempts = 5;

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

SeedingLock lock_seeding() {
  static std::recursive_mutex mutex;
  return SeedingLock(mutex);
}

void seed_ompl(const SeedingLock& /*lock*/, Draws& draws) { ompl::RNG::setSeed(draws.next_seed()); }

// A sampler is born with a generator seeded by OMPL, even if that seed is not kept.
void draw_from(ompl::base::RealVectorStateSpace& space, ompl::base::SpaceInformation& information,
               Draws& draws) {
  space.setStateSamplerAllocator([&draws](const ompl::base::StateSpace* of) {
    const SeedingLock lock = lock_seeding();
    return std::make_shared<CountedSampler>(of, draws);
  });
  information.setValidStateSamplerAllocator([](const ompl::base::SpaceInformation* of) {
    const SeedingLock lock = lock_seeding();
    auto sampler = std::make_shared<ompl::base::UniformValidStateSampler>(of);
    sampler->setNrAttempts(kValidStateAttempts);
    return sampler;
  });
}

std::shared_ptr<ompl::base::GoalState> make_goal(const ompl::base::SpaceInformationPtr& information,
                                                 Draws& draws) {
  return std::make_shared<CountedGoal>(information, draws);
}

}  // namespace handway::planner_ompl
