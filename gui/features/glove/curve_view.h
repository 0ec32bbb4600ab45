#pragma once

#include "handway/device/glove/hand_mapping.h"

#include <QPointF>
#include <QRectF>
#include <QWidget>

#include <optional>
#include <vector>

class QPainter;

namespace handway::gui {

/// What a wire makes of its sensor, as a curve to be drawn with the mouse: a click beside its
/// points adds one (to a straight wire, too), dragging moves one, a right click takes one away.
class CurveView : public QWidget {
  Q_OBJECT

 public:
  explicit CurveView(QWidget* parent = nullptr);

  /// @param lower, upper limits of the joint, rad.
  void set_wire(const device::JointWire& wire, double lower, double upper);
  /// Where the sensor is now, rad; NaN: unknown.
  void show_sensor(double angle);

  /// Where in the widget a sensor's angle and a joint's angle (rad) are drawn.
  [[nodiscard]] QPointF place_of(double angle, double joint) const;

  [[nodiscard]] QSize sizeHint() const override { return {240, 132}; }

 signals:
  void edited(const handway::device::JointWire& wire);

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
  void tell();

  device::JointWire wire_;
  double lower_ = 0.0;
  double upper_ = 1.0;
  double sensor_;
  std::optional<std::size_t> dragged_;
};

}  // namespace handway::gui
