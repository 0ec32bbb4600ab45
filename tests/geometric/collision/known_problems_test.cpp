/// The fast checker against FCL, pair by pair, on every known problem's own meshes:
/// around its query, anywhere, and on both sides of a contact.
#include "handway_test/known_problems.h"

#include "../robot/random_configurations.h"
#include "checker_agreement.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway_test/scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace handway::test {

void PrintTo(const KnownProblem& problem, std::ostream* out) { *out << problem.name; }

namespace {

using geometric::Configuration;

constexpr double kNarrow = 2e-3;  // m: distances compared as a rule, …
constexpr double kWide = 0.05;    // m: … and at times
constexpr int kWideEvery = 50;
constexpr int kMeasuredEvery = 7;

class Sources {
 public:
  /// @param guide tells where contacts are; what it says of them is compared afterwards.
  Sources(const CollisionProblem& problem, geometric::CollisionChecker& guide)
      : problem_(problem),
        guide_(guide),
        motion_(*problem.world),
        random_(problem.world->model(), 31) {}

  /// Returns a configuration from next to the query's segment to twice the width of the planners'
  /// corridors.
  Configuration around() {
    const double spread = 0.02 * std::floor(random_.uniform(0.0, 6.0));
    return problem_.start + random_.uniform(0.0, 1.0) * (problem_.goal - problem_.start) +
           spread * (random_.next() - problem_.world->model().neutral());
  }

  Configuration anywhere() { return random_.next(); }

  /// The free and the colliding side of a contact on a random line, so close together that
  /// no point moves more than 0.1 mm, at times a nanometre, from one to the other.
  std::pair<Configuration, Configuration> contact() {
    Configuration free = problem_.start;
    do {
      free = around();
    } while (guide_.first_collision(free));
    Configuration colliding;
    do {
      colliding = random_.uniform(0.0, 1.0) < 0.7 ? around() : anywhere();
    } while (!guide_.first_collision(colliding));
    const double apart = std::pow(10.0, random_.uniform(-9.0, -4.0));
    while (motion_.any_point((free - colliding).cwiseAbs()) > apart) {
      const Configuration middle = 0.5 * (free + colliding);
      (guide_.first_collision(middle) ? colliding : free) = middle;
    }
    return {free, colliding};
  }

 private:
  const CollisionProblem& problem_;
  geometric::CollisionChecker& guide_;
  geometric::MotionBound motion_;
  RandomConfigurations random_;
};

class KnownProblems : public testing::TestWithParam<KnownProblem> {};

TEST_P(KnownProblems, HaveTheSameAnswersFromBothCheckers) {
  const CollisionProblem problem(*load(GetParam()).scene);
  CheckerAgreement checkers(problem.world);
  geometric::FclBroadphaseChecker baseline(problem.world);
  Sources sources(problem, checkers.bounded());
  const int count = scaled(GetParam().file.extension() == ".xml" ? 300 : 1000);
  int contacts = 0;
  int asked = 0;
  const auto compare = [&](const Configuration& q) {
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(q));
    ASSERT_EQ(baseline.first_collision(q).has_value(),
              checkers.exact().first_collision(q).has_value());
    if (++asked % kMeasuredEvery == 0) {
      const bool wide = asked % (kMeasuredEvery * kWideEvery) == 0;
      ASSERT_NO_FATAL_FAILURE(checkers.expect_same_distances(q, wide ? kWide : kNarrow));
    }
  };
  while (asked < count) {
    ASSERT_NO_FATAL_FAILURE(compare(sources.around()));
    ASSERT_NO_FATAL_FAILURE(compare(sources.anywhere()));
    const auto [free, colliding] = sources.contact();
    ++contacts;
    ASSERT_NO_FATAL_FAILURE(compare(free));
    ASSERT_NO_FATAL_FAILURE(compare(colliding));
  }
  std::cout << GetParam().name << ": " << asked << " configurations compared ("
            << checkers.collisions() << " in collision, " << contacts
            << " contacts from both sides), "
            << static_cast<std::uint64_t>(asked) * problem.world->pairs().size()
            << " pairs for touching, " << checkers.pairs_measured() << " for their distance\n";
  EXPECT_GT(checkers.collisions(), 0);
  EXPECT_GT(checkers.frees(), 0);
}

std::string test_name(const testing::TestParamInfo<KnownProblem>& info) { return info.param.name; }

std::vector<KnownProblem> those_from(bool reference) {
  std::vector<KnownProblem> problems = known_problems();
  std::erase_if(problems, [&](const KnownProblem& problem) {
    return (problem.file.extension() == ".xml") != reference;
  });
  return problems;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(KnownProblems);
INSTANTIATE_TEST_SUITE_P(Shipped, KnownProblems, testing::ValuesIn(those_from(false)), test_name);
INSTANTIATE_TEST_SUITE_P(Published, KnownProblems, testing::ValuesIn(those_from(true)), test_name);

}  // namespace
}  // namespace handway::test
