#pragma once

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "model/devices/glove_session.h"

#include <QPointF>
#include <QWidget>

#include <optional>
#include <vector>

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

}  // namespace handway::gui
