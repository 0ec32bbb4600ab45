#pragma once

#include "handway/geometric/math/pose.h"
#include "widgets/forms/quantity_field.h"

#include <QWidget>

#include <array>

class QLabel;

namespace handway::gui {

/// Position and roll, pitch, yaw of a pose, typed.
class PoseForm : public QWidget {
  Q_OBJECT

 public:
  explicit PoseForm(QWidget* parent = nullptr);

  void show_pose(const geometric::Pose& X);
  void set_editable(bool editable);
  [[nodiscard]] QSize minimumSizeHint() const override;

 signals:
  /// Emitted with the edited pose. Values that were not typed are exactly those that were shown.
  void pose_edited(const handway::geometric::Pose& X);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// @param narrow the rotation below the position, not beside it.
  void arrange(bool narrow);
  [[nodiscard]] int width_of_columns() const;

  std::array<QuantityField*, 3> position_;
  std::array<QuantityField*, 3> rotation_;
  geometric::Pose X_ = geometric::Pose::Identity();
  std::array<QLabel*, 6> labels_{};  ///< Labels of position, then of rotation.
  bool is_narrow_ = false;
};

}  // namespace handway::gui
