#pragma once

#include "model/devices/executed_motion.h"

#include <QComboBox>
#include <QWidget>

class QComboBox;

namespace handway::gui {

class TimePlot;

/// One joint as planned and as measured, and below how far it was off; the joint can be chosen.
class FollowingPlot : public QWidget {
  Q_OBJECT

 public:
  explicit FollowingPlot(QWidget* parent = nullptr);

  /// Shows the joint that was farthest off first.
  void show_motion(std::shared_ptr<const ExecutedMotion> motion,
                   const geometric::RobotModel& model);
  void clear();

 private:
  void show_joint();

  std::shared_ptr<const ExecutedMotion> motion_;
  QComboBox* joints_;
  TimePlot* angles_;
  TimePlot* difference_;
};

}  // namespace handway::gui
