#pragma once

#include "handway/planning/edits/resizing.h"
#include "view3d/gizmo_drag.h"

#include <QObject>
#include <QPoint>

#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

class SceneEditor;
class SceneView;

/// Knobs on the sides of the selected object, by which it is made larger or smaller.
class ResizeTool : public QObject {
  Q_OBJECT

 public:
  /// The editor and the view outlive it.
  ResizeTool(SceneEditor& editor, SceneView& view, QObject* parent = nullptr);

  void set_wanted(bool wanted) { wanted_ = wanted; }
  /// Moves the knobs to the object's present sides. @returns whether there are any.
  bool update();
  [[nodiscard]] bool is_dragging() const { return drag_.has_value(); }
  /// Returns the positions of the knobs in the view.
  [[nodiscard]] std::vector<QPoint> places() const;

 signals:
  /// The scene as it would be if the knob stayed where it is now.
  void tried(const handway::planning::SceneState& state);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Drag {
    planning::ResizeKnob knob;
    GizmoDrag pull;
    planning::Resized before;
    planning::Resized now;
  };

  [[nodiscard]] std::optional<int> knob_at(const QPoint& place) const;
  void take_hold(const QPoint& place);
  void pull(const QPoint& place, bool snap);
  void let_go();
  void put_back();
  void draw();

  SceneEditor& editor_;
  SceneView& view_;
  bool wanted_ = false;
  std::string object_;  ///< Empty: no knobs.
  std::vector<planning::ResizeKnob> knobs_;
  geometric::Pose X_WO_ = geometric::Pose::Identity();
  std::optional<int> hot_;
  std::optional<Drag> drag_;
};

}  // namespace handway::gui
