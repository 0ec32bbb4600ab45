#include "view3d/ghost.h"

#include "view3d/coin_conversions.h"
#include "view3d/robot_node.h"

#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoPolygonOffset.h>
#include <Inventor/nodes/SoSeparator.h>

#include <GL/gl.h>

#include <algorithm>
#include <vector>

namespace handway::gui {
namespace {

constexpr double kApart = 1e-3;

}  // namespace

void Ghost::clear() {
  robot_.reset();
  root_ = {};
}

void Ghost::show(const geometric::RobotInstance& robot, const geometric::Configuration& q,
                 const LinkShapes& shapes, const geometric::Color& color, const Prepare& prepare) {
  if (!robot_) {
    geometric::Color faint = color;
    faint.alpha = opacity_;
    robot_ = std::make_unique<RobotNode>(robot.model, shapes, faint);
    show(robot_->root(), prepare);
  }
  robot_->place(robot.X_WB, q);
}

void Ghost::show(SoNode* drawing, const Prepare& prepare) {
  root_ = make_coin<SoSeparator>();
  prepare(root_.get());
  auto* behind = new SoPolygonOffset;  // does not flicker with the robot where both coincide
  behind->factor = 2.0F;
  behind->units = 60.0F;
  root_->addChild(behind);
  root_->addChild(drawing);
}

// First the depth alone, then the colour of what is in front: a ghost is one
// even veil, however many surfaces lie behind each other.
void Ghost::render(SoGLRenderAction& action) const {
  if (!is_visible()) {
    return;
  }
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  action.setTransparencyType(SoGLRenderAction::NONE);
  action.apply(root_.get());
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  action.setTransparencyType(SoGLRenderAction::BLEND);
  action.apply(root_.get());
}

void Ghost::render_opaque(SoGLRenderAction& action) const {
  if (is_visible()) {
    action.setTransparencyType(SoGLRenderAction::NONE);
    action.apply(root_.get());
  }
}

bool hide_doubled_links(const RobotNode& robot, std::span<const Ghost* const> ghosts) {
  bool changed = false;
  std::vector<const RobotNode*> before{&robot};
  for (const Ghost* ghost : ghosts) {
    if (!ghost->robot()) {
      continue;
    }
    const auto poses = ghost->robot()->link_poses();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const bool doubled = std::ranges::any_of(before, [&](const RobotNode* other) {
        return poses[i].isApprox(other->link_poses()[i], kApart);
      });
      changed |= ghost->robot()->set_link_visible(static_cast<int>(i), !doubled);
    }
    if (ghost->is_visible()) {
      before.push_back(ghost->robot());
    }
  }
  return changed;
}

}  // namespace handway::gui
