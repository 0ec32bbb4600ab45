#pragma once

#include "handway/geometric/scene/scene.h"

#include <QWidget>

#include <memory>

class QMenu;
class QPushButton;
class QToolButton;

namespace handway::gui {

/// Buttons that move the first robot to start, goal or a named posture, of the scene or of the
/// robot's own files.
class PostureBar : public QWidget {
  Q_OBJECT

 public:
  explicit PostureBar(QWidget* parent = nullptr);

  /// Null: no scene.
  void set_scene(const std::shared_ptr<const geometric::Scene>& scene);

 signals:
  void start_requested();
  void goal_requested();
  void posture_requested(const handway::geometric::NamedPosture& posture);
  void keep_requested();
  void forget_requested(const QString& name);

 private:
  void list_postures(const geometric::Scene& scene);

  QPushButton* start_;
  QPushButton* goal_;
  QPushButton* postures_;
  QMenu* menu_;
};

}  // namespace handway::gui
