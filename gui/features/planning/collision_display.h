#pragma once

#include "model/document/collision_monitor.h"

#include <QLabel>
#include <QObject>

class QAction;

namespace handway::gui {

class Document;
class SceneView;

/// "in collision: A with B", or how far the closest bodies are apart.
class CollisionLabel : public QLabel {
  Q_OBJECT

 public:
  explicit CollisionLabel(QWidget* parent = nullptr);

  void show_report(const CollisionReport& report);
  void show_nothing();
};

/// Watches the document's posture: colliding bodies are red in the view, and named in a label; a
/// line shows where the closest bodies are closest.
class CollisionDisplay : public QObject {
  Q_OBJECT

 public:
  /// Makes the label; a window takes it over.
  CollisionDisplay(Document& document, SceneView& view, QObject* parent = nullptr);

  [[nodiscard]] CollisionMonitor& monitor() { return monitor_; }
  [[nodiscard]] CollisionLabel* label() const { return label_; }
  /// The switch of the line between the bodies that are closest.
  [[nodiscard]] QAction* closest_shown() const { return closest_shown_; }
  void show_scene();

 signals:
  void failed(const QString& message);

 private:
  Document& document_;
  SceneView& view_;
  CollisionMonitor monitor_;
  CollisionLabel* label_;
  QAction* closest_shown_;
};

}  // namespace handway::gui
