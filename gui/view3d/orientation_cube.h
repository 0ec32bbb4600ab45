#pragma once

#include "handway/geometric/mesh/shape.h"

#include <QPoint>
#include <QString>
#include <QWidget>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// Text over a 3-D view: the names of its axes cross, which stands in the lower left corner, and a
/// note beside the pointer. Mouse events go through it.
class ViewOverlay : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kAxesSize = 100;  ///< Side of the axes cross' square, logical pixels.
  /// Height of that square in the cross' own units; its arrows are about 1 long.
  static constexpr double kAxesHeight = 2.9;

  explicit ViewOverlay(QWidget* view);

  void set_color(const geometric::Color& color);
  /// A few words beside the pointer; empty: none.
  void set_note(const QString& note, const QPoint& place);
  [[nodiscard]] const QString& note() const { return note_; }
  /// @param R_WC columns: right, up and backwards of the camera, in the world.
  void set_axes(const Eigen::Matrix3d& R_WC);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QColor color_;
  QString note_;
  QPoint note_place_;
  Eigen::Matrix3d R_WC_ = Eigen::Matrix3d::Identity();
};

/// A face, edge or corner of the cube with half edge 1, by the way towards it: components
/// -1, 0 or 1; one, two or three of them are not 0.
using CubePart = Eigen::Vector3i;

/// A face of the cube: its name, and as one reads it, what is right and up on it.
struct CubeFace {
  const char* name;
  CubePart normal;
  Eigen::Vector3d right;
  Eigen::Vector3d up;
};

/// The six, named as the standard views: the robot's front is +x, up is +z.
[[nodiscard]] const std::array<CubeFace, 6>& cube_faces();

/// Faces are divided into three by three fields at these places: corners, edges, the face itself.
inline constexpr std::array kCubeFields{-1.0, -0.62, 0.62, 1.0};

/// The part to which field (column, row), each 0 to 2 from lower left, of a face belongs.
[[nodiscard]] CubePart part_of_field(const CubeFace& face, int column, int row);

/// The part that is seen at a place. @param R_WC columns: right, up and backwards of the camera,
/// which sees in parallel. @param right, up from the cube's centre.
[[nodiscard]] std::optional<CubePart> cube_part_at(const Eigen::Matrix3d& R_WC, double right,
                                                   double up);

/// Direction of a turntable camera that looks at a part, rad.
struct CubeDirection {
  double azimuth;
  double elevation;
};
/// @param azimuth of the camera now; from above and below it turns to the nearest quarter.
[[nodiscard]] CubeDirection direction_of(const CubePart& part, double azimuth);

/// Returns the names of the faces that meet at a part, for display: "Top, front".
[[nodiscard]] std::vector<const char*> face_names(const CubePart& part);

/// A small cube in a corner of a 3-D view that turns as the view does. A click on a face, an edge
/// or a corner looks from there; dragging it turns the view.
class OrientationCube : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kSize = 104;  ///< Side of the widget, logical pixels.

  explicit OrientationCube(QWidget* view);

  /// @param R_WC columns: right, up and backwards of the camera, in the world.
  void set_orientation(const Eigen::Matrix3d& R_WC);
  /// Returns the position of a part if it is visible; for tests and guides.
  [[nodiscard]] std::optional<QPointF> place_of(const CubePart& part) const;
  /// The part under the pointer.
  [[nodiscard]] const std::optional<CubePart>& hot() const { return hot_; }

 signals:
  void chosen(const handway::gui::CubePart& part);
  /// The pointer has been dragged so far, logical pixels.
  void dragged(const QPoint& drag);

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
