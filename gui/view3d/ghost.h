#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/scene/scene.h"
#include "view3d/coin_conversions.h"
#include "view3d/robot_node.h"

#include <Inventor/nodes/SoSeparator.h>

#include <functional>
#include <memory>
#include <span>

class SoGLRenderAction;
class SoNode;
class SoSeparator;

namespace handway::gui {

/// A see-through copy of the first robot, or several, as one even veil.
class Ghost {
 public:
  using Prepare = std::function<void(SoSeparator*)>;

  static constexpr float kFaint = 0.26F;
  static constexpr float kStrong = 0.55F;

  explicit Ghost(float opacity = kFaint) : opacity_(opacity) {}

  [[nodiscard]] float opacity() const { return opacity_; }
  void set_visible(bool visible) { visible_ = visible; }
  [[nodiscard]] bool is_visible() const { return visible_ && root_; }
  /// Returns the robot, or null.
  [[nodiscard]] RobotNode* robot() const { return robot_.get(); }

  void clear();
  /// Shows `robot` at q. @param prepare puts camera and lights into a new root.
  void show(const geometric::RobotInstance& robot, const geometric::Configuration& q,
            const LinkShapes& shapes, const geometric::Color& color, const Prepare& prepare);
  /// Shows something else that way, in colours of opacity().
  void show(SoNode* drawing, const Prepare& prepare);
  void render(SoGLRenderAction& action) const;
  /// Renders the body as opaque.
  void render_opaque(SoGLRenderAction& action) const;
  /// The drawing with camera and lights. @pre is_visible().
  [[nodiscard]] SoSeparator* root() const { return root_.get(); }

 private:
  std::unique_ptr<RobotNode> robot_;
  CoinRef<SoSeparator> root_;  ///< Null: there is nothing to show.
  float opacity_;
  bool visible_ = true;
};

/// Hides links of ghosts that lie where the robot's own are, or those of a ghost before:
/// they would only flicker. @returns whether that changed anything.
bool hide_doubled_links(const RobotNode& robot, std::span<const Ghost* const> ghosts);

}  // namespace handway::gui
