#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/queries/region_draws.h"
#include "model/planning/microscope.h"
#include "model/planning/palm_roadmap.h"
#include "view3d/coin_conversions.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

class SoNode;

namespace handway::gui {

/// Farthest configurations of a search that found no path.
struct Frontier {
  geometric::Configuration from_start;
  geometric::Configuration from_goal;
  /// The bodies that collided most, names as in CollisionWorld.
  std::vector<std::string> colliding;
};

/// Something to draw, in an interface without Coin.
class Drawing {
 public:
  // A drawing can be made of nothing, or of a node of a known kind.
  // NOLINTBEGIN(google-explicit-constructor)
  Drawing(std::nullptr_t = nullptr) {}
  template <typename Node>
  Drawing(const CoinRef<Node>& node) : Drawing(node.get()) {}
  // NOLINTEND(google-explicit-constructor)
  explicit Drawing(SoNode* node);
  Drawing(const Drawing& other) : Drawing(other.node_) {}
  Drawing(Drawing&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
  Drawing& operator=(Drawing other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~Drawing();

  /// Returns the node, or null.
  [[nodiscard]] SoNode* node() const { return node_; }

 private:
  SoNode* node_ = nullptr;
};

/// Drawings that are added to the scene without being part of it.
enum class Overlay {
  kPath,
  kRoadmap,
  kRegion,
  kExecuted,
  kOptimized,
  kContacts,
  kClearance,
  kTrails,
  kSteps,
  kHypercubes,
  kConstraints,
  kMeasure,
  kGoalPoses,
  kReach,
  kGrasp,
};

/// Result of a check whether a robot reaches a pose.
enum class PoseReached { kUnknown, kYes, kNo };

/// The frames of the scene's goal poses, red, green and blue for x, y and z, with a box around
/// where their tolerances let the tool be, and a dot: green if the pose is reached, red if not.
/// @param reached of each pose, in order; what is left out is unknown.
[[nodiscard]] Drawing make_goal_poses_node(const geometric::Scene& scene,
                                           std::span<const PoseReached> reached);

/// Makes the marker of a tool's target: a green dot or, if it is out of reach, a red one with a
/// line to the nearest position of the tool. Points in the world, m.
[[nodiscard]] Drawing make_reach_node(const Eigen::Vector3d& target, const Eigen::Vector3d& tool,
                                      bool reached);

/// Draws how a grasp holds an object: at each contact a dot and the friction cone, whose axis
/// points out of the object, and from the object's centre an arrow for the force, and a ring with
/// an arrow for the torque, that together are resisted least.
/// @param X_WO of the object. @param p_O the object's centre (m), in its frame.
[[nodiscard]] Drawing make_grasp_node(const geometric::Pose& X_WO, const Eigen::Vector3d& p_O,
                                      const planning::Pregrasp& grasp, double friction);

/// Draws the scene's constraints for the first robot at `q`: a cone about the direction that an
/// axis has to keep to, with the axis in it; a box that a point has to stay in, with the point.
/// Violated constraints are red.
[[nodiscard]] Drawing make_constraints_node(const geometric::Scene& scene,
                                            const geometric::Configuration& q);

/// A line through `points` (world, m) that changes from the start's colour to
/// the goal's, with a bead at each of `waypoints`; nothing hides it.
[[nodiscard]] Drawing make_path_node(std::span<const Eigen::Vector3d> points,
                                     std::span<const Eigen::Vector3d> waypoints);

/// The colour of the i-th of `count` places along a path, from the start's to the goal's.
[[nodiscard]] geometric::Color color_along(std::size_t i, std::size_t count);

/// A thin line through `points` (world, m) in the same colours, hidden by what is in front.
[[nodiscard]] Drawing make_trail_node(std::span<const Eigen::Vector3d> points);

/// A line of one colour through `points` (world, m): what the robot did. Nothing hides it.
[[nodiscard]] Drawing make_executed_node(std::span<const Eigen::Vector3d> points);

/// Makes a drawing of a path that is being optimised, with a bead at each of `waypoints`.
[[nodiscard]] Drawing make_optimized_node(std::span<const Eigen::Vector3d> points,
                                          std::span<const Eigen::Vector3d> waypoints);

/// A magenta ball at each of `points` (world, m), seen through everything.
[[nodiscard]] Drawing make_contacts_node(std::span<const Eigen::Vector3d> points);

/// A line between the closest points (world, m) of two bodies, seen through everything: red if
/// they nearly touch, over yellow to green.
[[nodiscard]] Drawing make_clearance_node(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// A line through `points` (world, m) with a dot at each, seen through everything: what is
/// measured.
[[nodiscard]] Drawing make_measure_node(std::span<const Eigen::Vector3d> points);

/// A thin line through each of `trails` (points in the world, m); see make_trail_node().
[[nodiscard]] Drawing make_trails_node(std::span<const std::vector<Eigen::Vector3d>> trails);

/// The robot, faint, at each of `postures`, from the start's colour to the goal's.
[[nodiscard]] Drawing make_copies_node(const geometric::RobotInstance& robot,
                                       std::span<const geometric::Configuration> postures);

/// A volume (world, m) that things pass through, faint.
[[nodiscard]] Drawing make_volume_node(std::shared_ptr<const geometric::TriangleMesh> mesh);

inline constexpr geometric::Color kPalmColor{0.16F, 0.40F, 0.78F, 1.0F};
inline constexpr geometric::Color kFingertipColor{0.70F, 0.17F, 0.50F, 1.0F};
inline constexpr geometric::Color kStraightColor{0.93F, 0.70F, 0.08F, 1.0F};

/// Translucent clouds of palms and fingertips, and the straight motion with a dot for the middle
/// of each hypercube, as long as there are few.
[[nodiscard]] Drawing make_region_node(const planning::RegionDraws& draws);

inline constexpr geometric::Color kSearchedColor{0.90F, 0.52F, 0.05F, 1.0F};
inline constexpr geometric::Color kGivenUpColor{0.45F, 0.49F, 0.56F, 1.0F};

/// The edges of boxes: of those within `range` of the arm's way in kSearchedColor, of others in
/// kGivenUpColor; of all in the first if the range is empty, start and goal being joined. Two
/// drawings at most, however many there are.
[[nodiscard]] Drawing make_boxes_node(const std::vector<planning::PalmBox>& boxes,
                                      std::pair<double, double> range);

/// Returns the colour of a sample that used `count` of at most `most` principal motion directions,
/// from blue for few to magenta for many; grey for none.
[[nodiscard]] geometric::Color pmd_color(int count, int most);

/// A dot where the palm is in each node, coloured by the number of principal motion
/// directions, and a thin line for each edge.
[[nodiscard]] Drawing make_roadmap_node(const PalmRoadmap& roadmap);

/// The most principal motion directions that a node used; 0 if none did.
[[nodiscard]] int most_pmds(const PalmRoadmap& roadmap);

/// The roadmap at the palm as it was at the microscope's step, with the edge in question in
/// front: green if it is free, red if it is not. @pre there is a run.
[[nodiscard]] Drawing make_steps_node(const Microscope& microscope);

}  // namespace handway::gui
