#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/scene/scene.h"
#include "model/document/selection.h"
#include "model/settings/options.h"
#include "model/settings/orbit_camera.h"
#include "view3d/body_meshes.h"
#include "view3d/body_outline.h"
#include "view3d/coin_conversions.h"
#include "view3d/drawing.h"
#include "view3d/frontier.h"
#include "view3d/ghost.h"
#include "view3d/gizmo_node.h"
#include "view3d/overlay.h"
#include "view3d/scene_bodies.h"
#include "view3d/scene_passes.h"
#include "view3d/viewpoints.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

class SbVec2s;
class SoGLRenderAction;
class SoSeparator;

namespace handway::gui {

class OrbitCamera;
struct ScenePasses;

/// A lamp with parallel rays that shines on a part of a scene.
struct Lamp {
  Eigen::Vector3d to_lamp;  ///< Direction in the world.
  Eigen::Vector3d near_by;  ///< World, m. Bodies cast shadows within `radius` of it.
  double radius;            ///< m.
  bool only_still = false;  ///< Only render_still_bodies() cast shadows.
};

/// The part of a scene that a lamp sees: a box about `centre`.
struct LampView {
  Eigen::Matrix3d R_WL;    ///< Columns: right, up and backwards of the lamp, in the world.
  Eigen::Vector3d centre;  ///< World, m.
  double width;            ///< And height, m.
  double depth;            ///< m.
};

/// The part of the floor that is shown.
struct FloorDisc {
  Eigen::Vector3d centre;  ///< World, m.
  double radius;           ///< m.
};

/// A scene as Coin nodes. Knows no window: what to show comes in, drawing and
/// picking go out.
class SceneGraph {
 public:
  SceneGraph();
  ~SceneGraph();

  void set_scene(std::shared_ptr<const geometric::Scene> scene);
  /// Shows an edited scene with the same robots; redraws only what looks different.
  void update_scene(const planning::SceneState& state);
  /// Shows an object or a robot's base elsewhere, for a while.
  void preview(const SceneItem& item, const geometric::Pose& X_WO);
  /// Draws meshes in place of the bodies' looks, where there are any.
  void stand_in(const BodyMeshes& meshes);
  [[nodiscard]] GizmoNode& gizmo() { return gizmo_; }
  /// Draws something else in place of the gizmo; null: the gizmo.
  void set_handles(const Drawing& handles);
  void set_colors(const ViewColors& colors);

  /// Moves the first robot, and what it carries. @param q shape [variable_count].
  /// @returns whether anything looks different that render_still() or a ghost draws.
  bool set_configuration(const geometric::Configuration& q);
  /// Paints these bodies (names as in CollisionWorld) as colliding.
  /// @returns as set_configuration().
  bool set_collisions(std::vector<std::string> bodies);
  void set_selection(const Selection& selection);
  void show_ghosts(bool start, bool goal);
  /// Shows the ghost of start or goal at another configuration temporarily.
  void preview_ghost(bool start, const std::optional<geometric::Configuration>& q);
  /// Shows ghosts in the farthest configurations of a search, with the colliding bodies painted as
  /// such, until the scene changes; nothing: none. Start and goal have no ghosts meanwhile.
  void show_frontier(const std::optional<Frontier>& frontier);
  /// Draws something as ghosts are, until the scene changes; null: nothing.
  void set_traces(const Drawing& drawing);
  /// @param drawing in the world's frame, m; null: nothing.
  void set_overlay(Overlay overlay, const Drawing& drawing);
  void set_overlay_visible(Overlay overlay, bool visible);
  void set_floor_visible(bool visible);
  /// See SceneView::set_section().
  void set_section(const std::optional<Eigen::Hyperplane<double, 3>>& plane) {
    bodies_.set_section(plane);
  }

  /// Points that a picture of the whole scene should contain: the robots now, at
  /// start and at goal, and the objects near them.
  [[nodiscard]] std::vector<Eigen::Vector3d> points_of_interest() const;
  [[nodiscard]] std::vector<Eigen::Vector3d> all_points() const;
  /// Returns the corners of the selection; none if nothing is selected.
  [[nodiscard]] std::vector<Eigen::Vector3d> selected_points() const;
  /// `camera` of an empty scene.
  [[nodiscard]] OpeningView open_view(const OrbitCamera& camera, double aspect) const;

  /// Sets the camera that everything is drawn with and picked with from now on.
  void aim(const OrbitCamera& camera, double aspect);
  /// Draws meshes as they are (at first), or as coarse as hardly can be seen.
  void set_fine(bool fine);
  /// Draws robots and objects into the current viewport.
  void render_bodies(SoGLRenderAction& action);
  /// Draws overlays and the floor's lines.
  void render_drawings(SoGLRenderAction& action);
  /// Draws the ghosts as even veils.
  void render_ghosts(SoGLRenderAction& action);
  /// Draws the depths of the opaque bodies as a lamp sees them. @param pixels width and height.
  LampView render_for_lamp(SoGLRenderAction& action, const Lamp& lamp, int pixels);
  /// Returns the floor if it is visible and there is a scene.
  [[nodiscard]] std::optional<FloorDisc> floor_disc() const;
  /// Begins drawing in parts, for fast frames: bodies that have not moved since begin_motion(),
  /// those that have, and the ghosts, start and goal.
  void begin_motion();
  void render_still_bodies(SoGLRenderAction& action);
  void render_still_drawings(SoGLRenderAction& action);
  void render_moving(SoGLRenderAction& action);
  [[nodiscard]] SoNode& moving_root() const;
  static constexpr std::size_t kGhosts = 5;
  [[nodiscard]] std::array<const Ghost*, kGhosts> ghosts() const {
    return {&start_, &goal_, &from_start_, &from_goal_, &traces_};
  }
  /// Returns whether there is a body to draw a line around.
  [[nodiscard]] bool has_marks() const {
    return outline_.is_shown() || colliding_outline_.is_shown();
  }
  /// Draws the lines around bodies and, if asked, the gizmo, in front of everything.
  void render_marks(SoGLRenderAction& action, bool with_gizmo, float pixel_ratio);
  /// Draws the axes cross, turned like the camera.
  void render_axes(SoGLRenderAction& action, const OrbitCamera& camera);

  /// Returns whether there are objects of these names, all fixed to the world.
  [[nodiscard]] bool stand_in_world(const std::vector<std::string>& objects) const;
  /// A place on the surface of an object (world, m).
  struct Surface {
    Eigen::Vector3d point;
    Eigen::Vector3d normal;
  };
  /// Returns the foremost surface of other objects than these at a pixel (from the lower left).
  [[nodiscard]] std::optional<Surface> surface_behind(const SbVec2s& viewport, const SbVec2s& pixel,
                                                      const std::vector<std::string>& ignored);
  /// Returns the highest point of all shown objects at a place, or the floor (z = 0); world, m.
  [[nodiscard]] Eigen::Vector3d top_at(double x, double y);
  /// Returns the visible item at a pixel (from the lower left).
  [[nodiscard]] std::optional<SceneHit> pick(const SbVec2s& viewport, const SbVec2s& pixel);

 private:
  void add_ghosts();
  void list_solids();
  void add_ghost(Ghost& ghost, const std::optional<geometric::Configuration>& q,
                 const geometric::Color& color);
  void update_outline();
  void rebuild_floor();
  [[nodiscard]] Eigen::Vector3d floor_centre() const;
  void list_shadow_casters(bool only_still);
  [[nodiscard]] LampView view_from(const Lamp& lamp) const;
  bool update_looks();
  bool update_ghosts();
  void paint_frontier(const std::vector<std::string>& colliding);

  SceneBodies bodies_;
  ViewColors colors_;
  Eigen::Vector3d backwards_ = Eigen::Vector3d::UnitZ();  ///< Camera's backward axis, in the world.
  Eigen::Vector3d floor_centre_ = Eigen::Vector3d::Zero();  ///< World, m.
  std::unique_ptr<ScenePasses> passes_;
  GizmoNode gizmo_;
  BodyOutline outline_{{1.0F, 0.62F, 0.05F, 1.0F}};             ///< The selection.
  BodyOutline colliding_outline_{{0.90F, 0.10F, 0.08F, 1.0F}};  ///< Large colliding objects.
  Ghost start_;
  Ghost goal_;
  Ghost from_start_{Ghost::kStrong};
  Ghost from_goal_{Ghost::kStrong};
  Ghost traces_;
  bool wants_start_ = true;  ///< Its ghost, or the goal's, while there is no frontier.
  bool wants_goal_ = true;
  std::vector<std::string> colliding_;
  std::vector<std::string> obstacles_;  ///< Objects that collided most in the frontier's search.
  Selection selection_;
};

}  // namespace handway::gui
