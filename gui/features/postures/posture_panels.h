#pragma once

#include "handway/geometric/scene/scene.h"

#include <QObject>
#include <QWidget>

#include <memory>

class QMenu;
class QPushButton;
class QToolButton;

namespace handway::gui {

class Document;
class JointPanel;
class PmdPanel;
class Posing;
struct SceneItem;

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

/// Named postures, joint sliders, and principal motion directions. Each shows the document's
/// posture; whichever is touched sets it.
class PosturePanels : public QObject {
  Q_OBJECT

 public:
  /// Makes the panels; a window takes them over. Both outlive them.
  PosturePanels(Document& document, Posing& posing, QObject* parent = nullptr);

  [[nodiscard]] PostureBar* postures() const { return postures_; }
  [[nodiscard]] JointPanel* joints() const { return joints_; }
  [[nodiscard]] PmdPanel* hand() const { return hand_; }

  /// Shows the document's robot, which may be another than before.
  void show_robot();
  /// Of a link of the robot the slider of its joint comes to the front.
  void show_item(const SceneItem& item) const;

 private:
  Document& document_;
  PostureBar* postures_;
  JointPanel* joints_;
  PmdPanel* hand_;
};

}  // namespace handway::gui
