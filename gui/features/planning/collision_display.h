#pragma once

#include "model/document/collision_monitor.h"

#include <QColor>
#include <QLabel>
#include <QObject>

class QAction;
class QLabel;

namespace handway::gui {

class SceneView;

/// "in collision: A with B", or how far the closest bodies are apart.
class CollisionLabel : public QLabel {
  Q_OBJECT

 public:
  explicit CollisionLabel(QWidget* parent = nullptr);

  void show_report(const CollisionReport& report);
  void show_nothing();
  /// The answer is to come.
  void show_pending();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// @param all for the tool tip.
  void show_words(const QColor& color, const QString& words, const QString& all);
  void elide();

  QColor color_;
  QString words_;
};

/// Watches the document's posture: colliding bodies are red in the view, and named in a label; a
/// line shows where the closest bodies are closest.
class CollisionDisplay : public QObject {
  Q_OBJECT

 public:
  /// Makes the label; a window takes it over. @param monitor outlives it, as do the others.
  CollisionDisplay(CollisionMonitor& monitor, SceneView& view, QObject* parent = nullptr);

  [[nodiscard]] CollisionLabel* label() const { return label_; }
  /// The switch of the line between the bodies that are closest.
  [[nodiscard]] QAction* closest_shown() const { return closest_shown_; }
  /// Resets for another scene, without a result yet.
  void show_scene();

 signals:
  void failed(const QString& message);

 private:
  SceneView& view_;
  CollisionLabel* label_;
  QAction* closest_shown_;
};

}  // namespace handway::gui
