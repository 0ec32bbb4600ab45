#pragma once

#include "handway/device/glove/glove_calibration.h"

#include <QComboBox>

#include <optional>

namespace handway::gui {

/// Which calibration turns counts into angles: the typical one, or one from a file.
class CalibrationChoice : public QComboBox {
  Q_OBJECT

 public:
  explicit CalibrationChoice(QWidget* parent = nullptr);

  /// @throws geometric::InputError if it is none.
  void load(const QString& file);

 signals:
  /// Nothing: the typical one.
  void chosen(const std::optional<handway::device::GloveCalibration>& calibration);
  void failed(const QString& message);

 private:
  void choose(int index);

  int last_ = 0;
};

}  // namespace handway::gui
