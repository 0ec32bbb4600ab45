#pragma once

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/robot/robot_model.h"
#include "model/devices/glove_session.h"
#include "model/jobs/background.h"

#include <QPointF>
#include <QWidget>

#include <Eigen/Core>

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

class QLabel;
class QLineEdit;
class QPushButton;
class QUndoStack;

namespace handway::gui {

/// A mapping as wires from sensors, left, to joints, right. A wire is laid by dragging from a
/// sensor to a joint; a click on a joint selects it. Bars behind the names show what goes in
/// and what comes out.
class MappingWires : public QWidget {
  Q_OBJECT

 public:
  explicit MappingWires(QWidget* parent = nullptr);

  void set_mapping(const device::HandMapping& mapping);
  void select(int joint);
  [[nodiscard]] int selected() const { return selected_; }
  /// @param mapper of the sample's posture.
  void show_sample(const GloveSample& sample, const device::HandMapper& mapper);

  /// Returns the place to press or release the mouse on for this sensor's connection.
  [[nodiscard]] QPointF sensor_handle(int sensor) const;
  [[nodiscard]] QPointF joint_handle(int joint) const;

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 signals:
  void connected(int joint, int sensor);
  void selected_changed(int joint);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  /// Shows the tool tip of the sensor under the mouse.
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] std::optional<int> sensor_at(const QPointF& position) const;
  [[nodiscard]] std::optional<int> joint_at(const QPointF& position) const;
  void paint_wire(QPainter& painter, const QPointF& from, const QPointF& to, bool strong) const;
  void paint_sensors(QPainter& painter) const;
  void paint_joints(QPainter& painter) const;

  device::HandMapping mapping_;
  std::vector<double> outputs_;  ///< Joints in their ranges, [0, 1]; -1: not known.
  std::optional<device::GloveFrame> input_;
  int selected_ = 0;
  std::optional<int> dragged_;  ///< Sensor.
  QPointF pointer_;
};

class CurveView;
class JointMappingForm;

/// Comparison of two mappings of the same motion of a glove.
struct MappingComparison {
  Eigen::VectorXd shares_a;  ///< Shares of variance, falling.
  Eigen::VectorXd shares_b;
  /// Angles between the spaces of the first k directions, rad; entry k-1. Only joints in both are
  /// considered.
  Eigen::VectorXd angles;
};

/// @param frames at least two.
/// @param left_out names of joints that take no part in the principal components.
/// @throws geometric::InputError if a mapping does not fit the robot.
[[nodiscard]] MappingComparison compare_mappings(const std::vector<device::GloveAngles>& frames,
                                                 const device::HandMapping& a,
                                                 const device::HandMapping& b,
                                                 const geometric::RobotModel& model,
                                                 const std::vector<std::string>& left_out);

/// Edits which sensor drives which joint, while the glove moves the hand with it, and compares
/// the mapping with another by what both make of the same motion.
class MappingEditor : public QWidget {
  Q_OBJECT

 public:
  /// @param history where changes of the mapping can be undone; used no more once the editor is
  /// gone. Both outlive it.
  MappingEditor(GloveSession& session, QUndoStack& history, QWidget* parent = nullptr);

  /// @param free joints of the hand's basis, which take no part in comparisons.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model, std::vector<std::string> free);
  void show_samples(const std::vector<GloveSample>& samples);

  /// @throws geometric::InputError if it is no mapping or can't be written.
  void open(const std::filesystem::path& file);
  void save(const std::filesystem::path& file) const;
  /// All joints fixed, to begin by hand.
  void clear();
  /// A mapping that is proposed for the hand of the scene.
  void propose();
  /// Fits signs and ranges to what a person's hand went through, in the background; another hand or
  /// mapping meanwhile ends it without effect.
  /// @param recording of angles.
  void fit(const device::Recording& recording);
  void compare_with(const device::HandMapping& other, const QString& name);
  [[nodiscard]] QString comparison() const;

 signals:
  void failed(const QString& message);

 private:
  QWidget* build_buttons();
  /// Takes another mapping, as an edit that can be undone.
  void change(const QString& text, const device::HandMapping& mapping);
  void use(const device::HandMapping& mapping);
  void change_joint_mapping(const device::JointMapping& mapped);
  void show_joint_mapping(const device::JointMapping& mapped);
  void refresh();
  void choose_to_open();
  void choose_to_save();
  void choose_to_compare();
  void choose_to_fit();
  /// @param recording called in the background; may throw.
  void start_fit(std::function<device::Recording()> recording);
  void show_fitting();

  GloveSession& session_;
  QUndoStack& history_;
  std::shared_ptr<const geometric::RobotModel> model_;
  std::vector<std::string> free_;
  std::deque<device::GloveAngles> motion_;
  int stride_ = 0;
  MappingWires* wires_;
  JointMappingForm* form_;
  CurveView* curve_;
  QLineEdit* source_;
  QLabel* comparison_;
  QPushButton* choices_;  ///< The menu of what can be done with a mapping.
  LatestJob fitting_;
};

}  // namespace handway::gui
