#pragma once

#include "handway/geometric/mesh/shape.h"

#include <QPoint>
#include <QString>
#include <QWidget>

#include <Eigen/Core>

namespace handway::gui {

/// What is written over a 3-D view: the names of its axes cross, which stands in
/// the lower left corner, and a note beside the pointer. Mouse events go through it.
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

}  // namespace handway::gui
