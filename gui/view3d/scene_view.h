#pragma once

#include "model/document/selection.h"
#include "model/settings/navigation.h"
#include "model/settings/options.h"
#include "model/settings/orbit_camera.h"
#include "view3d/drawing.h"
#include "view3d/frontier.h"
#include "view3d/overlay.h"
#include "view3d/view_gizmo.h"

#include <QElapsedTimer>
#include <QOpenGLWidget>
#include <QPoint>
#include <QTimer>
#include <QVariantAnimation>
#include <QWidget>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {

class OrientationCube;
class SceneGraph;
class ScenePainter;
class ViewOverlay;
struct BodyMeshes;

/// Asks a widget for pictures, but for no more than a limited number per second: requests that come
/// sooner are delayed.
class FramePacer {
 public:
  explicit FramePacer(QWidget& widget);

  /// @param frames a second; 0: as many as can be had.
  void set_limit(int frames) { limit_ = frames; }
  [[nodiscard]] int limit() const { return limit_; }
  void request();
  /// A picture is being painted.
  void note_painted();

 private:
  QWidget& widget_;
  QTimer next_;
  QElapsedTimer since_last_;
  int limit_ = 0;
};

/// The 3-D view: shows a scene, turns with the mouse (as its Navigation says; the wheel zooms, a
/// double click centres) and with the cube in its corner, reports what was clicked.
class SceneView : public QOpenGLWidget {
  Q_OBJECT

 public:
  /// "4.0.0".
  [[nodiscard]] static QString coin_version();

  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  /// Shows a scene and looks at it; null empties the view.
  void set_scene(std::shared_ptr<const geometric::Scene> scene);
  /// OpeningView::section of the scene, until other robots are shown.
  [[nodiscard]] const std::optional<Eigen::Vector3d>& opening_section() const {
    return opening_section_;
  }
  /// Shows the scene with other robots, from where one looks already.
  void change_robots(std::shared_ptr<const geometric::Scene> scene);
  /// Shows an edited scene with the same robots, from where one looks already.
  void update_scene(const planning::SceneState& state);
  void set_colors(const ViewColors& colors);

  /// @param q of the first robot, shape [variable_count].
  void set_configuration(const geometric::Configuration& q);
  /// @param bodies names as in CollisionWorld.
  void set_collisions(std::vector<std::string> bodies);
  void set_selection(const Selection& selection);
  /// Shows an object or a robot's base elsewhere, until the scene changes.
  void preview(const SceneItem& item, const geometric::Pose& X_WO);
  /// Shows handles on an object or a robot. @param X_WO nothing: no handles.
  /// @param p_O centre of the handles in the item's frame, m.
  void set_gizmo(const SceneItem& item, const std::optional<geometric::Pose>& X_WO,
                 const Eigen::Vector3d& p_O = Eigen::Vector3d::Zero());
  /// Draws other handles in place of the gizmo, and in front of everything; null: none.
  void set_handles(const Drawing& handles);
  /// A few words beside a place in the view; empty: none.
  void set_note(const QString& note, const QPoint& place);
  /// Returns the words beside the pointer; empty: none.
  [[nodiscard]] const QString& note() const;
  /// Words beside the pointer while the gizmo's target is dragged, after how far it has gone.
  void add_to_note(const QString& words);
  /// Handles along the target's own axes, or the world's.
  void set_gizmo_local(bool local);
  void show_ghosts(bool start, bool goal);
  /// Shows the ghost of start or goal at another configuration until the scene changes.
  void preview_ghost(bool start, const std::optional<geometric::Configuration>& q);
  /// Shows ghosts in the farthest configurations of a search without a path, in place of those of
  /// start and goal, until the scene changes; nothing: none.
  void show_frontier(const std::optional<Frontier>& frontier);
  /// The palm's way (world, m) and where its waypoints are.
  void set_path(std::span<const Eigen::Vector3d> points,
                std::span<const Eigen::Vector3d> waypoints);
  /// The palm's way as the robot went it (world, m); empty: none.
  void set_executed(std::span<const Eigen::Vector3d> points);
  /// The palm's way along a path that is being optimised, beside the path itself; empty: none.
  void set_optimized(std::span<const Eigen::Vector3d> points,
                     std::span<const Eigen::Vector3d> waypoints);
  /// @param drawing in the world's frame, m; null: nothing.
  void set_overlay(Overlay overlay, const Drawing& drawing);
  void set_overlay_visible(Overlay overlay, bool visible);
  /// Sets the places of penetration between bodies (world, m).
  void set_contacts(std::span<const Eigen::Vector3d> points);
  /// Draws something as the ghosts are, until the scene changes; null: nothing.
  void set_traces(const Drawing& drawing);
  void set_floor_visible(bool visible);
  /// Cuts away what of objects is on the positive side of a plane (world, m), but of those that
  /// robots carry; nothing: shows them whole.
  void set_section(const std::optional<Eigen::Hyperplane<double, 3>>& plane);

  /// Draws meshes in place of the bodies' looks, where there are any.
  void stand_in(const BodyMeshes& meshes);

  void set_projection(Projection projection);
  void set_navigation(const Navigation& navigation) { navigation_ = navigation; }
  void set_cube_visible(bool visible);
  /// @param samples for each pixel of a picture that stands; 0: edges are not smooth.
  void set_samples(int samples);
  /// Draws shadows and darkened corners in pictures that stand.
  void set_shadows(bool shadows);
  /// Paints every picture finely, also while something moves.
  void set_always_fine(bool always) { always_fine_ = always; }
  /// @param frames at most a second; 0: as many as can be had.
  void set_frame_limit(int frames) { pacer_.set_limit(frames); }

  /// Moves the camera so that the whole scene is seen.
  void show_all();
  /// Moves the camera to show the selection, or the whole scene if nothing is selected.
  void show_selection();
  /// Moves it back until the whole scene is seen, if something of what is selected is not.
  void keep_selection_in_view();
  void look_from(StandardView view);
  void set_camera(const OrbitCamera::Placement& placement);

  /// Returns the place for a new object: the visible surface of an object in the middle of the
  /// view, the top of what is seen there from the side, or the floor, where nothing is above it
  /// (world, m).
  [[nodiscard]] Eigen::Vector3d place_for_new();
  /// Returns the visible item at a position in the widget.
  [[nodiscard]] std::optional<SceneHit> pick_at(const QPoint& position);
  /// @param snap what a drag with Shift goes on by, for where its target is: world, m; looked for
  /// so far away (m).
  void set_face_snap(std::function<Eigen::Vector3d(const geometric::Pose&, double)> snap) {
    face_snap_ = std::move(snap);
  }
  [[nodiscard]] const ViewGizmo& gizmo() const { return gizmo_; }
  [[nodiscard]] const OrbitCamera& camera() const { return camera_; }

  /// The next picture is a fine one, whatever has moved just now.
  void settle();
  /// Returns the view as on screen, with its cards, but without the orientation cube.
  [[nodiscard]] QPixmap picture();
  /// Returns the time to draw the last frame, ms.
  [[nodiscard]] double frame_time_ms() const { return frame_time_ms_; }

 signals:
  /// A click; the item's kind is kNone beside everything. @param add with Ctrl or Shift.
  void picked(const handway::gui::SceneItem& item, bool add);
  /// The gizmo's target is on its way, or back where it was.
  void dragged(const handway::gui::SceneItem& item, const handway::geometric::Pose& X_WO);
  /// The gizmo's target has been put somewhere.
  void dropped(const handway::gui::SceneItem& item, const handway::geometric::Pose& X_WO);
  /// The wheel was turned while a handle is held. @param clicks positive: away from the person.
  void drag_wheeled(const handway::gui::SceneItem& item, double clicks);
  /// A click with the right button, or the menu key. @param item under the pointer; of the key:
  /// none.
  void context_requested(const handway::gui::SceneItem& item, bool by_key, const QPoint& global);

 protected:
  void initializeGL() override;
  void paintGL() override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  /// Numbers are typed in place of a drag, Enter ends it, Escape puts back what is being dragged.
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] QSize pixel_size() const;
  [[nodiscard]] double aspect() const;
  /// Repaints what the painter may have kept.
  void change();
  /// Paints fast from now on, until nothing has moved for a moment.
  void draw_fast();
  void update_gizmo();
  void drag_gizmo(const QPoint& position, Qt::KeyboardModifiers modifiers);
  /// Returns whether a drag from here carries the selected objects: they are fixed to the world.
  [[nodiscard]] bool can_carry_from(const QPoint& position);
  void begin_to_carry(const QPoint& position);
  /// Carries them along the surface under the pointer.
  void carry(const QPoint& position, Qt::KeyboardModifiers modifiers);
  [[nodiscard]] SbVec2s viewport() const;
  [[nodiscard]] SbVec2s pixel_at(const QPoint& position) const;
  void show_drag(const geometric::Pose& X_WO);
  void end_drag();
  void cancel_drag();
  [[nodiscard]] bool take_drag_key(const QKeyEvent& key, bool is_press);
  void fly_to(const OrbitCamera::Placement& placement);
  /// Moves the camera until all points are in view, with the same direction of view.
  void fly_around(const std::vector<Eigen::Vector3d>& points);
  void connect_cube();

  std::unique_ptr<SceneGraph> graph_;
  std::unique_ptr<ScenePainter> painter_;  ///< Null until there is a context.
  ViewOverlay* overlay_;
  OrientationCube* cube_;
  FramePacer pacer_;
  Navigation navigation_;
  OrbitCamera camera_;
  ViewGizmo gizmo_;
  Selection selection_;
  /// Objects that are carried. World, m.
  struct Carried {
    Eigen::Vector3d held;  ///< Point of the underside's plane under the pointer, when grabbed.
    double height;         ///< Height of the last surface below them.
    bool has_moved = false;
  };
  Carried carried_;
  QVariantAnimation flight_;
  QTimer settle_;
  std::vector<std::string> colliding_;
  std::function<Eigen::Vector3d(const geometric::Pose&, double)> face_snap_;
  ViewColors colors_;
  QPoint press_position_;
  QPoint last_position_;
  double frame_time_ms_ = 0.0;
  int samples_ = 4;
  bool has_shadows_ = true;
  bool always_fine_ = false;
  bool has_handles_ = false;
  bool drag_has_ended_ = false;  ///< With the button still down.
  bool has_scene_ = false;
  std::optional<Eigen::Vector3d> opening_section_;
  bool untouched_ = true;  ///< The user has not turned the view: keep it fitted.
};

}  // namespace handway::gui
