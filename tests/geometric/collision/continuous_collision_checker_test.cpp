#include "handway/geometric/collision/continuous/continuous_collision_checker.h"

#include "../robot/random_configurations.h"
#include "edge_judge.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

using test::add_object;
using test::RandomConfigurations;
using test::scene_of;

constexpr double kResolution = 2e-5;  // m
constexpr double kDense = 5e-5;       // m

class EdgeJudge : public test::EdgeJudge {
 public:
  explicit EdgeJudge(const Scene& scene) : test::EdgeJudge(scene, kResolution) {}
};

// A finger-sized probe that slides.
Scene sliding_finger() { return scene_of(test::gantry(Box{{0.016, 0.016, 0.05}})); }

// Forty whose ends are free.
std::vector<std::pair<Configuration, Configuration>> short_edges(EdgeJudge& judge,
                                                                 std::uint64_t seed) {
  RandomConfigurations random(judge.world().model(), seed);
  std::vector<std::pair<Configuration, Configuration>> edges;
  while (edges.size() < 40) {
    const Configuration from = random.next();
    const Configuration to = from + 0.05 * (random.next() - from);
    if (!judge.exact().first_collision(from) && !judge.exact().first_collision(to)) {
      edges.emplace_back(from, to);
    }
  }
  return edges;
}

TEST(ContinuousCollisionChecker, SeesAThinPlateBetweenSamples) {
  Scene scene = sliding_finger();
  add_object(scene, "plate", Box{{0.0001, 0.3, 0.3}}, Eigen::Vector3d(0.0313, 0, 0));
  EdgeJudge judge(scene);
  const Eigen::Vector3d to(0.2, 0.01, 0);
  ASSERT_FALSE(judge.collides(Eigen::Vector3d(-0.2, 0, 0), to, 0.1)) << "samples miss it";
  const EdgeResult result = judge.edges().check(Eigen::Vector3d(-0.2, 0, 0), to);
  EXPECT_FALSE(result.free);
  EXPECT_EQ(result.pair, 0);
  EXPECT_NEAR(-0.2 + 0.4 * result.at, 0.0313, 0.008 + 2e-4);
  EXPECT_TRUE(judge.exact().first_collision(Eigen::Vector3d(-0.2, 0, 0) +
                                            result.at * (to - Eigen::Vector3d(-0.2, 0, 0))));
}

TEST(ContinuousCollisionChecker, SeesAWireBetweenSamples) {
  // Wires across the way at many places, so that none profits from where halving lands.
  for (int i = 0; i < 60; ++i) {
    Scene scene = sliding_finger();
    const double x = -0.15 + 0.3 * std::fmod(0.618034 * i, 1.0);
    add_object(scene, "wire", Cylinder{0.0001, 0.4}, pose_from_rpy({x, 0, 0.01}, 1.3, 0.2, 0.1));
    EdgeJudge judge(scene);
    const Eigen::Vector3d from(-0.2, 0.003 * (i % 7), -0.005);
    const Eigen::Vector3d to(0.2, 0, 0.005);
    ASSERT_FALSE(judge.exact().first_collision(from) || judge.exact().first_collision(to));
    EXPECT_FALSE(judge.edges().check(from, to).free) << i;
  }
}

TEST(ContinuousCollisionChecker, PassesAGapThatAFingerFits) {
  for (const double play : {0.0002, 0.001, 0.01}) {
    Scene scene = sliding_finger();
    const double y = 0.5 * (0.016 + play + 0.0001);
    add_object(scene, "left plate", Box{{0.02, 0.0001, 0.3}}, Eigen::Vector3d(0.013, y, 0));
    add_object(scene, "right plate", Box{{0.02, 0.0001, 0.3}}, Eigen::Vector3d(0.013, -y, 0));
    EdgeJudge judge(scene);
    EXPECT_TRUE(judge.edges().check(Eigen::Vector3d(-0.1, 0, 0), Eigen::Vector3d(0.1, 0, 0)).free)
        << play;
  }
}

TEST(ContinuousCollisionChecker, RefusesAGapThatAFingerDoesNotFit) {
  for (const double excess : {1e-5, 0.0002, 0.001, 0.006}) {
    Scene scene = sliding_finger();
    const double y = 0.5 * (0.016 - excess + 0.0001);
    add_object(scene, "left plate", Box{{0.02, 0.0001, 0.3}}, Eigen::Vector3d(0.013, y, 0));
    add_object(scene, "right plate", Box{{0.02, 0.0001, 0.3}}, Eigen::Vector3d(0.013, -y, 0));
    EdgeJudge judge(scene);
    EXPECT_FALSE(judge.edges().check(Eigen::Vector3d(-0.1, 0, 0), Eigen::Vector3d(0.1, 0, 0)).free)
        << excess;
  }
}

TEST(ContinuousCollisionChecker, RefusesToPassCloserThanItsResolution) {
  Scene scene = sliding_finger();
  add_object(scene, "table", Box{{0.1, 0.1, 0.1}}, Eigen::Vector3d(0, 0, -0.075 - 1e-6));
  EdgeJudge judge(scene);
  const Eigen::Vector3d from(-0.1, 0, 0);
  const Eigen::Vector3d to(0.1, 0, 0);
  EXPECT_FALSE(judge.collides(from, to, 0.001));
  EXPECT_FALSE(judge.edges().check(from, to).free) << "1 micrometre of clearance";
  const Eigen::Vector3d nearly(0, 0, 0.95 * kResolution);
  EXPECT_FALSE(judge.edges().check(from + nearly, to + nearly).free);
  const Eigen::Vector3d above(0, 0, 1.5 * kResolution);
  EXPECT_TRUE(judge.edges().check(from + above, to + above).free);
}

// The distance of a finger that slides along a table does not change, although the finger moves by
// a thousand times as much: a plane between them settles stretches as long as the finger.
TEST(ContinuousCollisionChecker, SettlesASlideAlongATableInFewChecks) {
  Scene scene = sliding_finger();
  add_object(scene, "table", Box{{1.0, 1.0, 0.1}}, Eigen::Vector3d(0, 0, -0.0755));
  EdgeJudge judge(scene);
  const EdgeResult slide =
      judge.edges().check(Eigen::Vector3d(-0.2, -0.1, 0), Eigen::Vector3d(0.2, 0.1, 0));
  EXPECT_TRUE(slide.free);
  EXPECT_LE(slide.checks, 64U);
  const EdgeResult dive =
      judge.edges().check(Eigen::Vector3d(-0.2, 0, 0), Eigen::Vector3d(0.2, 0, -0.0006));
  EXPECT_FALSE(dive.free) << "it ends in the table";
}

TEST(ContinuousCollisionChecker, AcceptsAnEdgeInTheOpenAtOnce) {
  Scene scene = sliding_finger();
  add_object(scene, "far", Box{}, Eigen::Vector3d(0, 0, -0.9));
  EdgeJudge judge(scene);
  const EdgeResult result =
      judge.edges().check(Eigen::Vector3d(-0.1, 0, 0), Eigen::Vector3d(0.1, 0, 0));
  EXPECT_TRUE(result.free);
  EXPECT_LE(result.checks, 3U);
  EXPECT_TRUE(judge.edges().check(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()).free);
}

TEST(ContinuousCollisionChecker, WorksWithoutPairs) {
  EdgeJudge judge(sliding_finger());
  EXPECT_TRUE(judge.edges().check(Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(1, 0, 0)).free);
}

// A planar hand among thin plates and wires: all its edges, judged by FCL every
// 0.05 mm of motion.
Scene thin_things() {
  Scene scene = scene_of(test::planar_hand_arm());
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.37 * i - 2.0;
    const double radius = 0.45 + 0.05 * (i % 6);
    const Eigen::Vector3d p(radius * std::cos(angle), radius * std::sin(angle), 0);
    if (i % 2 == 0) {
      add_object(scene, "plate " + std::to_string(i), Box{{0.08, 0.0001, 0.1}},
                 pose_from_rpy(p, 0, 0, angle));
    } else {
      add_object(scene, "wire " + std::to_string(i), Cylinder{0.0001, 0.3},
                 Pose(Eigen::Translation3d(p)));
    }
  }
  return scene;
}

TEST(ContinuousCollisionChecker, MissesNoCollisionOnRandomEdges) {
  EdgeJudge judge(thin_things());
  RandomConfigurations random(judge.world().model(), 21);
  int free = 0;
  int thin = 0;
  while (free < 15 || thin < 5) {
    const Configuration from = random.next();
    const Configuration to = from + 0.05 * (random.next() - from);
    if (judge.exact().first_collision(from) || judge.exact().first_collision(to)) {
      continue;
    }
    const EdgeResult result = judge.edges().check(from, to);
    if (!result.free) {
      EXPECT_TRUE(result.pair.has_value());
      thin += judge.collides(from, to, 0.01) ? 0 : 1;  // hidden between coarse samples
      continue;
    }
    ++free;
    EXPECT_FALSE(free <= 15 && judge.collides(from, to, kDense))
        << from.transpose() << " to " << to.transpose();
    ASSERT_LT(free, 10000);
  }
}

TEST(ContinuousCollisionChecker, IsFreeIfItIsForEveryPairOnItsOwn) {
  EdgeJudge judge(thin_things());
  int refused = 0;
  for (const auto& [from, to] : short_edges(judge, 25)) {
    const EdgeResult whole = judge.edges().check(from, to);
    bool all_free = true;
    for (int pair = 0; pair < static_cast<int>(judge.world().pairs().size()); ++pair) {
      const EdgeResult own = judge.edges().check_among(std::array{pair}, from, to);
      EXPECT_TRUE(own.free || own.pair == pair);
      EXPECT_LE(own.checks, whole.free ? whole.checks : own.checks);
      all_free = all_free && own.free;
    }
    EXPECT_EQ(whole.free, all_free);
    refused += whole.free ? 0 : 1;
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 40);
}

// Returns how many random pieces of free edges are refused, for edges and pieces that know the same
// ends; at a resolution that many edges come close to.
int refused_pieces(bool accepts_pieces) {
  constexpr double kCoarse = 5e-3;
  test::EdgeJudge judge(thin_things(), kCoarse);
  ExactCollisionChecker checker(judge.exact().shared_world());
  ContinuousCollisionChecker pieces(checker, std::make_shared<const MotionBound>(judge.world()),
                                    kCoarse);
  if (accepts_pieces) {
    pieces.accept_pieces();
  }
  RandomConfigurations random(judge.world().model(), 27);
  std::mt19937 draws(28);
  std::uniform_real_distribution<> share(0.0, 1.0);
  int refused = 0;
  for (int free = 0; free < 300;) {
    const Configuration from = random.next();
    const Configuration to = from + 0.1 * (random.next() - from);
    const auto at = [&](double s) { return from + s * (to - from); };
    if (judge.exact().first_collision(from) || judge.exact().first_collision(to)) {
      continue;
    }
    const std::vector<EdgeEnd> ends{make_edge_end(checker, from, kCoarse),
                                    make_edge_end(checker, to, kCoarse)};
    judge.edges().set_ends(ends);
    pieces.set_ends(ends);
    if (!judge.edges().check(from, to).free) {
      continue;
    }
    ++free;
    for (int piece = 0; piece < 20; ++piece) {
      const auto [first, last] = std::minmax({share(draws), share(draws)});
      refused += pieces.check(at(first), at(last)).free ? 0 : 1;
    }
  }
  return refused;
}

TEST(ContinuousCollisionChecker, AcceptsEveryPieceOfWhatIsFree) {
  EXPECT_GT(refused_pieces(false), 0) << "what else is there to accept";
  EXPECT_EQ(refused_pieces(true), 0);
}

TEST(ContinuousCollisionChecker, AcceptsWhatIsFree) {
  EdgeJudge judge(thin_things());
  int accepted = 0;
  for (const auto& [from, to] : short_edges(judge, 22)) {
    // Between samples half a millimetre apart at most that much is lost.
    if (judge.clearance(from, to, 5e-4) > 5e-4 + kResolution) {
      EXPECT_TRUE(judge.edges().check(from, to).free);
      ++accepted;
    }
  }
  EXPECT_GT(accepted, 10);
}

TEST(ContinuousCollisionChecker, BoundsTheClearanceFromBelow) {
  constexpr double kTolerance = 5e-5;
  constexpr double kStep = 2e-4;
  EdgeJudge judge(thin_things());
  RandomConfigurations random(judge.world().model(), 23);
  for (int edges = 0; edges < 12;) {
    const Configuration from = random.next();
    const Configuration to = from + 0.05 * (random.next() - from);
    if (judge.exact().first_collision(from) || !judge.edges().check(from, to).free) {
      continue;
    }
    ++edges;
    const double sampled = judge.clearance(from, to, kStep);  // never below the true one
    const NamedPair found = judge.edges().clearance(std::array{from, to}, 0.05, kTolerance);
    EXPECT_LE(found.distance, sampled + 1e-9);
    EXPECT_GE(found.distance, sampled - kStep - kTolerance);
    EXPECT_LE(judge.edges().clearance(std::array{from, to}, 0.001, kTolerance).distance, 0.001);
    const NamedPair coarse = judge.edges().clearance(std::array{from, to}, 0.05, kTolerance, 0.3);
    EXPECT_LE(coarse.distance, sampled + 1e-9);
    EXPECT_GE(coarse.distance, 0.7 * (sampled - kStep) - kTolerance) << "a share of the clearance";
  }
}

TEST(ContinuousCollisionChecker, NamesThePairOfTheClearance) {
  Scene scene = sliding_finger();
  add_object(scene, "table", Box{{0.1, 0.1, 0.1}}, Eigen::Vector3d(0, 0, -0.078));
  EdgeJudge judge(scene);
  const std::array<Configuration, 2> edge{Eigen::Vector3d(-0.2, 0, 0), Eigen::Vector3d(0.2, 0, 0)};
  const NamedPair found = judge.edges().clearance(edge, 0.05, 1e-5);
  EXPECT_EQ(found.a, "probe");
  EXPECT_EQ(found.b, "table");
  EXPECT_NEAR(found.distance, 0.003, 1e-5);
}

// A slide so close to a table that hundreds of configurations have to be looked at: the table has a
// rim, so that no plane separates its hull from the finger.
class ALongQuestion : public testing::Test {
 protected:
  static Scene scene() {
    Scene scene = sliding_finger();
    TriangleMesh table = *tessellate(Box{{1, 1, 0.1}});
    append(table,
           transformed(*tessellate(Box{{1, 0.1, 0.4}}), Pose(Eigen::Translation3d(0, 0.45, 0.1))));
    add_object(scene, "table",
               Mesh{"", Eigen::Vector3d::Ones(), std::make_shared<const TriangleMesh>(table)},
               Eigen::Vector3d(0, 0, -0.0752));
    return scene;
  }

  EdgeJudge judge_{scene()};
  const Eigen::Vector3d from_{-0.2, 0, 0};
  const Eigen::Vector3d to_{0.2, 0, 0};
};

TEST_F(ALongQuestion, EndsSoonAfterItIsStopped) {
  const EdgeResult whole = judge_.edges().check(from_, to_);
  ASSERT_TRUE(whole.free);
  ASSERT_GT(whole.checks, 200U);
  int asked = 0;
  judge_.edges().stop_when([&] { return ++asked == 4; });
  const EdgeResult stopped = judge_.edges().check(from_, to_);
  EXPECT_EQ(asked, 4);
  EXPECT_FALSE(stopped.free) << "what is not known to be free is not";
  EXPECT_FALSE(stopped.pair);
  EXPECT_GT(stopped.checks, 0U);
  EXPECT_LT(stopped.checks, 100U);
}

TEST_F(ALongQuestion, IsNotBegunOnceStopped) {
  judge_.edges().stop_when([] { return true; });
  EXPECT_EQ(judge_.edges().check(from_, to_).checks, 0U);
}

TEST_F(ALongQuestion, GivesAClearanceThatHoldsWhenStopped) {
  const double whole =
      judge_.edges().clearance(std::array<Configuration, 2>{from_, to_}, 0.05, 2e-5).distance;
  int asked = 0;
  judge_.edges().stop_when([&] { return ++asked == 2; });
  const double stopped =
      judge_.edges().clearance(std::array<Configuration, 2>{from_, to_}, 0.05, 2e-5).distance;
  EXPECT_EQ(asked, 2);
  EXPECT_GT(stopped, 0.0);
  EXPECT_LE(stopped, whole);
}

}  // namespace
}  // namespace handway::geometric
