#pragma once

#include "workers/collision_monitor.h"

#include <QObject>

namespace handway::gui {

class CollisionLabel;
class Document;
class SceneView;

/// Watches the document's posture: colliding bodies are red in the view, and named in a label.
class CollisionDisplay : public QObject {
  Q_OBJECT

 public:
  /// Makes the label; a window takes it over.
  CollisionDisplay(Document& document, SceneView& view, QObject* parent = nullptr);

  [[nodiscard]] CollisionMonitor& monitor() { return monitor_; }
  [[nodiscard]] CollisionLabel* label() const { return label_; }
  void show_scene();

 signals:
  void failed(const QString& message);

 private:
  Document& document_;
  CollisionMonitor monitor_;
  CollisionLabel* label_;
};

}  // namespace handway::gui
