#include "handway/geometric/collision/checkers/exact_collision_checker.h"

#include "../robot/random_configurations.h"
#include "checker_agreement.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

using test::add_object;
using test::CheckerAgreement;
using test::RandomConfigurations;

// The hand-arm robot among things of every shape.
Scene cluttered() {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  add_object(scene, "floor", Box{{3, 3, 0.02}}, Eigen::Vector3d(0, 0, -0.05));
  add_object(scene, "shelf", Box{{0.4, 0.8, 0.01}}, Eigen::Vector3d(0.7, 0, 0.6));
  add_object(scene, "can", test::as_mesh(Cylinder{0.035, 0.12}), Eigen::Vector3d(0.65, 0.1, 0.67));
  add_object(scene, "pole", Cylinder{0.02, 2.0}, Eigen::Vector3d(-0.5, 0.4, 1.0));
  add_object(scene, "ball", Sphere{0.15}, Eigen::Vector3d(0.3, -0.6, 0.9));
  add_object(scene, "cone", Cone{0.1, 0.3}, pose_from_rpy({-0.4, -0.4, 0.5}, 0.4, 0.3, 0.2));
  add_object(scene, "wire", Cylinder{0.0005, 1.0}, pose_from_rpy({0.5, 0.3, 1.2}, 1.5, 0.2, 0));
  return scene;
}

// Returns a scene of so many small objects that they are searched in a tree.
Scene crowded() {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 80; ++i) {
    const Eigen::AngleAxisd place(3.1 * uniform(engine), Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d p_WO =
        place * Eigen::Vector3d(0.8 + 0.4 * uniform(engine), 0, 0.8 + 0.8 * uniform(engine));
    add_object(scene, "thing " + std::to_string(i), Box{{0.05, 0.01, 0.02}},
               pose_from_rpy(p_WO, 3.0 * uniform(engine), uniform(engine), uniform(engine)));
  }
  return scene;
}

// Returns two configurations between `free` and `colliding`, as close to the first contact as
// doubles allow.
std::pair<Configuration, Configuration> contact(FclChecker& checker, Configuration free,
                                                Configuration colliding) {
  for (int i = 0; i < 40; ++i) {
    const Configuration middle = 0.5 * (free + colliding);
    (checker.first_collision(middle) ? colliding : free) = middle;
  }
  return {free, colliding};
}

TEST(ExactCollisionChecker, AgreesWithFclAnywhere) {
  CheckerAgreement checkers(cluttered());
  RandomConfigurations random(checkers.world().model(), 1);
  for (int i = 0; i < 300; ++i) {
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(random.next()));
  }
  EXPECT_GT(checkers.collisions(), 20);
  EXPECT_GT(checkers.frees(), 20);
}

TEST(ExactCollisionChecker, AgreesWithFclAtContact) {
  CheckerAgreement checkers(cluttered());
  RandomConfigurations random(checkers.world().model(), 2);
  int contacts = 0;
  while (contacts < 60) {
    const Configuration a = random.next();
    const Configuration b = random.next();
    if (checkers.exact().first_collision(a) || !checkers.exact().first_collision(b)) {
      continue;
    }
    ++contacts;
    const auto [free, colliding] = contact(checkers.exact(), a, b);
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(free));
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(colliding));
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_distances(free, 0.001));
    for (const double step : {1e-9, 1e-7, 1e-5, 1e-3}) {
      const Configuration way = step * (b - a);
      ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(free - way));
      ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(colliding + way));
    }
  }
}

TEST(ExactCollisionChecker, AgreesWithFclOnDistances) {
  CheckerAgreement checkers(cluttered());
  RandomConfigurations random(checkers.world().model(), 3);
  for (int i = 0; i < 40; ++i) {
    const Configuration q = random.next();
    for (const double enough : {0.002, 0.05, 1.0}) {
      ASSERT_NO_FATAL_FAILURE(checkers.expect_same_distances(q, enough));
    }
  }
}

TEST(ExactCollisionChecker, AgreesWithFclOutOfLimits) {
  CheckerAgreement checkers(cluttered());
  const RobotModel& model = checkers.world().model();
  RandomConfigurations random(model, 4);
  for (int i = 0; i < 50; ++i) {
    Configuration q = random.next();
    q += 0.3 * (random.next() - model.neutral());
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(q));
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_distances(q, 0.002));
  }
}

TEST(ExactCollisionChecker, AgreesWithFclForACarriedCan) {
  Scene scene = cluttered();
  add_object(scene, "carried", test::as_mesh(Cylinder{0.03, 0.12}), Eigen::Vector3d(0.06, 0, 0.15));
  scene.objects.back().attachment = Attachment{"tx90_sah", "Palm", {"Thumb-Dist", "Mid-Dist"}};
  CheckerAgreement checkers(scene);
  RandomConfigurations random(checkers.world().model(), 5);
  for (int i = 0; i < 100; ++i) {
    const Configuration q = random.next();
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(q));
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_distances(q, 0.01));
  }
}

TEST(ExactCollisionChecker, AgreesWithFclOnSheetsWithoutThickness) {
  const auto sheet = [](TriangleMesh mesh) {
    return Mesh{"", Eigen::Vector3d::Ones(), std::make_shared<const TriangleMesh>(std::move(mesh))};
  };
  const Mesh flake = sheet({{{0, 0, 0}, {0.3, 0, 0}, {0, 0.2, 0}}, {{0, 1, 2}}});
  const Mesh bent =
      sheet({{{0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0.4, 0.4, 0.1}}, {{0, 1, 2}, {1, 3, 2}}});
  Scene scene = test::scene_of(test::solid_tx90_sah());
  add_object(scene, "flake", flake, pose_from_rpy({0.5, 0.2, 0.7}, 0.3, 0.4, 0.5));
  add_object(scene, "bent", bent, Eigen::Vector3d(0.4, -0.5, 0.9));
  CheckerAgreement checkers(scene);
  RandomConfigurations random(checkers.world().model(), 9);
  for (int i = 0; i < 100; ++i) {
    const Configuration q = random.next();
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(q));
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_distances(q, 0.05));
  }
}

TEST(ExactCollisionChecker, AgreesWithFclAmongManyObjects) {
  CheckerAgreement checkers(crowded());
  RandomConfigurations random(checkers.world().model(), 7);
  for (int i = 0; i < 40; ++i) {
    const Configuration q = random.next();
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(q));
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_distances(q, 0.01));
  }
  EXPECT_GT(checkers.collisions(), 5);
  EXPECT_GT(checkers.frees(), 5);
}

TEST(ExactCollisionChecker, MissesNoNearPairAmongManyObjects) {
  const auto world = std::make_shared<const CollisionWorld>(crowded());
  ExactCollisionChecker checker(world);
  RandomConfigurations random(world->model(), 8);
  const int count = static_cast<int>(world->pairs().size());
  std::vector<int> near;
  for (int i = 0; i < 40; ++i) {
    checker.place(random.next());
    for (const double distance : {1e-9, 0.01, 0.1, 10.0}) {
      checker.near_pairs(distance, near);
      EXPECT_TRUE(std::ranges::is_sorted(near));
      for (int pair = 0; pair < count; ++pair) {
        EXPECT_TRUE(std::ranges::binary_search(near, pair) ||
                    checker.pair_distance(pair, distance) >= distance);
      }
      EXPECT_LT(near.size(), distance < 1.0 ? world->pairs().size() / 2 : count + 1U);
    }
  }
}

TEST(ExactCollisionChecker, AnswersManyThreadsAlike) {
  const Scene scene = cluttered();
  const ExactCollisionChecker checker(std::make_shared<const CollisionWorld>(scene));
  RandomConfigurations random(checker.world().model(), 6);
  std::vector<Configuration> configurations;
  for (int i = 0; i < 200; ++i) {
    configurations.push_back(random.next());
  }
  std::vector<std::vector<int>> touching(4);
  {
    std::vector<std::jthread> threads;
    for (std::vector<int>& found : touching) {
      threads.emplace_back([&found, &configurations, mine = checker.clone()] {
        for (const Configuration& q : configurations) {
          found.push_back(static_cast<int>(find_collisions(*mine, q).size()));
        }
      });
    }
  }
  for (const std::vector<int>& found : touching) {
    EXPECT_EQ(found, touching.front());
  }
}

TEST(ExactCollisionChecker, FindsTheSamePairWhateverItWasAskedBefore) {
  ExactCollisionChecker asked(std::make_shared<const CollisionWorld>(cluttered()));
  RandomConfigurations random(asked.world().model(), 10);
  std::mt19937_64 engine(10);
  std::uniform_int_distribution<int> any(0, static_cast<int>(asked.world().pairs().size()) - 1);
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    const Configuration q = random.next();
    const int hint = any(engine);
    const std::optional<int> pair = asked.first_collision(q, hint);
    EXPECT_EQ(asked.clone()->first_collision(q, hint), pair) << q.transpose();
    found += pair ? 1 : 0;
  }
  EXPECT_GT(found, 20);
}

TEST(ExactCollisionChecker, SparesFclMostQuestions) {
  CheckerAgreement checkers(cluttered());
  ExactCollisionChecker bounded(checkers.exact().shared_world());
  RandomConfigurations random(checkers.world().model(), 7);
  for (int i = 0; i < 200; ++i) {
    static_cast<void>(find_collisions(bounded, random.next()));
  }
  EXPECT_LT(bounded.counts().exact_tests, bounded.counts().pair_collisions / 10);
}

}  // namespace
}  // namespace handway::geometric
