#include "view3d/still_split.h"

#include "view3d/robot_node.h"

#include <utility>

namespace handway::gui {

StillSplit::StillSplit(CoinRef<SoSeparator> still, CoinRef<SoSeparator> moving)
    : still_(std::move(still)), moving_(std::move(moving)), first_(still_->getNumChildren()) {}

void StillSplit::begin(const RobotNode& robot) {
  X_WL_.assign(robot.link_poses().begin(), robot.link_poses().end());
  has_moved_.assign(X_WL_.size(), false);
}

bool StillSplit::note_motion(const RobotNode& robot) {
  if (X_WL_.size() != robot.link_poses().size()) {
    begin(robot);
    return true;
  }
  bool more = false;
  for (std::size_t i = 0; i < X_WL_.size(); ++i) {
    if (!has_moved_[i] && X_WL_[i].matrix() != robot.link_poses()[i].matrix()) {
      has_moved_[i] = true;
      more = true;
    }
  }
  return more;
}

bool StillSplit::moves(int link) const {
  const auto index = static_cast<std::size_t>(link);
  return index < has_moved_.size() && has_moved_[index];
}

void StillSplit::list(const RobotNode* robot, std::span<SoNode* const> still,
                      std::span<SoNode* const> moving) {
  for (SoSeparator* root : {still_.get(), moving_.get()}) {
    while (root->getNumChildren() > first_) {
      root->removeChild(root->getNumChildren() - 1);
    }
  }
  if (robot) {
    for (int i = 0; i < robot->model().link_count(); ++i) {
      (moves(i) ? moving_ : still_)->addChild(robot->link_root(i));
    }
  }
  for (SoNode* node : still) {
    still_->addChild(node);
  }
  for (SoNode* node : moving) {
    moving_->addChild(node);
  }
}

}  // namespace handway::gui
