#include "handway/geometric/collision/narrow_phase/contact.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <memory>

namespace handway::geometric {
namespace {

using test::add_object;
using test::scene_of;

std::vector<Contact> contacts_of(const Scene& scene, const Configuration& q) {
  ExactCollisionChecker checker(std::make_shared<const CollisionWorld>(scene));
  return find_contacts(checker, q);
}

/// A probe of this shape at `p`, against a box of 0.4 m at the origin, turned by `yaw`.
std::vector<Contact> contacts_with_box(const Shape& probe, const Eigen::Vector3d& p,
                                       double yaw = 0.0) {
  Scene scene = scene_of(test::gantry(probe));
  add_object(scene, "box", Box{{0.4, 0.4, 0.4}},
             pose_from_rpy(Eigen::Vector3d::Zero(), 0.0, 0.0, yaw));
  return contacts_of(scene, p);
}

TEST(Contact, FindsNoneBetweenWhatIsApart) {
  EXPECT_TRUE(contacts_with_box(Sphere{0.1}, {0.5, 0.0, 0.0}).empty());
}

TEST(Contact, MeasuresHowFarABoxHasToBeShifted) {
  const auto contacts = contacts_with_box(Box{{0.2, 0.2, 0.2}}, {0.29, 0.03, 0.02});
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].a, "probe");
  EXPECT_EQ(contacts[0].b, "box");
  EXPECT_NEAR(contacts[0].depth, 0.01, 1.5e-4);
  EXPECT_TRUE(contacts[0].direction.isApprox(Eigen::Vector3d::UnitX(), 1e-6));
  EXPECT_NEAR(contacts[0].p_W.x(), 0.2, 0.011) << "where the surfaces cross";
  EXPECT_NEAR(contacts[0].p_W.y(), 0.03, 0.05);
}

TEST(Contact, FollowsATurnedBox) {
  const double yaw = 0.4;
  const Eigen::Vector3d out(std::cos(yaw), std::sin(yaw), 0.0);
  const auto contacts = contacts_with_box(Sphere{0.1}, 0.28 * out, yaw);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts[0].depth, 0.02, 1e-3);
  EXPECT_GT(contacts[0].direction.dot(out), 0.99);
}

TEST(Contact, IsNotFooledByABodyThatEndsUpInsideTheOther) {
  // Half out at the top: 20 mm down it would touch no surface, wholly inside the box.
  const auto contacts = contacts_with_box(Sphere{0.02}, {0.0, 0.0, 0.19});
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts[0].depth, 0.03, 1e-3);
  EXPECT_GT(contacts[0].direction.z(), 0.99);
}

TEST(Contact, ComesDeepestFirst) {
  Scene scene = scene_of(test::gantry(Box{{0.2, 0.2, 0.2}}));
  add_object(scene, "left", Box{{0.2, 0.2, 0.2}}, Eigen::Vector3d(-0.19, 0.0, 0.0));
  add_object(scene, "far", Box{{0.2, 0.2, 0.2}}, Eigen::Vector3d(0.0, 5.0, 0.0));
  add_object(scene, "right", Box{{0.2, 0.2, 0.2}}, Eigen::Vector3d(0.17, 0.0, 0.0));
  const auto contacts = contacts_of(scene, Eigen::Vector3d::Zero());
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[0].b, "right");
  EXPECT_NEAR(contacts[0].depth, 0.03, 1.5e-4);
  EXPECT_EQ(contacts[1].b, "left");
  EXPECT_NEAR(contacts[1].depth, 0.01, 1.5e-4);
}

TEST(Contact, SaysNoMoreThanItsMost) {
  Scene scene = scene_of(test::gantry(Box{{0.1, 0.1, 3.0}}));
  add_object(scene, "block", Box{{2.0, 2.0, 2.0}}, Eigen::Vector3d::Zero());
  const auto contacts = contacts_of(scene, Eigen::Vector3d(0.1, 0.0, 0.0));
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].depth, Contact::kMostDepth);
}

}  // namespace
}  // namespace handway::geometric
