#pragma once

#include "handway/device/glove/hand_mapping.h"

#include <QPointF>
#include <QRectF>
#include <QString>
#include <QWidget>

#include <optional>
#include <vector>

class QPainter;

class QComboBox;
class QLabel;
class QLineEdit;

namespace handway::gui {

/// View of the curve from a sensor to its joint, which is edited with the mouse: a click beside its
/// points adds one (to a straight line, too), dragging moves one, a right click removes one.
class CurveView : public QWidget {
  Q_OBJECT

 public:
  explicit CurveView(QWidget* parent = nullptr);

  /// @param lower, upper limits of the joint, rad.
  void set_joint_mapping(const device::JointMapping& mapped, double lower, double upper);
  /// Shows the present angle of the sensor, rad; NaN: unknown.
  void show_sensor(double angle);

  /// Returns the position in the widget of a sensor's angle and a joint's angle (rad).
  [[nodiscard]] QPointF place_of(double angle, double joint) const;

  [[nodiscard]] QSize sizeHint() const override { return {240, 132}; }

 signals:
  void edited(const handway::device::JointMapping& mapped);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  [[nodiscard]] QRectF area() const;
  /// The point of the widget as a point of the curve, in whole degrees within the axes.
  [[nodiscard]] device::CurvePoint point_at(const QPointF& place) const;
  [[nodiscard]] double joint_at(double angle) const;
  [[nodiscard]] std::optional<std::size_t> point_near(const QPointF& place) const;
  [[nodiscard]] std::size_t add_point(const device::CurvePoint& point);
  void paint_axes(QPainter& painter) const;
  void notify();

  device::JointMapping mapped_;
  double lower_ = 0.0;
  double upper_ = 1.0;
  double sensor_;
  std::optional<std::size_t> dragged_;
};

/// Parses a number in the usual notation: "-0.5" or "-1/3". Returns nothing if it is none.
[[nodiscard]] std::optional<double> parse_ratio(const QString& text);

/// Parses a curve: "0:-4, 45:-52" are pairs of sensor and joint in degrees. Returns nothing if it
/// is none: fewer than two pairs, or angles that don't rise.
[[nodiscard]] std::optional<std::vector<device::CurvePoint>> parse_curve(const QString& text);
[[nodiscard]] QString curve_text(const std::vector<device::CurvePoint>& curve);

/// Returns the tooltip of a sensor: what it measures, its positive direction, and its typical
/// range.
[[nodiscard]] QString sensor_tip(int sensor);

/// Form of one joint mapping: sensor, gain, offset or curve, or where a joint without sensor is.
class JointMappingForm : public QWidget {
  Q_OBJECT

 public:
  explicit JointMappingForm(QWidget* parent = nullptr);

  void set_joint_mapping(const device::JointMapping& mapped);

 signals:
  void edited(const handway::device::JointMapping& mapped);

 private:
  void take();
  void show_parts();
  void mark(QLineEdit& field, bool good);

  device::JointMapping mapped_;
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
