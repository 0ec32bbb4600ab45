#pragma once

#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <QPointF>
#include <QString>
#include <QWidget>

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace handway::gui {

/// Two axes of a PMD basis as a plane: postures as dots, the box B^h, and the hand's own
/// posture as a handle that can be dragged within the box.
class PmdPad : public QWidget {
  Q_OBJECT

 public:
  struct Axis {
    QString name;
    double half_side = 0.0;  ///< λ, normalised.
  };

  explicit PmdPad(QWidget* parent = nullptr);

  /// Clears the pad and shows the reason.
  void clear(const QString& reason);
  void set_axes(const Axis& x, const Axis& y);
  /// @param dots coordinates of postures along both axes.
  void set_dots(std::vector<QPointF> dots);
  /// Sets the coordinates of the hand's posture.
  void set_posture(const QPointF& coordinates);
  [[nodiscard]] const QPointF& posture() const { return posture_; }

  /// Pixel of a point of the plane.
  [[nodiscard]] QPointF to_pixel(const QPointF& coordinates) const;

  [[nodiscard]] QSize sizeHint() const override { return {300, 260}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {160, 150}; }

 signals:
  /// Dragged or clicked there; within the box.
  void moved(const QPointF& coordinates);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  [[nodiscard]] QRectF plane() const;
  [[nodiscard]] QPointF from_pixel(const QPointF& pixel) const;
  void drag_to(const QPointF& pixel);
  void fit_extent();
  void paint_frame(QPainter& painter) const;

  Axis x_;
  Axis y_;
  QString reason_;
  std::vector<QPointF> dots_;
  QPointF posture_;
  double extent_x_ = 1.0;  ///< Coordinate at the right edge.
  double extent_y_ = 1.0;
};

/// The axes of a PMD basis on the hand of a robot: postures to coordinates and back.
class HandAxes {
 public:
  HandAxes() = default;
  /// The axes are empty if the robot lacks a joint of the basis.
  HandAxes(std::shared_ptr<const geometric::RobotModel> model, sampling::PmdBasis basis);

  [[nodiscard]] bool empty() const { return variables_.empty(); }
  [[nodiscard]] const sampling::PmdBasis& basis() const { return basis_; }
  [[nodiscard]] int dimension() const { return empty() ? 0 : basis_.dimension(); }
  [[nodiscard]] QString name(int axis) const;
  [[nodiscard]] double half_side(int axis) const;

  /// @param q shape [variable_count]. @returns shape [dimension].
  [[nodiscard]] Eigen::VectorXd coordinates(const geometric::Configuration& q) const;
  /// @param posture normalised joints named `joints`. @returns shape [dimension]; empty if
  /// one of the basis' joints is not among them.
  [[nodiscard]] Eigen::VectorXd coordinates(const std::vector<std::string>& joints,
                                            const Eigen::VectorXd& posture) const;
  /// The hand's posture at coordinates within the box.
  [[nodiscard]] geometric::NamedPosture posture(const Eigen::VectorXd& coordinates) const;

 private:
  std::shared_ptr<const geometric::RobotModel> model_;
  sampling::PmdBasis basis_;
  std::vector<int> variables_;  ///< Variables of the basis' joints.
};

}  // namespace handway::gui
