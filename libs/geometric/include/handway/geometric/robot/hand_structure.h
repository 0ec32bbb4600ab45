#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/joint_selection.h"
#include "handway/geometric/robot/robot_model.h"

#include <vector>

namespace handway::geometric {

/// One finger of a hand: the links that hang from one place of the palm and end in one fingertip.
struct HandFinger {
  /// Joints that move the finger against the palm, from the palm to the tip. A joint that follows
  /// another one counts as that one.
  JointIndices joints;
  LinkIndices links;  ///< All links of the finger, parents first. The palm is not one of them.
  int tip = -1;       ///< The link of the fingertip: see fingertips().
};

/// Palm and fingers of one hand.
struct HANDWAY_GEOMETRIC_EXPORT HandStructure {
  /// The closest link that carries all fingers, also where a wrist below it counts to the hand.
  /// Without fingers it is the last link that the arm moves.
  int palm = -1;
  /// The fingers, in the order of their first links. Where a part of the palm moves and carries
  /// several of them, each begins beyond that part. Bars of a linkage and links without a shape
  /// are no fingers: see fingertips().
  std::vector<HandFinger> fingers;

  /// Finds palm and fingers by the kinematic tree and by which links have shapes.
  /// @param arm joints of the arm. @param hand joints of the hand; of several hands on arms, the
  /// first joint's hand is returned.
  [[nodiscard]] static HandStructure of(const RobotModel& model, const JointIndices& arm,
                                        const JointIndices& hand);
};

/// Returns the link of each fingertip, of all hands, ascending. A finger ends at the last link
/// that the hand moves and that has a shape or carries one. The tip is that link, or the end of
/// the longest chain of links that are fixed to it. Two kinds of branches are no fingers as long
/// as others remain: those without any shape, as motors and synergies are, and bars of the linkage
/// that keeps the tip of a finger parallel. A bar begins beside the finger, turns with it to the
/// same side and has fewer joints.
/// @param hand joints of the hand or hands.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT LinkIndices fingertips(const RobotModel& model,
                                                              const JointIndices& hand);

/// Returns the end of the longest chain of links that are fixed to `link` and carry no joint that
/// moves; `link` itself if there is none.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT int last_fixed_link(const RobotModel& model, int link);

}  // namespace handway::geometric
