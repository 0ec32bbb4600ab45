#pragma once

#include "handway/geometric/math/pose.h"
#include "view3d/coin_ref.h"

#include <Inventor/nodes/SoSeparator.h>

#include <span>
#include <vector>

class SoNode;

namespace handway::gui {

class RobotNode;

/// Which links of a robot have moved since a picture was made of all, and the drawings of what
/// stands still and of what moves, apart.
class StillSplit {
 public:
  /// Roots whose first children are camera and lights.
  StillSplit(CoinRef<SoSeparator> still, CoinRef<SoSeparator> moving);

  /// Nothing has moved so far.
  void begin(const RobotNode& robot);
  /// Looks which links have moved. @returns whether one has that had not before.
  bool note_motion(const RobotNode& robot);

  /// Has the link moved, as far as has been noted?
  [[nodiscard]] bool moves(int link) const;

  /// Lists the drawings anew. @param still, moving what else belongs to either.
  void list(const RobotNode* robot, std::span<SoNode* const> still,
            std::span<SoNode* const> moving);

  [[nodiscard]] SoSeparator* still() const { return still_.get(); }
  [[nodiscard]] SoSeparator* moving() const { return moving_.get(); }

 private:
  CoinRef<SoSeparator> still_;
  CoinRef<SoSeparator> moving_;
  int first_ = 0;                      ///< Children before the first drawing.
  std::vector<geometric::Pose> X_WL_;  ///< At begin(), shape [link_count].
  std::vector<bool> has_moved_;        ///< Shape [link_count].
};

}  // namespace handway::gui
