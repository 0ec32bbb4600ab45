#include "draws.h"

#include "handway/sampling/sequences/random_stream.h"

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/samplers/InformedStateSampler.h>
#include <ompl/base/samplers/UniformValidStateSampler.h>
#include <ompl/util/RandomNumbers.h>

#include <limits>
#include <utility>

namespace handway::planner_ompl {
namespace {

namespace ob = ompl::base;
using ob::State;

// Samples for a valid state between two checks of clock and sample budget.
constexpr unsigned int kValidStateAttempts = 5;
// More failures than a basis has directions: the hand is drawn from all of them.
constexpr int kAllAxes = 1000;

class CountedSampler final : public ob::RealVectorStateSampler {
 public:
  CountedSampler(const ob::StateSpace* space, const StateMap& map, Draws& draws)
      : RealVectorStateSampler(space), map_(map), draws_(draws), targets_(draws.make_targets()) {
    rng_.setLocalSeed(draws.next_seed());
  }

  void sampleUniform(State* state) override {
    const std::uint64_t sample = draws_.counted();
    draws_.count();
    const Eigen::VectorXd x =
        targets_->draw(sample, static_cast<int>(sample % 2), kAllAxes).coordinates;
    map_.write(targets_->space().configuration(x, map_.problem().start).value(), state);
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
  const StateMap& map_;
  Draws& draws_;
  std::unique_ptr<planning::TargetSampler> targets_;
};

class CountedGoal final : public ob::GoalState {
 public:
  CountedGoal(const ob::SpaceInformationPtr& information, Draws& draws)
      : GoalState(information), draws_(draws) {}

  void sampleGoal(State* state) const override {
    draws_.count();
    GoalState::sampleGoal(state);
  }

 private:
  Draws& draws_;
};

/// Counts a sample that the space's sampler did not count.
class CountedInformedSampler final : public ob::InformedSampler {
 public:
  CountedInformedSampler(const ob::ProblemDefinitionPtr& definition, unsigned int most_calls,
                         ob::InformedSamplerPtr inner, Draws& draws)
      : InformedSampler(definition, most_calls), inner_(std::move(inner)), draws_(draws) {}

  bool sampleUniform(State* state, const ob::Cost& most) override {
    return counted([&] { return inner_->sampleUniform(state, most); });
  }
  bool sampleUniform(State* state, const ob::Cost& least, const ob::Cost& most) override {
    return counted([&] { return inner_->sampleUniform(state, least, most); });
  }
  [[nodiscard]] bool hasInformedMeasure() const override { return inner_->hasInformedMeasure(); }
  [[nodiscard]] double getInformedMeasure(const ob::Cost& most) const override {
    return inner_->getInformedMeasure(most);
  }

 private:
  template <class Draw>
  bool counted(const Draw& draw) {
    const std::uint64_t before = draws_.counted();
    const bool drawn = draw();
    if (draws_.counted() == before) {
      draws_.count();
    }
    return drawn;
  }

  ob::InformedSamplerPtr inner_;
  Draws& draws_;
};

class PathLength final : public ob::PathLengthOptimizationObjective {
 public:
  PathLength(const ob::SpaceInformationPtr& information, Draws& draws)
      : PathLengthOptimizationObjective(information), draws_(draws) {}

  [[nodiscard]] ob::InformedSamplerPtr allocInformedStateSampler(
      const ob::ProblemDefinitionPtr& definition, unsigned int most_calls) const override {
    const SeedingLock lock = lock_seeding();
    seed_ompl(lock, draws_);
    return std::make_shared<CountedInformedSampler>(
        definition, most_calls,
        PathLengthOptimizationObjective::allocInformedStateSampler(definition, most_calls), draws_);
  }

 private:
  Draws& draws_;
};

}  // namespace

std::uint_fast32_t Draws::next_seed() {
  sampling::RandomStream stream =
      sampling::RandomStream(context_.request().seed).fork(seeds_given_);
  ++seeds_given_;
  return static_cast<std::uint_fast32_t>(1 +
                                         stream.below(std::numeric_limits<std::uint32_t>::max()));
}

SeedingLock lock_seeding() {
  static std::recursive_mutex mutex;
  return SeedingLock(mutex);
}

void seed_ompl(const SeedingLock& /*lock*/, Draws& draws) { ompl::RNG::setSeed(draws.next_seed()); }

// A sampler is made with a generator seeded by OMPL, even if that seed is not kept.
void draw_states(const StateMap& map, Draws& draws) {
  map.space()->setStateSamplerAllocator([&map, &draws](const ob::StateSpace* space) {
    const SeedingLock lock = lock_seeding();
    return std::make_shared<CountedSampler>(space, map, draws);
  });
}

void draw_valid_states(ob::SpaceInformation& information) {
  information.setValidStateSamplerAllocator([](const ob::SpaceInformation* of) {
    const SeedingLock lock = lock_seeding();
    auto sampler = std::make_shared<ob::UniformValidStateSampler>(of);
    sampler->setNrAttempts(kValidStateAttempts);
    return sampler;
  });
}

std::shared_ptr<ob::GoalState> make_goal(const ob::SpaceInformationPtr& information, Draws& draws) {
  return std::make_shared<CountedGoal>(information, draws);
}

ob::OptimizationObjectivePtr make_path_length(const ob::SpaceInformationPtr& information,
                                              Draws& draws) {
  return std::make_shared<PathLength>(information, draws);
}

}  // namespace handway::planner_ompl
