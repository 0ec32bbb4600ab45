#include "features/glove/pmd_pad.h"

#include "features/glove/joint_label.h"
#include "handway/geometric/robot/composed_robot.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

constexpr int kSide = 1;         // px, left and right of the plane
constexpr int kAbove = 2;        // px
constexpr int kBelow = 2;        // px
constexpr double kRoom = 1.18;   // plane over box
constexpr double kHandle = 7.0;  // px, radius
constexpr double kDot = 1.6;     // px, radius

}  // namespace

PmdPad::PmdPad(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("pmd_pad"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setCursor(Qt::CrossCursor);
  setToolTip(tr("Drag to move the hand along both axes; the planner samples in the box"));
}

void PmdPad::clear(const QString& reason) {
  reason_ = reason;
  x_ = y_ = {};
  dots_.clear();
  update();
}

void PmdPad::set_axes(const Axis& x, const Axis& y) {
  reason_.clear();
  x_ = x;
  y_ = y;
  dots_.clear();
  fit_extent();
}

void PmdPad::set_dots(std::vector<QPointF> dots) {
  dots_ = std::move(dots);
  fit_extent();
}

void PmdPad::set_posture(const QPointF& coordinates) {
  posture_ = coordinates;
  update();
}

void PmdPad::fit_extent() {
  extent_x_ = x_.half_side;
  extent_y_ = y_.half_side;
  for (const QPointF& dot : dots_) {
    extent_x_ = std::max(extent_x_, std::abs(dot.x()));
    extent_y_ = std::max(extent_y_, std::abs(dot.y()));
  }
  extent_x_ = std::max(extent_x_, 1e-6) * kRoom;
  extent_y_ = std::max(extent_y_, 1e-6) * kRoom;
  update();
}

QRectF PmdPad::plane() const { return QRectF(rect()).adjusted(kSide, kAbove, -kSide, -kBelow); }

QPointF PmdPad::to_pixel(const QPointF& coordinates) const {
  const QRectF area = plane();
  return {area.center().x() + coordinates.x() / extent_x_ * area.width() / 2.0,
          area.center().y() - coordinates.y() / extent_y_ * area.height() / 2.0};
}

QPointF PmdPad::from_pixel(const QPointF& pixel) const {
  const QRectF area = plane();
  return {(pixel.x() - area.center().x()) / area.width() * 2.0 * extent_x_,
          -(pixel.y() - area.center().y()) / area.height() * 2.0 * extent_y_};
}

void PmdPad::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) {
    drag_to(event->localPos());
  }
}

void PmdPad::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) {
    drag_to(event->localPos());
  }
}

void PmdPad::drag_to(const QPointF& pixel) {
  if (!reason_.isEmpty()) {
    return;
  }
  const QPointF point = from_pixel(pixel);
  posture_ = {std::clamp(point.x(), -x_.half_side, x_.half_side),
              std::clamp(point.y(), -y_.half_side, y_.half_side)};
  update();
  emit moved(posture_);
}

void PmdPad::paint_frame(QPainter& painter) const {
  const ThemeColors colors = colors_of(current_theme());
  const QRectF area = plane();
  painter.setPen(QPen(colors.border, 1.0));
  painter.setBrush(faded(colors.window, 0.6));
  painter.drawRoundedRect(area, 5.0, 5.0);
  const QPointF middle = to_pixel({0.0, 0.0});
  painter.setPen(QPen(faded(colors.muted, 0.45), 1.0, Qt::DashLine));
  painter.drawLine(QPointF(area.left(), middle.y()), QPointF(area.right(), middle.y()));
  painter.drawLine(QPointF(middle.x(), area.top()), QPointF(middle.x(), area.bottom()));
}

void PmdPad::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!reason_.isEmpty()) {
    const QRectF area = plane();
    painter.setPen(QPen(colors.border, 1.0, Qt::DashLine));
    painter.drawRoundedRect(area, 5.0, 5.0);
    painter.setPen(colors.muted);
    painter.drawText(area.adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap, reason_);
    return;
  }
  paint_frame(painter);
  painter.setClipRect(plane());
  const QRectF box(to_pixel({-x_.half_side, y_.half_side}),
                   to_pixel({x_.half_side, -y_.half_side}));
  painter.setPen(QPen(colors.accent, 1.4));
  painter.setBrush(faded(colors.accent, 0.07));
  painter.drawRect(box);
  painter.setPen(Qt::NoPen);
  painter.setBrush(faded(colors.muted, 0.5));
  for (const QPointF& dot : dots_) {
    painter.drawEllipse(to_pixel(dot), kDot, kDot);
  }
  set_text_size(painter, 11);
  painter.setPen(colors.muted);
  const QRectF area = plane().adjusted(6, 3, -6, -3);
  const QPointF middle = to_pixel({0.0, 0.0});
  painter.drawText(QRectF(area.left(), middle.y() - scaled(16), area.width(), scaled(15)),
                   Qt::AlignRight | Qt::AlignVCenter, x_.name);
  painter.drawText(QRectF(middle.x() + 5, area.top(), area.width() / 2, scaled(15)),
                   Qt::AlignLeft | Qt::AlignVCenter, y_.name);
  painter.setPen(colors.accent);
  painter.drawText(
      QRectF(box.left() + 5, box.bottom() - scaled(18), box.width() - 10, scaled(16)),
      Qt::AlignLeft | Qt::AlignVCenter,
      QStringLiteral("±%1 × ±%2").arg(x_.half_side, 0, 'f', 2).arg(y_.half_side, 0, 'f', 2));
  painter.setPen(QPen(colors.surface, 2.0));
  painter.setBrush(colors.accent);
  painter.drawEllipse(to_pixel(posture_), kHandle, kHandle);
}

HandAxes::HandAxes(std::shared_ptr<const geometric::RobotModel> model, sampling::PmdBasis basis)
    : model_(std::move(model)), basis_(std::move(basis)) {
  for (const std::string& joint : basis_.joints) {
    const auto variable = model_ ? geometric::find_variable_of_part(*model_, joint) : std::nullopt;
    if (!variable) {
      variables_.clear();
      return;
    }
    variables_.push_back(*variable);
  }
}

QString HandAxes::name(int axis) const {
  const auto index = static_cast<std::size_t>(axis);
  const std::size_t free = basis_.free_joints.size();
  return index < free
             ? joint_label(basis_.joints[static_cast<std::size_t>(basis_.free_joints[index].joint)])
             : QString::fromStdString(basis_.directions[index - free].name);
}

double HandAxes::half_side(int axis) const {
  const auto index = static_cast<std::size_t>(axis);
  const std::size_t free = basis_.free_joints.size();
  return index < free ? basis_.free_joints[index].half_side
                      : basis_.directions[index - free].half_side;
}

Eigen::VectorXd HandAxes::coordinates(const geometric::Configuration& q) const {
  const geometric::Configuration p = geometric::normalised(*model_, q);
  Eigen::VectorXd posture(static_cast<Eigen::Index>(variables_.size()));
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    posture[static_cast<Eigen::Index>(i)] = p[variables_[i]];
  }
  return sampling::project(basis_, posture);
}

Eigen::VectorXd HandAxes::coordinates(const std::vector<std::string>& joints,
                                      const Eigen::VectorXd& posture) const {
  Eigen::VectorXd ordered(static_cast<Eigen::Index>(basis_.joints.size()));
  for (std::size_t i = 0; i < basis_.joints.size(); ++i) {
    const auto found = std::ranges::find(joints, basis_.joints[i]);
    if (found == joints.end()) {
      return {};
    }
    ordered[static_cast<Eigen::Index>(i)] = posture[found - joints.begin()];
  }
  return sampling::project(basis_, ordered);
}

geometric::NamedPosture HandAxes::posture(const Eigen::VectorXd& coordinates) const {
  Eigen::VectorXd u(dimension());
  for (int axis = 0; axis < dimension(); ++axis) {
    const double side = half_side(axis);
    u[axis] = side > 0.0 ? std::clamp(0.5 * (coordinates[axis] / side + 1.0), 0.0, 1.0) : 0.5;
  }
  const Eigen::VectorXd p = sampling::map_to_posture(basis_, u);
  geometric::NamedPosture posture;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const double lower = model_->lower()[variables_[i]];
    const double upper = model_->upper()[variables_[i]];
    posture.values[basis_.joints[i]] = lower + p[static_cast<Eigen::Index>(i)] * (upper - lower);
  }
  return posture;
}

}  // namespace handway::gui
