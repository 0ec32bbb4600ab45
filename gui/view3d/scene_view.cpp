#include "view3d/scene_view.h"

#include "handway/geometric/setup/placing.h"
#include "view3d/body_meshes.h"
#include "view3d/grasp_drawings.h"
#include "view3d/orientation_cube.h"
#include "view3d/path_drawings.h"
#include "view3d/scene_graph.h"
#include "view3d/scene_painter.h"

#include <Inventor/SbVec2s.h>
#include <Inventor/SoDB.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QElapsedTimer>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <GL/gl.h>

#include <algorithm>
#include <cmath>
#include <limits>

/// Mouse and keyboard handling of the 3-D view.

namespace handway::gui {

FramePacer::FramePacer(QWidget& widget) : widget_(widget) {
  next_.setSingleShot(true);
  next_.setTimerType(Qt::PreciseTimer);
  QObject::connect(&next_, &QTimer::timeout, &widget_, qOverload<>(&QWidget::update));
}

void FramePacer::request() {
  const qint64 pause = limit_ > 0 ? 1000 / limit_ : 0;
  if (!since_last_.isValid() || since_last_.elapsed() >= pause) {
    widget_.update();
  } else if (!next_.isActive()) {
    next_.start(static_cast<int>(pause - since_last_.elapsed()));
  }
}

void FramePacer::note_painted() {
  next_.stop();
  since_last_.start();
}

namespace {

constexpr int kSettleMs = 150;
constexpr int kClickReach = 4;       // px: shorter drags are clicks
constexpr double kSnapReach = 0.15;  // of an arrow's length
constexpr int kCubeMargin = 10;      // px
constexpr double kLevel = 0.7;       // least upward part of the normal of what things can stand on
constexpr double kCubeTurns = 0.8;   // as if the cube's corner were so much of the view's height

std::optional<Eigen::Vector3d> at_height(const Ray& ray, double height) {
  const double along = (height - ray.origin.z()) / ray.direction.z();
  return ray.direction.z() < -1e-3 && along > 0.0
             ? std::optional<Eigen::Vector3d>(ray.origin + along * ray.direction)
             : std::nullopt;
}

}  // namespace

QString SceneView::coin_version() {
  return QString::fromLatin1(SoDB::getVersion()).section(' ', -1);
}

SceneView::SceneView(QWidget* parent)
    : QOpenGLWidget(parent),
      overlay_(new ViewOverlay(this)),
      cube_(new OrientationCube(this)),
      pacer_(*this) {
  if (!SoDB::isInitialized()) {
    SoDB::init();
  }
  QSurfaceFormat format;
  format.setSamples(0);  // smooth edges are the painter's part
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  setFormat(format);
  setUpdateBehavior(QOpenGLWidget::PartialUpdate);  // fast pictures change only a part
  setMinimumSize(320, 240);
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("3-D view"));
  setMouseTracking(true);
  graph_ = std::make_unique<SceneGraph>();
  settle_.setSingleShot(true);
  settle_.setInterval(kSettleMs);
  connect(&settle_, &QTimer::timeout, this, qOverload<>(&SceneView::update));
  flight_.setDuration(260);
  flight_.setEasingCurve(QEasingCurve::InOutCubic);
  flight_.setStartValue(0.0);
  flight_.setEndValue(1.0);
  connect_cube();
}

SceneView::~SceneView() {
  makeCurrent();
  painter_.reset();
  graph_.reset();
  doneCurrent();
}

void SceneView::connect_cube() {
  connect(cube_, &OrientationCube::chosen, this, [this](const CubePart& part) {
    untouched_ = false;
    OrbitCamera::Placement turned = camera_.placement();
    const CubeDirection direction = direction_of(part, turned.azimuth);
    turned.azimuth = direction.azimuth;
    turned.elevation = direction.elevation;
    fly_to(turned);
  });
  connect(cube_, &OrientationCube::dragged, this, [this](const QPoint& drag) {
    untouched_ = false;
    flight_.stop();
    move_camera(camera_, CameraMove::kTurn, kCubeTurns / OrientationCube::kSize * QPointF(drag));
    draw_fast();
  });
}

void SceneView::set_scene(std::shared_ptr<const geometric::Scene> scene) {
  has_scene_ = scene != nullptr;
  untouched_ = true;
  flight_.stop();
  colliding_.clear();
  graph_->set_scene(std::move(scene));
  const OpeningView view = graph_->open_view(camera_, aspect());
  camera_ = view.camera;
  opening_section_ = view.section;
  change();
}

void SceneView::change_robots(std::shared_ptr<const geometric::Scene> scene) {
  colliding_.clear();
  opening_section_.reset();
  graph_->set_scene(std::move(scene));
  if (untouched_) {
    camera_.fit(graph_->points_of_interest(), aspect());
  }
  change();
}

void SceneView::update_scene(const planning::SceneState& state) {
  graph_->update_scene(state);
  change();
}

void SceneView::set_colors(const ViewColors& colors) {
  colors_ = colors;
  graph_->set_colors(colors);
  overlay_->set_color(colors.text);
  change();
}

void SceneView::set_configuration(const geometric::Configuration& q) {
  if (graph_->set_configuration(q) && painter_) {
    painter_->invalidate();
  }
  draw_fast();
}

void SceneView::set_collisions(std::vector<std::string> bodies) {
  if (bodies != colliding_) {
    colliding_ = bodies;
    if (graph_->set_collisions(std::move(bodies)) && painter_) {
      painter_->invalidate();
    }
    pacer_.request();
  }
}

void SceneView::set_selection(const Selection& selection) {
  selection_ = selection;
  graph_->set_selection(selection);
  change();
}

void SceneView::preview(const SceneItem& item, const geometric::Pose& X_WO) {
  graph_->preview(item, X_WO);
  change();
}

void SceneView::set_gizmo(const SceneItem& item, const std::optional<geometric::Pose>& X_WO,
                          const Eigen::Vector3d& p_O) {
  gizmo_.set_target(item, X_WO, p_O);
  pacer_.request();
}

void SceneView::set_handles(const Drawing& handles) {
  has_handles_ = handles.node() != nullptr;
  graph_->set_handles(handles);
  pacer_.request();
}

const QString& SceneView::note() const { return overlay_->note(); }

void SceneView::set_note(const QString& note, const QPoint& place) {
  overlay_->set_note(note, place);
}

void SceneView::set_gizmo_local(bool local) {
  gizmo_.set_local(local);
  pacer_.request();
}

void SceneView::update_gizmo() {
  if (gizmo_.is_shown()) {
    graph_->gizmo().place(gizmo_.frame(camera_, size()));
    graph_->gizmo().set_hot(gizmo_.hot(), gizmo_.is_dragging());
  }
}

Eigen::Vector3d SceneView::place_for_new() {
  graph_->aim(camera_, aspect());
  const auto seen = graph_->surface_behind(viewport(), pixel_at(rect().center()), {});
  if (seen && seen->normal.z() > kLevel) {
    return seen->point;
  }
  // Furniture that is seen from the side, or stands above the floor that is seen, carries it; but
  // roofs of cells do not.
  constexpr double kBehindSide = 0.05;  // m
  constexpr double kBeforeWall = 0.15;  // m
  constexpr double kTableHigh = 1.2;    // m
  const Ray ray = ray_through(camera_, size(), rect().center());
  const Eigen::Vector3d place =
      seen ? seen->point : at_height(ray, 0.0).value_or(camera_.placement().target);
  const Eigen::Vector3d outwards = seen ? seen->normal : Eigen::Vector3d::Zero().eval();
  const Eigen::Vector3d behind = place - kBehindSide * outwards;
  const Eigen::Vector3d top = graph_->top_at(behind.x(), behind.y());
  return top.z() - place.z() < kTableHigh ? top : place + kBeforeWall * outwards;
}

void SceneView::show_ghosts(bool start, bool goal) {
  graph_->show_ghosts(start, goal);
  change();
}

void SceneView::preview_ghost(bool start, const std::optional<geometric::Configuration>& q) {
  graph_->preview_ghost(start, q);
  change();
}

void SceneView::show_frontier(const std::optional<Frontier>& frontier) {
  graph_->show_frontier(frontier);
  change();
}

void SceneView::set_path(std::span<const Eigen::Vector3d> points,
                         std::span<const Eigen::Vector3d> waypoints) {
  graph_->set_overlay(Overlay::kPath,
                      points.empty() ? Drawing() : make_path_node(points, waypoints));
  change();
}

void SceneView::set_executed(std::span<const Eigen::Vector3d> points) {
  graph_->set_overlay(Overlay::kExecuted, points.empty() ? Drawing() : make_executed_node(points));
  pacer_.request();
}

void SceneView::set_camera(const OrbitCamera::Placement& placement) {
  untouched_ = false;
  camera_.set_placement(placement);
  draw_fast();
}

void SceneView::set_overlay(Overlay overlay, const Drawing& drawing) {
  graph_->set_overlay(overlay, drawing);
  if (overlay == Overlay::kClearance) {  // which goes with the robot
    pacer_.request();
  } else {
    change();
  }
}

void SceneView::set_optimized(std::span<const Eigen::Vector3d> points,
                              std::span<const Eigen::Vector3d> waypoints) {
  graph_->set_overlay(Overlay::kOptimized,
                      points.empty() ? Drawing() : make_optimized_node(points, waypoints));
  change();
}

void SceneView::set_traces(const Drawing& drawing) {
  graph_->set_traces(drawing);
  change();
}

void SceneView::set_overlay_visible(Overlay overlay, bool visible) {
  graph_->set_overlay_visible(overlay, visible);
  change();
}

void SceneView::set_contacts(std::span<const Eigen::Vector3d> points) {
  graph_->set_overlay(Overlay::kContacts, points.empty() ? Drawing() : make_contacts_node(points));
  change();
}

void SceneView::set_floor_visible(bool visible) {
  graph_->set_floor_visible(visible);
  change();
}

void SceneView::set_section(const std::optional<Eigen::Hyperplane<double, 3>>& plane) {
  graph_->set_section(plane);
  change();
}

void SceneView::stand_in(const BodyMeshes& meshes) {
  graph_->stand_in(meshes);
  change();
}

void SceneView::set_projection(Projection projection) {
  camera_.set_projection(projection);
  if (untouched_ && has_scene_) {
    camera_.fit(graph_->points_of_interest(), aspect());
  }
  pacer_.request();
}

void SceneView::set_cube_visible(bool visible) { cube_->setVisible(visible); }

void SceneView::set_samples(int samples) {
  samples_ = samples;
  pacer_.request();
}

void SceneView::set_shadows(bool shadows) {
  has_shadows_ = shadows;
  change();
}

void SceneView::show_all() { fly_around(graph_->all_points()); }

void SceneView::show_selection() {
  const std::vector<Eigen::Vector3d> points = graph_->selected_points();
  fly_around(points.empty() ? graph_->all_points() : points);
}

void SceneView::fly_around(const std::vector<Eigen::Vector3d>& points) {
  OrbitCamera fitted = camera_;
  fitted.fit(points, aspect());
  fly_to(fitted.placement());
}

void SceneView::keep_selection_in_view() {
  std::vector<Eigen::Vector3d> points = graph_->selected_points();
  if (!camera_.sees(points, aspect())) {
    const std::vector<Eigen::Vector3d> others = graph_->points_of_interest();
    points.insert(points.end(), others.begin(), others.end());
    fly_around(points);
  }
}

void SceneView::look_from(StandardView view) {
  if (view == StandardView::kOblique) {
    fly_to(graph_->open_view(camera_, aspect()).camera.placement());
    return;
  }
  OrbitCamera turned = camera_;
  turned.look_from(view);
  turned.fit(graph_->points_of_interest(), aspect());
  fly_to(turned.placement());
}

void SceneView::fly_to(const OrbitCamera::Placement& placement) {
  untouched_ = false;
  flight_.stop();
  flight_.disconnect(this);
  const OrbitCamera::Placement from = camera_.placement();
  connect(&flight_, &QVariantAnimation::valueChanged, this,
          [this, from, placement](const QVariant& t) {
            camera_.set_placement(interpolate(from, placement, t.toDouble()));
            draw_fast();
          });
  flight_.start();
}

QSize SceneView::pixel_size() const {
  return (QSizeF(size()) * devicePixelRatioF()).toSize().expandedTo(QSize(1, 1));
}

double SceneView::aspect() const {
  return static_cast<double>(std::max(width(), 1)) / std::max(height(), 1);
}

SbVec2s SceneView::viewport() const {
  const QSize pixels = pixel_size();
  return {static_cast<short>(pixels.width()), static_cast<short>(pixels.height())};
}

SbVec2s SceneView::pixel_at(const QPoint& position) const {
  const double dpr = devicePixelRatioF();
  return {static_cast<short>(position.x() * dpr),
          static_cast<short>((height() - 1 - position.y()) * dpr)};
}

std::optional<SceneHit> SceneView::pick_at(const QPoint& position) {
  graph_->aim(camera_, aspect());  // the last picture may be older
  return graph_->pick(viewport(), pixel_at(position));
}

void SceneView::initializeGL() { painter_ = std::make_unique<ScenePainter>(*graph_); }

void SceneView::change() {
  if (painter_) {
    painter_->invalidate();
  }
  pacer_.request();
}

void SceneView::draw_fast() {
  if (!always_fine_) {
    settle_.start();
  }
  pacer_.request();
}

void SceneView::settle() {
  settle_.stop();
  pacer_.request();
}

QPixmap SceneView::picture() {
  const bool has_cube = !cube_->isHidden();
  cube_->hide();
  const QPixmap grabbed = grab();
  cube_->setVisible(has_cube);
  return grabbed;
}

void SceneView::paintGL() {
  QElapsedTimer timer;
  timer.start();
  pacer_.note_painted();
  update_gizmo();
  painter_->paint({pixel_size(), devicePixelRatioF(), camera_, colors_,
                   gizmo_.is_shown() || has_handles_, samples_, has_shadows_},
                  settle_.isActive(), defaultFramebufferObject());
  glFinish();
  frame_time_ms_ = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
  overlay_->set_axes(camera_.orientation());
  cube_->set_orientation(camera_.orientation());
}

void SceneView::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  overlay_->setGeometry(rect());
  cube_->move(width() - OrientationCube::kSize - kCubeMargin, kCubeMargin);
  if (untouched_ && has_scene_) {
    camera_.fit(graph_->points_of_interest(), aspect());
  }
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  press_position_ = last_position_ = event->pos();
  drag_has_ended_ = false;
  flight_.stop();
  const bool plain = event->button() == Qt::LeftButton && !(event->modifiers() & Qt::ShiftModifier);
  if (!plain || !gizmo_.is_shown()) {
    return;
  }
  if (gizmo_.press(camera_, size(), event->pos())) {
    pacer_.request();
  } else if (can_carry_from(event->pos())) {
    begin_to_carry(event->pos());
  }
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  const QPoint moved = event->pos() - last_position_;
  last_position_ = event->pos();
  if (gizmo_.is_carrying()) {
    carry(event->pos(), event->modifiers());
    return;
  }
  if (gizmo_.is_dragging()) {
    drag_gizmo(event->pos(), event->modifiers());
    return;
  }
  if (drag_has_ended_) {
    return;
  }
  if (!event->buttons()) {
    if (gizmo_.hover(camera_, size(), event->pos())) {
      pacer_.request();
    }
    setCursor(gizmo_.hot()                   ? Qt::PointingHandCursor
              : can_carry_from(event->pos()) ? Qt::SizeAllCursor
                                             : Qt::ArrowCursor);
    return;
  }
  if (moved.isNull()) {
    return;
  }
  untouched_ = false;
  move_camera(camera_, camera_move(navigation_.style, event->buttons(), event->modifiers()),
              QPointF(moved) / std::max(height(), 1));
  draw_fast();
}

void SceneView::mouseReleaseEvent(QMouseEvent* event) {
  if (gizmo_.is_dragging() && event->button() == Qt::LeftButton) {
    const bool is_click = gizmo_.is_carrying() && !carried_.has_moved;
    end_drag();
    if (!is_click && !(event->modifiers() & Qt::ControlModifier)) {
      return;  // with it, a click on a handle means what is behind
    }
  }
  const bool still = (event->pos() - press_position_).manhattanLength() < kClickReach;
  const bool is_click = still && !std::exchange(drag_has_ended_, false);
  if (!is_click || (event->button() != Qt::LeftButton && event->button() != Qt::RightButton)) {
    return;
  }
  const auto hit = pick_at(event->pos());
  if (event->button() == Qt::RightButton) {
    emit context_requested(hit ? hit->item : SceneItem{}, false, event->globalPos());
    return;
  }
  const bool add = event->modifiers() & (Qt::ControlModifier | Qt::ShiftModifier);
  if (hit || !add) {
    emit picked(hit ? hit->item : SceneItem{}, add);
  }
}

void SceneView::contextMenuEvent(QContextMenuEvent* event) {
  if (event->reason() == QContextMenuEvent::Keyboard) {
    const QPoint place = gizmo_.pose()
                             ? place_of(camera_, size(), gizmo_.pose()->translation()).toPoint()
                             : rect().center();
    emit context_requested({}, true, mapToGlobal(place));
  }
}

bool SceneView::event(QEvent* event) {
  // Events of other kinds come while the members are being made.
  const bool is_press = event->type() == QEvent::KeyPress;
  if ((is_press || event->type() == QEvent::ShortcutOverride) && gizmo_.is_dragging() &&
      take_drag_key(*static_cast<QKeyEvent*>(event), is_press)) {
    event->accept();
    return true;
  }
  return QOpenGLWidget::event(event);
}

// Called twice for each key: first to find whether it is one of a drag's, and then to act.
bool SceneView::take_drag_key(const QKeyEvent& key, bool is_press) {
  switch (key.key()) {
    case Qt::Key_Escape:
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (is_press) {
        drag_has_ended_ = true;
        key.key() == Qt::Key_Escape ? cancel_drag() : end_drag();
      }
      return true;
    default:
      break;
  }
  if (!is_press) {
    return !key.text().isEmpty();
  }
  const bool taken = gizmo_.type(key.key(), key.text());
  if (taken) {
    show_drag(*gizmo_.pose());
  }
  return taken;
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (const auto hit = pick_at(event->pos())) {
    untouched_ = false;
    OrbitCamera::Placement centred = camera_.placement();
    centred.target = hit->point;
    fly_to(centred);
  }
}

void SceneView::add_to_note(const QString& words) {
  const QString amount = gizmo_.amount();
  const bool has_both = !amount.isEmpty() && !words.isEmpty();
  overlay_->set_note(amount + (has_both ? QStringLiteral(" · ") : QString()) + words,
                     last_position_);
}

void SceneView::wheelEvent(QWheelEvent* event) {
  if (gizmo_.is_dragging()) {
    constexpr double kClick = 120.0;  // Qt's eighths of a degree
    emit drag_wheeled(gizmo_.item(), event->angleDelta().y() / kClick);
    event->accept();
    return;
  }
  untouched_ = false;
  const double unit = 1.0 / std::max(height(), 1);
  const QPointF from_middle = event->position() - QPointF(rect().center());
  camera_.zoom(wheel_zoom(navigation_, event->angleDelta().y()), from_middle.x() * unit,
               -from_middle.y() * unit);
  draw_fast();
  event->accept();
}

void SceneView::drag_gizmo(const QPoint& position, Qt::KeyboardModifiers modifiers) {
  if (gizmo_.has_typed()) {
    return;
  }
  geometric::Pose X_WO = gizmo_.drag(camera_, size(), position, modifiers & Qt::ControlModifier);
  if ((modifiers & Qt::ShiftModifier) && face_snap_) {
    X_WO = gizmo_.shift(face_snap_(X_WO, kSnapReach * gizmo_.frame(camera_, size()).size));
  }
  show_drag(X_WO);
}

bool SceneView::can_carry_from(const QPoint& position) {
  const SceneItem::Kind kind = gizmo_.item().kind;
  if (!gizmo_.is_shown() ||
      (kind != SceneItem::Kind::kObject && kind != SceneItem::Kind::kSeveral) ||
      !graph_->stand_in_world(selection_.objects)) {
    return false;
  }
  const auto hit = pick_at(position);
  return hit && hit->item.kind == SceneItem::Kind::kObject &&
         std::ranges::count(selection_.objects, hit->item.name) > 0;
}

void SceneView::begin_to_carry(const QPoint& position) {
  double underside = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& corner : graph_->selected_points()) {
    underside = std::min(underside, corner.z());
  }
  if (const auto held = at_height(ray_through(camera_, size(), position), underside)) {
    carried_ = {*held, underside};
    gizmo_.press_body(camera_, size(), position);
  }
}

void SceneView::carry(const QPoint& position, Qt::KeyboardModifiers modifiers) {
  carried_.has_moved |= (position - press_position_).manhattanLength() >= kClickReach;
  if (!carried_.has_moved || gizmo_.has_typed()) {
    return;
  }
  graph_->aim(camera_, aspect());
  const auto surface = graph_->surface_behind(viewport(), pixel_at(position), selection_.objects);
  if (!surface) {
    carried_.height = 0.0;
  } else if (surface->normal.z() > kLevel) {
    carried_.height = surface->point.z() + geometric::kRestingGap;
  }
  if (const auto place = at_height(ray_through(camera_, size(), position), carried_.height)) {
    geometric::Pose X_WO = gizmo_.carry(*place - carried_.held, modifiers & Qt::ControlModifier);
    if ((modifiers & Qt::ShiftModifier) && face_snap_) {
      X_WO = gizmo_.shift(face_snap_(X_WO, kSnapReach * gizmo_.frame(camera_, size()).size));
    }
    show_drag(X_WO);
  }
}

void SceneView::show_drag(const geometric::Pose& X_WO) {
  graph_->preview(gizmo_.item(), X_WO);
  overlay_->set_note(gizmo_.amount(), last_position_);
  change();
  draw_fast();
  emit dragged(gizmo_.item(), X_WO);
}

void SceneView::end_drag() {
  const geometric::Pose X_WO = *gizmo_.pose();
  const geometric::Pose from = gizmo_.release();
  overlay_->set_note({}, {});
  pacer_.request();
  if (!X_WO.isApprox(from, 1e-12)) {
    emit dropped(gizmo_.item(), X_WO);
  }
}

void SceneView::cancel_drag() {
  const geometric::Pose X_WO = gizmo_.cancel();
  graph_->preview(gizmo_.item(), X_WO);
  overlay_->set_note({}, {});
  change();
  emit dragged(gizmo_.item(), X_WO);
}

}  // namespace handway::gui
