#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/scene/scene.h"
#include "model/document/selection.h"
#include "view3d/body_meshes.h"
#include "view3d/coin_conversions.h"
#include "view3d/robot_node.h"

#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <Eigen/Geometry>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

class SoGroup;
class SoMatrixTransform;
class SoNode;
class SoPath;
class SoSeparator;
class SoSwitch;

namespace handway::gui {

class RobotNode;

/// Splits the links of a robot into those that have moved since a picture was made of all and the
/// others, with a drawing of each part.
class StillSplit {
 public:
  /// Roots whose first children are camera and lights.
  StillSplit(CoinRef<SoSeparator> still, CoinRef<SoSeparator> moving);

  /// Begins with no moved links.
  void begin(const RobotNode& robot);
  /// Finds the links that have moved. @returns whether one has that had not before.
  bool note_motion(const RobotNode& robot);

  /// Returns whether the link has moved, as far as has been noted.
  [[nodiscard]] bool moves(int link) const;

  /// Lists the drawings again. @param still, moving what else belongs to either.
  void list(const RobotNode* robot, std::span<SoNode* const> still,
            std::span<SoNode* const> moving);

  [[nodiscard]] SoSeparator* still() const { return still_.get(); }
  /// The drawings that still() draws, without camera and lights.
  [[nodiscard]] std::vector<SoNode*> still_bodies() const;
  [[nodiscard]] SoSeparator* moving() const { return moving_.get(); }

 private:
  CoinRef<SoSeparator> still_;
  CoinRef<SoSeparator> moving_;
  int first_ = 0;                      ///< Children before the first drawing.
  std::vector<geometric::Pose> X_WL_;  ///< At begin(), shape [link_count].
  std::vector<bool> has_moved_;        ///< Shape [link_count].
};

/// The drawing of one object of a scene.
class ObjectNode {
 public:
  explicit ObjectNode(const geometric::SceneObject& object);
  ~ObjectNode();
  ObjectNode(const ObjectNode&) = delete;
  ObjectNode& operator=(const ObjectNode&) = delete;

  [[nodiscard]] SoSeparator* root() const { return root_.get(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns whether it is furniture, as a table or a wall, rather than something to be grasped.
  [[nodiscard]] bool is_large() const;
  /// Returns whether this is a drawing of `object`, wherever it is.
  [[nodiscard]] bool draws(const geometric::SceneObject& object) const;

  void place(const geometric::Pose& X_WO);
  /// Draws a mesh in place of its looks; null: its looks.
  void stand_in(const std::shared_ptr<const geometric::TriangleMesh>& mesh) const {
    drawing_.stand_in(mesh);
  }
  /// @returns whether it looked otherwise before.
  bool set_look(Look look);
  /// @param section null: it is drawn whole.
  void cut_by(SoNode* section);

 private:
  std::string name_;
  geometric::Shape shape_;
  geometric::Color color_;
  CoinRef<SoSeparator> root_;
  BodyShape drawing_;
  CoinRef<SoGroup> section_;
  CoinRef<SoMatrixTransform> transform_;
  CoinRef<SoSwitch> look_;
};

/// The drawings of a scene's robots and objects, and where each stands.
class SceneBodies {
 public:
  SceneBodies();
  ~SceneBodies();

  /// Draws another scene; null: nothing.
  void show(std::shared_ptr<const geometric::Scene> scene);
  /// Draws an edited scene with the same robots; rebuilds only what looks different.
  void update(std::shared_ptr<const geometric::Scene> scene);
  [[nodiscard]] const std::shared_ptr<const geometric::Scene>& scene() const { return scene_; }

  /// Moves the first robot, and what all robots carry. @pre has_robot().
  void place(const geometric::Configuration& q);
  /// Shows an object or a robot's base at another pose temporarily.
  void preview(const SceneItem& item, const geometric::Pose& X_WO);
  /// Draws meshes in place of the bodies' looks, where there are any.
  void stand_in(const BodyMeshes& meshes);
  /// Paints these bodies (names as in CollisionWorld) as colliding, and no others. Large objects
  /// keep their colours: see outlined().
  /// @returns whether something looks different that stands still, as `split` has it.
  bool set_colliding(const std::vector<std::string>& bodies, const StillSplit& split);

  /// Returns the large ones among these objects, of which much more is seen than what collides.
  [[nodiscard]] std::vector<SoSeparator*> outlined(const std::vector<std::string>& bodies) const;

  /// See SceneView::set_section().
  void set_section(const std::optional<Eigen::Hyperplane<double, 3>>& plane);

  [[nodiscard]] bool has_robot() const { return !robots_.empty(); }
  /// The one that moves. @pre has_robot().
  [[nodiscard]] RobotNode& first_robot() const { return *robots_.front(); }
  [[nodiscard]] const LinkShapes& first_robot_shapes() const { return shapes_.front(); }
  /// Configuration of the first robot, shape [variable_count].
  [[nodiscard]] const geometric::Configuration& configuration() const { return q_; }

  /// All that is not hidden.
  [[nodiscard]] std::vector<SoNode*> shown() const;
  /// Bodies other than the first robot, in two parts: fixed ones, and carried or transparent
  /// ones.
  struct Others {
    std::vector<SoNode*> still;
    std::vector<SoNode*> moving;
  };
  [[nodiscard]] Others others() const;
  /// Objects that are not hidden, without some.
  [[nodiscard]] std::vector<SoNode*> objects_without(const std::vector<std::string>& names) const;
  /// All that is neither hidden nor transparent.
  [[nodiscard]] std::vector<SoNode*> opaque() const;
  /// The drawings of what is selected.
  [[nodiscard]] std::vector<SoSeparator*> parts_of(const Selection& selection) const;
  /// Returns the item of a picked drawing; kNone if it is none of these.
  [[nodiscard]] SceneItem item_of(const SoPath& path) const;

 private:
  void make_objects();
  void place_attached();

  CoinRef<SoSwitch> section_;
  std::shared_ptr<const geometric::Scene> scene_;
  std::vector<LinkShapes> shapes_;  ///< By robot.
  geometric::Configuration q_;
  std::vector<std::unique_ptr<RobotNode>> robots_;
  std::vector<std::unique_ptr<ObjectNode>> objects_;
};

}  // namespace handway::gui
