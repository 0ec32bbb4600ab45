#pragma once

#include "handway/geometric/robot/robot_description.h"

#include <QObject>

#include <Eigen/Core>

namespace handway::gui {

class Document;
class GlovePanel;
class JointPanel;
class PathPlayer;
class PmdPanel;
class PostureBar;
struct SceneItem;

/// All that moves the robot by hand: named postures, joint sliders, principal motion directions
/// and the glove. Each shows the document's posture; whichever is touched sets it.
class Posing : public QObject {
  Q_OBJECT

 public:
  /// Makes the panels; a window takes them over.
  Posing(Document& document, PathPlayer& player, QObject* parent = nullptr);

  [[nodiscard]] PostureBar* postures() const { return postures_; }
  [[nodiscard]] JointPanel* joints() const { return joints_; }
  [[nodiscard]] PmdPanel* hand() const { return hand_; }
  [[nodiscard]] GlovePanel* glove() const { return glove_; }

  /// Shows the document's robot, which may be another than before.
  void show_robot();
  /// Pauses what is played, then shows this posture.
  void set(const Eigen::VectorXd& q);
  void apply(const geometric::NamedPosture& posture);
  /// Of a link of the robot the slider of its joint comes to the front.
  void show_item(const SceneItem& item) const;

 private:
  void connect_panels();

  Document& document_;
  PathPlayer& player_;
  PostureBar* postures_;
  JointPanel* joints_;
  PmdPanel* hand_;
  GlovePanel* glove_;
};

}  // namespace handway::gui
