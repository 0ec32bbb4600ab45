#include "features/editing/resize_tool.h"

#include "handway/geometric/math/units.h"
#include "handway/geometric/scene/scene_difference.h"
#include "handway/planning/edits/resizing.h"
#include "handway/planning/edits/scene_edits.h"
#include "model/document/scene_editor.h"
#include "view3d/gizmo_drag.h"
#include "view3d/gizmo_node.h"
#include "view3d/scene_view.h"

#include <QKeyEvent>
#include <QMouseEvent>

#include <utility>

namespace handway::gui {
namespace {

constexpr int kReach = 11;  // pixels

QString measure(double metres) { return QString::number(geometric::millimetres(metres), 'f', 1); }

struct SizeWords {
  QString operator()(const geometric::Box& box) const {
    return QObject::tr("%1 × %2 × %3 mm")
        .arg(measure(box.size.x()), measure(box.size.y()), measure(box.size.z()));
  }
  QString operator()(const geometric::Sphere& sphere) const {
    return QObject::tr("radius %1 mm").arg(measure(sphere.radius));
  }
  QString operator()(const geometric::Cylinder& cylinder) const {
    return QObject::tr("radius %1, length %2 mm")
        .arg(measure(cylinder.radius), measure(cylinder.length));
  }
  QString operator()(const geometric::Cone& cone) const {
    return QObject::tr("radius %1, height %2 mm").arg(measure(cone.radius), measure(cone.length));
  }
  QString operator()(const geometric::Mesh& mesh) const {
    return QObject::tr("scale %1").arg(mesh.scale.x(), 0, 'g', 4);
  }
  QString operator()(const geometric::Cloud& cloud) const {
    return QObject::tr("cells of %1 mm").arg(measure(cloud.cells.size));
  }
};

}  // namespace

ResizeTool::ResizeTool(SceneEditor& editor, SceneView& view, QObject* parent)
    : QObject(parent), editor_(editor), view_(view) {
  view_.installEventFilter(this);
}

bool ResizeTool::update() {
  if (drag_) {
    return true;
  }
  const geometric::SceneObject* object = editor_.selected_object();
  const bool shown = wanted_ && object && !editor_.has_several() && editor_.can_change() &&
                     !editor_.state().is_hidden(object->name);
  if (shown) {
    object_ = object->name;
    knobs_ = planning::resize_knobs(object->shape);
    X_WO_ = editor_.selected_pose().value();
  } else if (std::exchange(object_, {}).empty()) {
    return false;
  } else {
    knobs_.clear();
    hot_.reset();
  }
  draw();
  return shown;
}

std::vector<QPoint> ResizeTool::places() const {
  std::vector<QPoint> places;
  for (const planning::ResizeKnob& knob : knobs_) {
    places.push_back(place_of(view_.camera(), view_.size(), X_WO_ * knob.p_O).toPoint());
  }
  return places;
}

void ResizeTool::draw() {
  std::vector<Eigen::Vector3d> points;
  for (const planning::ResizeKnob& knob : knobs_) {
    if (!drag_ || knob == drag_->knob) {
      points.emplace_back(X_WO_ * knob.p_O);
    }
  }
  const std::optional<int> hot = drag_ ? 0 : hot_;
  view_.set_handles(points.empty() ? Drawing() : make_knobs_node(points, hot));
}

std::optional<int> ResizeTool::knob_at(const QPoint& place) const {
  const std::vector<QPoint> knobs = places();
  std::optional<int> nearest;
  int least = kReach;
  for (std::size_t i = 0; i < knobs.size(); ++i) {
    const QPoint apart = knobs[i] - place;
    const int distance = std::max(std::abs(apart.x()), std::abs(apart.y()));
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

bool ResizeTool::eventFilter(QObject* watched, QEvent* event) {
  if (object_.empty()) {
    return QObject::eventFilter(watched, event);
  }
  const auto* mouse = dynamic_cast<QMouseEvent*>(event);
  const auto* key = dynamic_cast<QKeyEvent*>(event);
  if (mouse && event->type() == QEvent::MouseMove && drag_) {
    pull(mouse->pos(), mouse->modifiers() & Qt::ControlModifier);
    return true;
  }
  if (mouse && event->type() == QEvent::MouseMove && !mouse->buttons()) {
    if (const auto now = knob_at(mouse->pos()); now != hot_) {
      hot_ = now;
      view_.setCursor(hot_ ? Qt::SizeAllCursor : Qt::ArrowCursor);
      draw();
    }
  } else if (mouse && event->type() == QEvent::MouseButtonPress &&
             mouse->button() == Qt::LeftButton && knob_at(mouse->pos())) {
    take_hold(mouse->pos());
    return true;
  } else if (event->type() == QEvent::MouseButtonRelease && drag_) {
    let_go();
    return true;
  } else if (key && drag_ && key->key() == Qt::Key_Escape) {
    if (event->type() == QEvent::KeyPress) {
      put_back();
    }
    event->accept();
    return true;
  }
  return QObject::eventFilter(watched, event);
}

void ResizeTool::take_hold(const QPoint& place) {
  const planning::ResizeKnob knob = knobs_[static_cast<std::size_t>(*knob_at(place))];
  const GizmoFrame along{X_WO_ * knob.p_O, X_WO_.linear(), 1.0};
  const planning::Resized before{editor_.selected_object()->shape, X_WO_};
  const Ray ray = ray_through(view_.camera(), view_.size(), place);
  drag_.emplace(Drag{knob, GizmoDrag({GizmoHandle::Kind::kArrow, knob.axis}, along, X_WO_, ray),
                     before, before});
  draw();
}

void ResizeTool::pull(const QPoint& place, bool snap) {
  (void)drag_->pull.moved_to(ray_through(view_.camera(), view_.size(), place), false);
  const double outwards = drag_->knob.sign * drag_->pull.amount()[drag_->knob.axis];
  drag_->now =
      planning::resized(drag_->before.shape, drag_->before.X_WO, drag_->knob, outwards, snap);
  X_WO_ = drag_->now.X_WO;
  knobs_ = planning::resize_knobs(drag_->now.shape);
  planning::SceneState state =
      with_changed_object(editor_.state(), object_, [&](geometric::SceneObject& object) {
        object.shape = drag_->now.shape;
        object.X_PO = in_parent(*editor_.state().scene, editor_.document().configuration(), object,
                                drag_->now.X_WO);
      });
  view_.update_scene(state);
  view_.set_note(std::visit(SizeWords{}, drag_->now.shape), place);
  draw();
  emit tried(state);
}

void ResizeTool::let_go() {
  const Drag done = *std::exchange(drag_, std::nullopt);
  view_.set_note({}, {});
  if (same_shape(done.before.shape, done.now.shape)) {
    update();
  } else {
    editor_.set_shape(done.now.shape, done.now.X_WO);
  }
}

void ResizeTool::put_back() {
  drag_.reset();
  view_.set_note({}, {});
  view_.update_scene(editor_.state());
  update();
  emit tried(editor_.state());
}

}  // namespace handway::gui
