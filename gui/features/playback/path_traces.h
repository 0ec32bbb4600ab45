#pragma once

#include "model/jobs/background.h"

#include <QObject>

#include <memory>

class QAction;
class QMenu;

namespace handway::gui {

class Document;
class PathPlayer;
class SceneView;

/// Traces of a path in the view: the paths of the fingertips, postures along the path, or the swept
/// volume of the robot.
class PathTraces : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. @param menu gets the actions that switch them.
  PathTraces(Document& document, PathPlayer& player, SceneView& view, QMenu& menu,
             QObject* parent = nullptr);

  [[nodiscard]] QAction& trails() const { return *trails_; }
  [[nodiscard]] QAction& postures() const { return *postures_; }
  [[nodiscard]] QAction& volume() const { return *volume_; }
  /// Returns whether a volume is still being computed.
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

 private:
  QAction* add(QMenu& menu, const QString& name, const QString& text, const QString& tip);
  void update_all();
  void update_trails();
  void update_veil();
  void find_volume();

  Document& document_;
  PathPlayer& player_;
  SceneView& view_;
  QAction* trails_;
  QAction* postures_;
  QAction* volume_;
  LatestJob job_;
};

}  // namespace handway::gui
