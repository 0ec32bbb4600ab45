#pragma once

#include "handway/device/glove/glove_calibration.h"

#include <QComboBox>
#include <QString>

#include <optional>

namespace handway::gui {

/// Field to choose the calibration that converts counts to angles: the typical one, or one from a
/// file.
class CalibrationChoice : public QComboBox {
  Q_OBJECT

 public:
  explicit CalibrationChoice(QWidget* parent = nullptr);

  /// @throws geometric::InputError if it is none.
  void load(const QString& file);

 signals:
  /// Emitted with the chosen calibration; nothing: the typical one.
  void chosen(const std::optional<handway::device::GloveCalibration>& calibration);
  void failed(const QString& message);

 private:
  void choose(int index);

  int last_ = 0;
};

}  // namespace handway::gui
