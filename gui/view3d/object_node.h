#pragma once

#include "handway/geometric/scene/scene.h"
#include "view3d/coin_ref.h"
#include "view3d/robot_node.h"

class SoMatrixTransform;
class SoNode;
class SoSeparator;
class SoSwitch;

namespace handway::gui {

/// The drawing of one object of a scene.
class ObjectNode {
 public:
  explicit ObjectNode(const geometric::SceneObject& object);
  ~ObjectNode();
  ObjectNode(const ObjectNode&) = delete;
  ObjectNode& operator=(const ObjectNode&) = delete;

  [[nodiscard]] SoSeparator* root() const { return root_.get(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Is this what `object` looks like, wherever it is?
  [[nodiscard]] bool draws(const geometric::SceneObject& object) const;

  void place(const geometric::Pose& X_WO);
  /// Draws a mesh in place of its looks; null: its looks.
  void stand_in(const std::shared_ptr<const geometric::TriangleMesh>& mesh) const {
    drawing_.stand_in(mesh);
  }
  /// @returns whether it looked otherwise before.
  bool set_look(Look look);

 private:
  std::string name_;
  geometric::Shape shape_;
  geometric::Color color_;
  CoinRef<SoSeparator> root_;
  BodyShape drawing_;
  CoinRef<SoMatrixTransform> transform_;
  CoinRef<SoSwitch> look_;
};

}  // namespace handway::gui
