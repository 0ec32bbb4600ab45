#pragma once

#include <QPointF>
#include <QString>
#include <QWidget>

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

  /// Nothing to show, and why.
  void clear(const QString& reason);
  void set_axes(const Axis& x, const Axis& y);
  /// @param dots coordinates of postures along both axes.
  void set_dots(std::vector<QPointF> dots);
  /// Where the hand is.
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

}  // namespace handway::gui
