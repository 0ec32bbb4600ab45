#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/narrow_phase/closest_points.h"
#include "handway/planning/grasps/grasp_quality.h"

#include <memory>
#include <optional>
#include <vector>

namespace handway::planning {

/// A place where a link is at an object.
struct LinkContact {
  int link = 0;
  GraspContact contact;   ///< In the object's frame.
  double distance = 0.0;  ///< m, of the link from the object.
};

/// Finds where the links of a hand are at an object, on the exact meshes. For one thread.
///
/// Of a link that is at the object with a face or an edge, the contacts are the corners of the
/// patch where they meet, as far as small tilts of the link find them.
class ContactFinder {
 public:
  /// @param pairs of the world, of links with the object.
  ContactFinder(std::shared_ptr<const geometric::CollisionWorld> world, std::vector<int> pairs,
                const geometric::Pose& X_WO);

  /// The contacts of all links that are nearer than `tolerance` (m) to the object, as `checker`
  /// has been placed, or nearer than that to the padding between them.
  [[nodiscard]] std::vector<LinkContact> contacts(geometric::CollisionChecker& checker,
                                                  double tolerance);

  /// Closest points (first the links', then the object's; world) of those of `links` that are
  /// nearest to the object, as `checker` has been placed.
  /// @returns nothing if all are farther away than `enough` (m), or the nearest one touches.
  [[nodiscard]] std::optional<geometric::ClosestPoints> closest(
      geometric::CollisionChecker& checker, const std::vector<int>& links, double enough);

 private:
  [[nodiscard]] geometric::Pose X_WA(int pair, const std::vector<geometric::Pose>& X_BL) const;
  void add_contacts(int pair, const geometric::Pose& X_WA, double tolerance,
                    std::vector<LinkContact>& contacts);

  std::shared_ptr<const geometric::CollisionWorld> world_;
  geometric::ClosestPointFinder closest_;
  std::vector<int> pairs_;
  geometric::Pose X_WO_;
};

}  // namespace handway::planning
