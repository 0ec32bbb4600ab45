#include "view3d/scene_view.h"

#include "view3d/backdrop.h"
#include "view3d/scene_graph.h"
#include "view3d/view_overlay.h"

#include <Inventor/SbVec2s.h>
#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoDB.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QWheelEvent>

#include <GL/gl.h>

#include <cmath>

namespace handway::gui {
namespace {

std::uint32_t new_cache_context() {
  static std::uint32_t last = 0;
  return ++last;
}

}  // namespace

SceneView::SceneView(QWidget* parent) : QOpenGLWidget(parent), overlay_(new ViewOverlay(this)) {
  if (!SoDB::isInitialized()) {
    SoDB::init();
  }
  QSurfaceFormat format;
  format.setSamples(4);
  format.setDepthBufferSize(24);
  setFormat(format);
  setMinimumSize(320, 240);
  setFocusPolicy(Qt::ClickFocus);
  graph_ = std::make_unique<SceneGraph>();
  flight_.setDuration(260);
  flight_.setEasingCurve(QEasingCurve::InOutCubic);
  flight_.setStartValue(0.0);
  flight_.setEndValue(1.0);
}

SceneView::~SceneView() {
  makeCurrent();
  action_.reset();
  graph_.reset();
  doneCurrent();
}

void SceneView::set_scene(std::shared_ptr<const geometric::Scene> scene) {
  has_scene_ = scene != nullptr;
  overlay_->set_text(has_scene_ ? QString() : empty_text_);
  untouched_ = true;
  flight_.stop();
  graph_->set_scene(std::move(scene));
  camera_.look_from(StandardView::kOblique, graph_->task_azimuth());
  camera_.fit(graph_->points_of_interest(), aspect());
  update();
}

void SceneView::set_colors(const ViewColors& colors) {
  colors_ = colors;
  graph_->set_colors(colors);
  overlay_->set_color(colors.text);
  update();
}

void SceneView::set_empty_text(const QString& text) {
  empty_text_ = text;
  overlay_->set_text(has_scene_ ? QString() : empty_text_);
}

void SceneView::set_configuration(const geometric::Configuration& q) {
  graph_->set_configuration(q);
  update();
}

void SceneView::set_collisions(std::vector<std::string> bodies) {
  graph_->set_collisions(std::move(bodies));
  update();
}

void SceneView::set_selection(const SceneItem& item) {
  graph_->set_selection(item);
  update();
}

void SceneView::show_ghosts(bool start, bool goal) {
  graph_->show_ghosts(start, goal);
  update();
}

void SceneView::set_path(std::span<const Eigen::Vector3d> points,
                         std::span<const Eigen::Vector3d> waypoints) {
  graph_->set_path(points, waypoints);
  update();
}

void SceneView::set_dots(std::span<const Eigen::Vector3d> points) {
  graph_->set_dots(points);
  update();
}

void SceneView::set_dots_visible(bool visible) {
  graph_->set_dots_visible(visible);
  update();
}

void SceneView::set_floor_visible(bool visible) {
  graph_->set_floor_visible(visible);
  update();
}

void SceneView::fit() {
  OrbitCamera fitted = camera_;
  fitted.fit(graph_->points_of_interest(), aspect());
  fly_to(fitted.placement());
}

void SceneView::look_from(StandardView view) {
  OrbitCamera turned = camera_;
  turned.look_from(view, view == StandardView::kOblique ? graph_->task_azimuth() : 0.0);
  turned.fit(graph_->points_of_interest(), aspect());
  fly_to(turned.placement());
}

void SceneView::fly_to(const OrbitCamera::Placement& placement) {
  flight_.stop();
  flight_.disconnect(this);
  const OrbitCamera::Placement from = camera_.placement();
  connect(&flight_, &QVariantAnimation::valueChanged, this,
          [this, from, placement](const QVariant& t) {
            camera_.set_placement(interpolate(from, placement, t.toDouble()));
            update();
          });
  flight_.start();
}

QSize SceneView::pixel_size() const {
  return (QSizeF(size()) * devicePixelRatioF()).toSize().expandedTo(QSize(1, 1));
}

double SceneView::aspect() const {
  return static_cast<double>(std::max(width(), 1)) / std::max(height(), 1);
}

std::optional<SceneHit> SceneView::pick_at(const QPoint& position) {
  const double dpr = devicePixelRatioF();
  const QSize pixels = pixel_size();
  return graph_->pick(
      SbVec2s(static_cast<short>(pixels.width()), static_cast<short>(pixels.height())),
      SbVec2s(static_cast<short>(position.x() * dpr),
              static_cast<short>((height() - 1 - position.y()) * dpr)));
}

void SceneView::initializeGL() {
  action_ = std::make_unique<SoGLRenderAction>(SbViewportRegion());
  action_->setCacheContext(new_cache_context());
}

void SceneView::paintGL() {
  QElapsedTimer timer;
  timer.start();
  const QSize pixels = pixel_size();
  glPushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS);
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  glViewport(0, 0, pixels.width(), pixels.height());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);  // veils leave the picture opaque
  draw_backdrop(colors_.sky, colors_.ground);
  action_->invalidateState();
  action_->setViewportRegion(
      SbViewportRegion(static_cast<short>(pixels.width()), static_cast<short>(pixels.height())));
  graph_->render(*action_, camera_, aspect());
  render_axes_cross();
  glPopAttrib();
  glPopClientAttrib();
  glFinish();
  frame_time_ms_ = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
  overlay_->set_axes(camera_.orientation());
}

void SceneView::render_axes_cross() {
  const auto size = static_cast<short>(std::lround(ViewOverlay::kAxesSize * devicePixelRatioF()));
  const QSize pixels = pixel_size();
  SbViewportRegion region(static_cast<short>(pixels.width()), static_cast<short>(pixels.height()));
  region.setViewportPixels(0, 0, size, size);
  action_->setViewportRegion(region);
  glClear(GL_DEPTH_BUFFER_BIT);
  graph_->render_axes(*action_, camera_);
}

void SceneView::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  overlay_->setGeometry(rect());
  if (untouched_ && has_scene_) {
    camera_.fit(graph_->points_of_interest(), aspect());
  }
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  press_position_ = last_position_ = event->pos();
  flight_.stop();
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  const QPoint moved = event->pos() - last_position_;
  last_position_ = event->pos();
  if (!event->buttons() || moved.isNull()) {
    return;
  }
  untouched_ = false;
  const double unit = 1.0 / std::max(height(), 1);
  const bool shift = event->modifiers() & Qt::ShiftModifier;
  if ((event->buttons() & Qt::MiddleButton) || ((event->buttons() & Qt::LeftButton) && shift)) {
    camera_.pan(moved.x() * unit, -moved.y() * unit);
  } else if (event->buttons() & Qt::LeftButton) {
    camera_.orbit(-4.0 * moved.x() * unit, 4.0 * moved.y() * unit);
  } else if (event->buttons() & Qt::RightButton) {
    camera_.zoom(std::exp(3.0 * moved.y() * unit), 0.0, 0.0);
  }
  update();
}

void SceneView::mouseReleaseEvent(QMouseEvent* event) {
  const bool still = (event->pos() - press_position_).manhattanLength() < 4;
  if (event->button() != Qt::LeftButton || !still) {
    return;
  }
  const auto hit = pick_at(event->pos());
  emit picked(hit ? hit->item : SceneItem{});
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (const auto hit = pick_at(event->pos())) {
    untouched_ = false;
    OrbitCamera::Placement centred = camera_.placement();
    centred.target = hit->point;
    fly_to(centred);
  }
}

void SceneView::wheelEvent(QWheelEvent* event) {
  untouched_ = false;
  const double unit = 1.0 / std::max(height(), 1);
  const QPointF from_middle = event->position() - QPointF(rect().center());
  camera_.zoom(std::pow(1.0015, -event->angleDelta().y()), from_middle.x() * unit,
               -from_middle.y() * unit);
  update();
  event->accept();
}

}  // namespace handway::gui
