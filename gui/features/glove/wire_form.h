#pragma once

#include "handway/device/glove/hand_mapping.h"

#include <QString>
#include <QWidget>

#include <optional>
#include <vector>

class QComboBox;
class QLabel;
class QLineEdit;

namespace handway::gui {

/// A number as people write it: "-0.5" or "-1/3". Nothing if it is none.
[[nodiscard]] std::optional<double> parse_ratio(const QString& text);

/// A curve as people write it: "0:-4, 45:-52" are pairs of sensor and joint in degrees.
/// Nothing if it is none: fewer than two pairs, or angles that don't rise.
[[nodiscard]] std::optional<std::vector<device::CurvePoint>> parse_curve(const QString& text);
[[nodiscard]] QString curve_text(const std::vector<device::CurvePoint>& curve);

/// One wire of a mapping: sensor, gain, offset or curve, or where a joint without sensor is.
class WireForm : public QWidget {
  Q_OBJECT

 public:
  explicit WireForm(QWidget* parent = nullptr);

  void set_wire(const device::JointWire& wire);

 signals:
  void edited(const handway::device::JointWire& wire);

 private:
  void take();
  void show_parts();
  void mark(QLineEdit& field, bool good);

  device::JointWire wire_;
  QLabel* joint_;
  QComboBox* sensor_;
  QLineEdit* gain_;
  QLineEdit* offset_;
  QLineEdit* curve_;
  QLineEdit* fixed_;
  QWidget* line_part_;
  QWidget* curve_part_;
  QWidget* fixed_part_;
};

}  // namespace handway::gui
