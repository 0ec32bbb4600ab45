#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/robot_model.h"
#include "view3d/coin_conversions.h"

#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

class SoMaterial;
class SoMatrixTransform;
class SoNode;
class SoSeparator;
class SoSwitch;

namespace handway::gui {

/// The drawing of a body in its own frame, with its colours: its looks, or a mesh in their place.
/// Copies share the drawing.
class BodyShape {
 public:
  /// @param looks with materials. @param color of a mesh in their place.
  BodyShape(const CoinRef<SoSeparator>& looks, const geometric::Color& color);

  [[nodiscard]] SoSeparator* get() const { return root_.get(); }
  /// Draws a mesh in place of the looks; null: the looks.
  void stand_in(const std::shared_ptr<const geometric::TriangleMesh>& mesh) const;

 private:
  geometric::Color color_;
  CoinRef<SoSeparator> root_;
  CoinRef<SoSwitch> drawings_;  ///< Looks, then the mesh, if there is one.
};

/// Style of a body.
enum class Look { kPlain, kColliding };

/// The override material of a look; null for kPlain.
/// @param plain what the body is painted with otherwise.
[[nodiscard]] CoinRef<SoMaterial> make_look_material(Look look, const geometric::Color& plain = {});

/// Shapes of the links of a robot in their own frames; shared by the robot and its ghosts. Shape
/// [link_count].
using LinkShapes = std::vector<BodyShape>;

[[nodiscard]] LinkShapes make_link_shapes(const geometric::RobotModel& model);

/// One drawing of a robot, in any posture.
class RobotNode {
 public:
  /// @param ghost colour that replaces all of the robot's own.
  RobotNode(std::shared_ptr<const geometric::RobotModel> model, const LinkShapes& shapes,
            std::optional<geometric::Color> ghost = std::nullopt);
  ~RobotNode();
  RobotNode(const RobotNode&) = delete;
  RobotNode& operator=(const RobotNode&) = delete;

  [[nodiscard]] SoSeparator* root() const { return root_.get(); }
  [[nodiscard]] const geometric::RobotModel& model() const { return *model_; }

  /// Moves all links to configuration `q`, with the base at X_WB.
  void place(const geometric::Pose& X_WB, const geometric::Configuration& q);
  /// Moves a link and all that it carries, so that the link is at X_WL.
  void move_from(int link, const geometric::Pose& X_WL);
  /// X_WL of all links, shape [link_count].
  [[nodiscard]] std::span<const geometric::Pose> link_poses() const { return X_WL_; }

  /// @returns whether it looked otherwise before.
  bool set_look(int link, Look look);
  /// @returns whether it was otherwise before.
  bool set_link_visible(int link, bool visible);

  /// The drawing of a link, in the world.
  [[nodiscard]] SoSeparator* link_root(int link) const {
    return links_[static_cast<std::size_t>(link)].separator.get();
  }
  /// The link that `node` draws.
  [[nodiscard]] std::optional<int> find_link(const SoNode* node) const;

 private:
  struct LinkNode {
    CoinRef<SoSwitch> visible;
    CoinRef<SoSeparator> separator;
    CoinRef<SoMatrixTransform> transform;
    CoinRef<SoSwitch> look;
  };

  std::shared_ptr<const geometric::RobotModel> model_;
  CoinRef<SoSeparator> root_;
  int plain_;  ///< Child of LinkNode::look; what collides looks like the next.
  std::vector<LinkNode> links_;
  std::vector<geometric::Pose> X_WL_;
};

}  // namespace handway::gui
