#include "view3d/scene_graph.h"
#include "view3d/scene_view.h"
#include "view3d/view_overlay.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <algorithm>

/// What mouse and keys do in the 3-D view.
namespace handway::gui {

void SceneView::mousePressEvent(QMouseEvent* event) {
  press_position_ = last_position_ = event->pos();
  flight_.stop();
  const bool plain = event->button() == Qt::LeftButton && !(event->modifiers() & Qt::ShiftModifier);
  if (plain && gizmo_.is_shown() && gizmo_.press(camera_, size(), event->pos())) {
    pacer_.request();
  }
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  const QPoint moved = event->pos() - last_position_;
  last_position_ = event->pos();
  if (gizmo_.is_dragging()) {
    drag_gizmo(event->pos(), event->modifiers() & Qt::ControlModifier);
    return;
  }
  if (!event->buttons()) {
    if (gizmo_.hover(camera_, size(), event->pos())) {
      setCursor(gizmo_.hot() ? Qt::PointingHandCursor : Qt::ArrowCursor);
      pacer_.request();
    }
    return;
  }
  if (moved.isNull()) {
    return;
  }
  untouched_ = false;
  move_camera(camera_, camera_move(navigation_.style, event->buttons(), event->modifiers()),
              QPointF(moved) / std::max(height(), 1));
  hurry();
}

void SceneView::mouseReleaseEvent(QMouseEvent* event) {
  if (gizmo_.is_dragging() && event->button() == Qt::LeftButton) {
    const geometric::Pose X_WO = *gizmo_.pose();
    const geometric::Pose from = gizmo_.release();
    overlay_->set_note({}, {});
    pacer_.request();
    if (!X_WO.isApprox(from, 1e-12)) {
      emit dropped(gizmo_.item(), X_WO);
    }
    if (!(event->modifiers() & Qt::ControlModifier)) {
      return;  // with it, a click on a handle means what is behind
    }
  }
  const bool still = (event->pos() - press_position_).manhattanLength() < 4;
  if (event->button() != Qt::LeftButton || !still) {
    return;
  }
  const auto hit = pick_at(event->pos());
  const bool add = event->modifiers() & (Qt::ControlModifier | Qt::ShiftModifier);
  if (hit || !add) {
    emit picked(hit ? hit->item : SceneItem{}, add);
  }
}

bool SceneView::event(QEvent* event) {
  const bool is_key =
      event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
  if (is_key && gizmo_.is_dragging() && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    if (event->type() == QEvent::KeyPress) {
      cancel_drag();
    }
    event->accept();
    return true;
  }
  return QOpenGLWidget::event(event);
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
  camera_.zoom(wheel_zoom(navigation_, event->angleDelta().y()), from_middle.x() * unit,
               -from_middle.y() * unit);
  hurry();
  event->accept();
}

void SceneView::drag_gizmo(const QPoint& position, bool snap) {
  const geometric::Pose X_WO = gizmo_.drag(camera_, size(), position, snap);
  graph_->preview(gizmo_.item(), X_WO);
  overlay_->set_note(gizmo_.amount(), position);
  change();
  hurry();
  emit dragged(gizmo_.item(), X_WO);
}

void SceneView::cancel_drag() {
  const geometric::Pose X_WO = gizmo_.cancel();
  graph_->preview(gizmo_.item(), X_WO);
  overlay_->set_note({}, {});
  change();
  emit dragged(gizmo_.item(), X_WO);
}

}  // namespace handway::gui
