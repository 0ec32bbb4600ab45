#pragma once

#include "handway/device/tracker/tool_follower.h"

#include <QWidget>

#include <array>
#include <optional>

class QCheckBox;
class QDoubleSpinBox;
class QSpinBox;

namespace handway::gui {

class QuantityField;

/// How the arm follows the wrist: scale, turn, direction of the source, smoothing, speed and
/// workspace.
class FollowForm : public QWidget {
  Q_OBJECT

 public:
  explicit FollowForm(QWidget* parent = nullptr);

  [[nodiscard]] device::ToolFollowerSettings settings() const;
  /// The sensor that leads; nothing for whichever speaks first.
  [[nodiscard]] std::optional<int> sensor() const;
  /// Whether the sensor's button closes the clutch.
  [[nodiscard]] bool button_closes() const;
  /// Puts the box around a point of the base frame, m, as long as it is off.
  void centre_box(const Eigen::Vector3d& p_B);

 signals:
  void settings_edited();

 private:
  QWidget* build_motion();
  QWidget* build_workspace();

  QSpinBox* sensor_;
  QCheckBox* button_;
  QDoubleSpinBox* scale_;
  QCheckBox* turn_;
  QuantityField* source_yaw_;
  QSpinBox* smoothing_;
  QuantityField* speed_;
  QCheckBox* box_;
  QWidget* box_fields_;
  std::array<QuantityField*, 3> least_{};
  std::array<QuantityField*, 3> most_{};
  QCheckBox* limits_reach_;
  QuantityField* reach_;
};

}  // namespace handway::gui
