#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/geometric/math/pose.h"
#include "handway/planning/export.h"
#include "handway/planning/grasps/grasp_quality.h"
#include "handway/planning/grasps/pregrasp_search.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// Conditions of a hold test: loads, and what no robot file says.
struct HoldConditions {
  /// m, in the world: how far the object is from where the grasp expects it. If it is not 0, the
  /// hand starts opened and closes onto the object.
  Eigen::Vector3d misplacement = Eigen::Vector3d::Zero();
  double mass = 0.1;            ///< kg, of the object.
  ContactModel contact = {};    ///< Friction between hand and object; `edges` is not used.
  double force = 1.0;           ///< N: the disturbance, along ±x, ±y and ±z of the world.
  double largest_shift = 0.05;  ///< m; beyond it the object has slipped.
  double largest_turn = 15.0 * std::numbers::pi / 180;  ///< rad; likewise.
  double torque = 2.0;              ///< N·m: the most that a revolute joint applies.
  double stiffness = 5.0;           ///< N·m/rad of a revolute joint's position control.
  double slide_force = 20.0;        ///< N: the most that a prismatic joint applies.
  double slide_stiffness = 1000.0;  ///< N/m of a prismatic joint's position control.
};

/// Describes the conditions that users choose, but friction and mass, which are the search's.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    HoldConditions& conditions);

/// Motion of the object in the hand until the end of a load.
struct HoldSlip {
  bool held = false;   ///< Within HoldConditions::largest_shift and largest_turn all the time.
  double shift = 0.0;  ///< m
  double turn = 0.0;   ///< rad
};

/// Result of a hold test. Every load begins anew with the squeezed grasp.
struct HoldResult {
  /// Between the grasp and the end of the squeeze, without gravity.
  HoldSlip squeeze = {};
  /// Under HoldConditions::force along +x, -x, +y, -y, +z, -z of the world, 1.5 s each, without
  /// gravity. Six, or fewer if the test was stopped.
  std::vector<HoldSlip> directions = {};
  /// Under gravity, raised by 10 cm in 1 s and held for 5 s. Nothing if the test was stopped.
  std::optional<HoldSlip> lift = {};

  /// Returns the number of directions in which the object is held.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT int directions_held() const;
  /// Returns whether the object is held in all six directions.
  [[nodiscard]] bool held() const { return directions_held() == 6; }
  /// Returns the number of loads, the six directions and the lift, under which it is held.
  [[nodiscard]] int loads_held() const { return directions_held() + (lift && lift->held ? 1 : 0); }
  /// Returns whether it is held under all seven.
  [[nodiscard]] bool held_under_all_loads() const { return loads_held() == 7; }
};

/// Misplacements (m) that hold_margins() tries.
inline constexpr std::array<double, 3> kMisplacements{0.0, 0.005, 0.01};

/// The worst of each condition, the others as they are, with which a grasp holds in all six
/// directions and the lift.
struct HoldMargins {
  std::optional<double> least_friction = {};  ///< Absent: not held with the friction asked for.
  std::optional<double> largest_mass = {};    ///< kg; nothing: not held with the mass asked for.
  /// m: the largest of kMisplacements by which the object may be off along x and y of the world,
  /// either way; nothing as before.
  std::optional<double> position_error = {};
};

/// Motion of the palm in the world while the hand carries an object, at rest at both ends.
struct PalmMotion {
  double period = 0.004;              ///< s between two poses, above 0, at most 0.005.
  std::vector<geometric::Pose> X_WP;  ///< At least one.
};

/// Largest force with which a link pushes on the object.
struct LinkForce {
  std::string link;
  double largest = 0.0;  ///< N: sum of the normal forces of its contacts.
};

/// Result of carrying an object in a simulation.
struct CarryResult {
  /// Between the grasp and the end of the squeeze, without gravity.
  HoldSlip squeeze = {};
  /// Between the end of the squeeze and the end of the motion, in the palm's frame.
  HoldSlip slip = {};
  double time = 0.0;                   ///< s: less than the motion's if the object is lost.
  std::vector<LinkForce> forces = {};  ///< Forces of links that touch it, in the hand's order.
  double torque_share = 0.0;           ///< Largest torque of a joint, as a share of its limit.
  std::string joint = {};              ///< The joint with that torque.

  [[nodiscard]] bool held() const { return squeeze.held && slip.held; }
};

/// Force of the hand on the object at one of their contacts.
struct ContactForce {
  Eigen::Vector3d p_W;  ///< m, in the world.
  Eigen::Vector3d f_W;  ///< N, in the world.
};

/// A moment of a hold test.
struct HoldFrame {
  /// 0: the squeeze; 1 to 6: HoldResult::directions; 7: the lift. Of HoldTest::carry() 1: the
  /// motion.
  int load = 0;
  double time = 0.0;  ///< s since the load's begin.
  Configuration q;    ///< The robot, its arm at rest: the lift is shown in the palm's frame.
  geometric::Pose X_WO = geometric::Pose::Identity();  ///< Pose of the object.
  std::vector<ContactForce> forces = {};  ///< Forces in the last step of the simulation.
};
/// Receives moments of a test in their order, one every 20 ms of simulated time.
using HoldWatcher = std::function<void(const HoldFrame& frame)>;

/// Simulates whether the grasps of one object hold it. The hand's palm is fixed; the joints that it
/// carries are driven from Pregrasp::closed to Pregrasp::squeezed by position control of limited
/// force; the object is free, and nothing but the hand touches it. Any number of threads may test
/// at once. Same arguments, same result.
///
/// Source of the procedure of six forces: J. Chen et al., "Bodex: Scalable and efficient robotic
/// dexterous grasp synthesis using bilevel optimization", 2024, with its benchmark DexGraspBench.
class HANDWAY_PLANNING_EXPORT HoldTest {
 public:
  virtual ~HoldTest() = default;
  /// @param stop ends the test within 100 ms, with what is known until then.
  /// @param watch may be empty.
  [[nodiscard]] virtual HoldResult test(const Pregrasp& grasp, const HoldConditions& conditions,
                                        const std::stop_token& stop,
                                        const HoldWatcher& watch) const = 0;
  /// Carries the object along a motion of the palm, under gravity, after the squeeze: in the palm's
  /// frame the object feels the inertial forces of the motion. The arm follows the motion exactly.
  /// @param grasp closed and squeezed are used. @param conditions force is not used.
  /// @param stop and watch as test().
  [[nodiscard]] virtual CarryResult carry(const Pregrasp& grasp, const PalmMotion& motion,
                                          const HoldConditions& conditions,
                                          const std::stop_token& stop,
                                          const HoldWatcher& watch) const = 0;
  /// Returns what the simulation assumes besides HoldConditions, a sentence each.
  [[nodiscard]] virtual std::vector<std::string> assumptions() const = 0;
};

/// Finds the least friction (to 0.01) and the largest mass (to 5 %, at most 10 kg) by bisection,
/// and the largest misplacement: some 25 tests.
/// @param stop as HoldTest::test(); then with what is known.
[[nodiscard]] HANDWAY_PLANNING_EXPORT HoldMargins hold_margins(const HoldTest& test,
                                                               const Pregrasp& grasp,
                                                               const HoldConditions& conditions,
                                                               const std::stop_token& stop = {});

/// A grasp, and the result of its hold test if it was tested.
struct TestedGrasp {
  Pregrasp grasp;
  std::optional<HoldResult> hold = {};
};

/// Tests grasps in their order until `wanted` of them hold in all six directions and in the lift,
/// and ranks them: first those that hold, then those that were not tested, then the others, those
/// that hold under more loads first. Equal ones stay in their order. Any number of threads gives
/// the same result.
/// @param wanted 0 tests none.
/// @param stop ends the tests within 100 ms; the grasps are then ranked by the tests until then.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<TestedGrasp> rank_by_tests(
    const HoldTest& test, std::vector<Pregrasp> grasps, std::size_t wanted,
    const HoldConditions& conditions, int threads, const std::stop_token& stop = {});

}  // namespace handway::planning
