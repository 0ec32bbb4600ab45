#pragma once

#include "view3d/cube_parts.h"

#include <QPoint>
#include <QWidget>

#include <Eigen/Core>

#include <optional>

namespace handway::gui {

/// A small cube in a corner of a 3-D view that turns as the view does. A click on a face, an edge
/// or a corner looks from there; dragging it turns the view.
class OrientationCube : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kSize = 104;  ///< Side of the widget, logical pixels.

  explicit OrientationCube(QWidget* view);

  /// @param R_WC columns: right, up and backwards of the camera, in the world.
  void set_orientation(const Eigen::Matrix3d& R_WC);
  /// Where a part is seen, if it is; for tests and guides.
  [[nodiscard]] std::optional<QPointF> place_of(const CubePart& part) const;
  /// The part under the pointer.
  [[nodiscard]] const std::optional<CubePart>& hot() const { return hot_; }

 signals:
  void chosen(const handway::gui::CubePart& part);
  /// The pointer has been dragged so far, logical pixels.
  void dragged(const QPoint& way);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  [[nodiscard]] std::optional<CubePart> part_at(const QPointF& place) const;
  [[nodiscard]] QPointF screen(const Eigen::Vector3d& p) const;
  void paint_face(QPainter& painter, const CubeFace& face) const;
  void set_hot(const std::optional<CubePart>& part);

  Eigen::Matrix3d R_WC_ = Eigen::Matrix3d::Identity();
  std::optional<CubePart> hot_;
  QPoint last_;
  bool pressed_ = false;
  bool dragging_ = false;
};

}  // namespace handway::gui
