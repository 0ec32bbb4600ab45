#pragma once

#include "handway/geometric/math/pose.h"

#include <QWidget>

#include <array>

namespace handway::gui {

class QuantityField;

/// Position and roll, pitch, yaw of a pose, typed.
class PoseForm : public QWidget {
  Q_OBJECT

 public:
  explicit PoseForm(QWidget* parent = nullptr);

  void show_pose(const geometric::Pose& X);
  void set_editable(bool editable);

 signals:
  /// What was not typed stays exactly as shown.
  void pose_edited(const handway::geometric::Pose& X);

 private:
  std::array<QuantityField*, 3> position_;
  std::array<QuantityField*, 3> rotation_;
  geometric::Pose X_ = geometric::Pose::Identity();
};

}  // namespace handway::gui
