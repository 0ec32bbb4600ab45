#include "handway/planning/grasps/grasp_quality.h"

#include "handway/geometric/mesh/shape.h"
#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace handway::planning {
namespace {

using Eigen::Vector3d;

constexpr double kFriction = 0.6;
constexpr double kRadius = 0.03;  // m

/// Contacts on a circle about z, pushing inwards, the first one at x.
std::vector<GraspContact> on_circle(int count, double radius = kRadius) {
  std::vector<GraspContact> contacts;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    const Vector3d outwards(std::cos(angle), std::sin(angle), 0.0);
    contacts.push_back({radius * outwards, -outwards});
  }
  return contacts;
}

GraspQuality quality_of(const std::vector<GraspContact>& contacts, const ContactModel& model,
                        double length = kRadius) {
  return grasp_quality(contact_wrenches(contacts, model, {Vector3d::Zero(), length}));
}

/// Two soft fingers that oppose each other at a distance of 2 a (in units of the torque's length).
/// A unit disturbance is given by force (t, ·, ·) and torque about the same axis (w, ·, ·). What
/// the contacts resist of it with 1 N is, with the pyramid's polar polygon (inner radius 1/µ,
/// corners at R/µ), largest in one of two directions:
///   t = 0: 1/ε² = 1/γ² + R²/(µ a)²  (a torque about two axes)
///   t = 1: 1/ε² = 1 + R²/µ² (1 + 1/a²)  (a force along the axis that slips off at one finger)
double two_soft_fingers(double a, double torsion, int edges) {
  const double corner = 1.0 / std::cos(std::numbers::pi / edges) / kFriction;
  const double turning = 1.0 / (torsion * torsion) + corner * corner / (a * a);
  const double slipping = 1.0 + corner * corner * (1.0 + 1.0 / (a * a));
  return 1.0 / std::sqrt(std::max(turning, slipping));
}

TEST(GraspQuality, IsThatOfTwoOpposedSoftFingers) {
  for (const double share : {1.0, 0.5}) {  // of the length that torques are divided by
    for (const double patch : {0.002, 0.01, 0.06}) {
      const ContactModel model{.friction = kFriction, .patch_radius = patch, .edges = 8};
      const double length = kRadius / share;
      EXPECT_NEAR(quality_of(on_circle(2), model, length).epsilon,
                  two_soft_fingers(share, 2.0 / 3.0 * kFriction * patch / length, 8), 1e-9)
          << "a " << share << ", patch " << patch;
    }
  }
}

TEST(GraspQuality, IsZeroOfTwoHardFingersThatOpposeEachOther) {
  const ContactModel hard{.friction = kFriction, .patch_radius = 0.0, .edges = 8};
  const GraspQuality quality = quality_of(on_circle(2), hard);
  EXPECT_EQ(quality.epsilon, 0.0) << "nothing resists a turn about the line between them";
  EXPECT_EQ(quality.volume, 0.0);
}

/// Three hard fingers at 120° with pyramids of four edges, torques divided by the circle's radius.
/// The wrench space's polar body is {u, v : -e_i·u + µ max(|t_i·u + v_z|, |u_z - t_i·v|) <= 1}; its
/// farthest corner has u_x = -1, where one finger does not push, u_y = -v_z = y, where another one
/// slips, and 1/ε² = 1 + 2 y² + (9 + 2 y²) / (3 µ²).
double three_fingers() {
  const double y = (std::numbers::sqrt3 - kFriction) / (1.0 + std::numbers::sqrt3 * kFriction);
  return 1.0 / std::sqrt(1.0 + 2.0 * y * y + (9.0 + 2.0 * y * y) / (3.0 * kFriction * kFriction));
}

TEST(GraspQuality, IsThatOfThreeFingersAt120Degrees) {
  const ContactModel hard{.friction = kFriction, .patch_radius = 0.0, .edges = 4};
  EXPECT_NEAR(quality_of(on_circle(3), hard).epsilon, three_fingers(), 1e-9);
}

TEST(GraspQuality, IsThatOfFourFingersOnASquare) {
  // The torque (1, 1, 1)/√3 is resisted least: each of its parts has a contact with lever 1 and
  // friction µ, and no contact helps with two of them.
  const ContactModel hard{.friction = kFriction, .patch_radius = 0.0, .edges = 4};
  const GraspQuality quality = quality_of(on_circle(4), hard);
  EXPECT_NEAR(quality.epsilon, kFriction / std::numbers::sqrt3, 1e-9);
  EXPECT_NEAR(quality.weakest.norm(), 1.0, 1e-9);
  EXPECT_LT(quality.weakest.head<3>().norm(), 1e-9);
  EXPECT_TRUE(quality.weakest.tail<3>().cwiseAbs().isConstant(1.0 / std::numbers::sqrt3, 1e-9));
}

TEST(GraspQuality, OfTheCrossPolytopeIsKnown) {
  Wrenches wrenches(6, 12);
  wrenches << Eigen::Matrix<double, 6, 6>::Identity(), -Eigen::Matrix<double, 6, 6>::Identity();
  const GraspQuality quality = grasp_quality(wrenches);
  EXPECT_NEAR(quality.epsilon, 1.0 / std::sqrt(6.0), 1e-12);
  EXPECT_NEAR(quality.volume, std::pow(2.0, 6) / 720.0, 1e-12);
}

TEST(GraspQuality, IsNegativeWhereAllFingersPushUpwards) {
  std::vector<GraspContact> contacts = on_circle(4);
  for (GraspContact& contact : contacts) {
    contact.normal_O = (0.2 * contact.normal_O + Vector3d::UnitZ()).normalized();
  }
  const GraspQuality quality = quality_of(contacts, {.friction = 0.1});
  EXPECT_LT(quality.epsilon, 0.0);
  EXPECT_GT(quality.weakest.z(), 0.0) << "nothing pushes it down";
}

TEST(GraspQuality, GrowsWithFrictionAndWithFingers) {
  const auto epsilon = [](int fingers, double friction) {
    return quality_of(on_circle(fingers), {.friction = friction}).epsilon;
  };
  EXPECT_LT(epsilon(3, 0.4), epsilon(3, 0.8));
  EXPECT_LT(epsilon(2, 0.6), epsilon(4, 0.6));
}

TEST(GraspQuality, IsBoundedFromAbove) {
  for (const int count : {2, 3, 4, 7}) {
    const ContactModel model{.friction = kFriction, .patch_radius = 0.01};
    const Wrenches wrenches =
        contact_wrenches(on_circle(count), model, {Vector3d::Zero(), 2.0 * kRadius});
    const double epsilon = grasp_quality(wrenches).epsilon;
    EXPECT_GE(epsilon_bound(wrenches), epsilon - 1e-12) << count;
    EXPECT_LE(epsilon_bound(wrenches), epsilon + 0.001) << count;
  }
}

// Contacts of a thumb and fingers on a cylinder of 30 mm, each somewhere about its place.
std::vector<GraspContact> hand_on_cylinder(sampling::RandomStream& random) {
  std::vector<GraspContact> contacts;
  for (const double place : {0.0, 2.6, 3.1, 3.6}) {
    const double angle = place + 0.4 * (random.uniform() - 0.5);
    const Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    contacts.push_back({0.03 * out + 0.1 * (random.uniform() - 0.5) * Vector3d::UnitZ(), -out});
  }
  return contacts;
}

TEST(GraspQuality, IsMostlyWhatBoundsIt) {
  constexpr int kGrasps = 40;
  sampling::RandomStream random(1);
  int closed = 0;  // in force
  int tight = 0;
  for (int grasp = 0; grasp < kGrasps; ++grasp) {
    const Wrenches wrenches =
        contact_wrenches(hand_on_cylinder(random), {}, {Vector3d::Zero(), 0.07});
    const double epsilon = grasp_quality(wrenches).epsilon;
    const double bound = epsilon_bound(wrenches);
    EXPECT_GE(bound, epsilon - 1e-12);
    closed += epsilon > 0.0 ? 1 : 0;
    tight += epsilon > 0.0 && bound < epsilon + 0.001 ? 1 : 0;
  }
  EXPECT_GE(closed, kGrasps / 4);
  EXPECT_GE(10 * tight, 9 * closed) << "found without building the hull";
}

TEST(GraspQuality, RefusesWhatIsNoContact) {
  EXPECT_THROW(quality_of(on_circle(2), {.friction = 0.0}), std::invalid_argument);
  EXPECT_THROW(quality_of(on_circle(2), {.patch_radius = -1.0}), std::invalid_argument);
  EXPECT_THROW(quality_of(on_circle(2), {.edges = 2}), std::invalid_argument);
  EXPECT_THROW(quality_of(on_circle(2), {}, 0.0), std::invalid_argument);
  EXPECT_THROW(quality_of({{Vector3d::Zero(), Vector3d(0.0, 0.0, 2.0)}}, {}),
               std::invalid_argument);
}

TEST(GraspQuality, ScalesTorquesByTheObject) {
  geometric::TriangleMesh box = *geometric::tessellate(geometric::Box{{0.02, 0.04, 0.04}});
  for (Vector3d& vertex : box.vertices) {
    vertex.x() += 0.5;
  }
  const TorqueScale scale = torque_scale(box);
  EXPECT_TRUE(scale.centre_O.isApprox(Vector3d(0.5, 0.0, 0.0), 1e-9));
  EXPECT_NEAR(scale.length, 0.03, 1e-9) << "from the middle to a corner";
  const TorqueScale cone = torque_scale(*geometric::tessellate(geometric::Cone{0.03, 0.08}));
  EXPECT_NEAR(cone.centre_O.z(), -0.02, 1e-4) << "a quarter of its height above its base";
}

const TorqueScale kScale{.length = kRadius};

Wrench weight(double newtons) {
  Wrench load = Wrench::Zero();
  load.z() = -newtons;
  return load;
}

TEST(ContactForces, LiftWithTwoFingersAtTheEdgeOfFriction) {
  const auto forces = least_contact_forces(on_circle(2), {.friction = 0.5}, kScale, weight(3.0));
  ASSERT_TRUE(forces);
  for (const int finger : {0, 1}) {  // m·g = 2 µ F
    const Vector3d& force = (*forces)[static_cast<std::size_t>(finger)];
    EXPECT_NEAR(force.z(), 1.5, 1e-4);
    EXPECT_NEAR(force.x(), finger == 0 ? -3.0 : 3.0, 1e-4);
    EXPECT_NEAR(force.y(), 0.0, 1e-4);
  }
}

TEST(ContactForces, CarryAWeightFromBelowAlone) {
  const std::vector<GraspContact> tray{{Vector3d(0.0, 0.0, -kRadius), Vector3d::UnitZ()}};
  const auto forces = least_contact_forces(tray, {}, kScale, weight(2.0));
  ASSERT_TRUE(forces);
  EXPECT_TRUE(forces->front().isApprox(Vector3d(0.0, 0.0, 2.0), 1e-4));
  EXPECT_FALSE(least_contact_forces(tray, {}, kScale, -weight(2.0))) << "upside down";
}

TEST(ContactForces, AreThreeTimesAThirdOfASqueezeAt120Degrees) {
  const auto forces = internal_contact_forces(on_circle(3), {}, kScale);
  ASSERT_TRUE(forces);
  const std::vector<GraspContact> contacts = on_circle(3);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    EXPECT_TRUE((*forces)[i].isApprox(contacts[i].normal_O / 3.0, 1e-3)) << (*forces)[i];
  }
  EXPECT_FALSE(internal_contact_forces(std::span(contacts).first(1), {}, kScale));
}

}  // namespace
}  // namespace handway::planning
