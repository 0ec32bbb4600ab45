#include "features/glove/mapping_wires.h"

#include "features/glove/joint_label.h"
#include "features/glove/joint_mapping_form.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kRow = 16;
constexpr int kColumn = 116;  // px, of both columns
constexpr int kWireMargin = 12;
constexpr double kHandleRadius = 3.2;
constexpr double kMostCounts = 255.0;

QString label_of(int sensor) {
  const auto& about = device::cyberglove_sensors()[static_cast<std::size_t>(sensor)];
  return QStringLiteral("%1  %2")
      .arg(QLatin1Char(about.letter))
      .arg(QString::fromUtf8(about.label.data(), static_cast<int>(about.label.size())));
}

}  // namespace

MappingWires::MappingWires(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("mapping_wires"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(
      tr("Drag from a sensor to a joint to connect them; click a joint to edit its mapping"));
}

void MappingWires::set_mapping(const device::HandMapping& mapping) {
  mapping_ = mapping;
  outputs_.assign(mapping_.joints.size(), -1.0);
  selected_ = std::clamp(selected_, 0, std::max(0, static_cast<int>(mapping_.joints.size()) - 1));
  updateGeometry();
  update();
}

void MappingWires::select(int joint) {
  selected_ = joint;
  update();
}

void MappingWires::show_sample(const GloveSample& sample, const device::HandMapper& mapper) {
  input_ = sample.frame;
  for (std::size_t w = 0; w < mapping_.joints.size(); ++w) {
    const auto found = std::ranges::find(mapper.joints(), mapping_.joints[w].joint);
    const Eigen::Index j = found - mapper.joints().begin();
    if (found != mapper.joints().end() && j < sample.posture.size()) {
      const double range = mapper.upper()[j] - mapper.lower()[j];
      outputs_[w] = range > 0.0 ? (sample.posture[j] - mapper.lower()[j]) / range : 0.0;
    }
  }
  update();
}

QSize MappingWires::sizeHint() const {
  return {scaled(300), device::kGloveSensors * scaled(kRow) + 4};
}

QPointF MappingWires::sensor_handle(int sensor) const {
  return {kWireMargin + scaled(kColumn) + 6.0, (sensor + 0.5) * scaled(kRow)};
}

QPointF MappingWires::joint_handle(int joint) const {
  const double count = std::max(1.0, static_cast<double>(mapping_.joints.size()));
  const double step = device::kGloveSensors * scaled(kRow) / count;
  return {width() - kWireMargin - scaled(kColumn) - 6.0, (joint + 0.5) * step};
}

std::optional<int> MappingWires::sensor_at(const QPointF& position) const {
  const int sensor = static_cast<int>(position.y() / scaled(kRow));
  const bool inside =
      position.x() < sensor_handle(0).x() + 10.0 && sensor >= 0 && sensor < device::kGloveSensors;
  return inside ? std::optional(sensor) : std::nullopt;
}

std::optional<int> MappingWires::joint_at(const QPointF& position) const {
  for (int joint = 0; joint < static_cast<int>(mapping_.joints.size()); ++joint) {
    const QPointF handle = joint_handle(joint);
    if (position.x() > handle.x() - 10.0 &&
        std::abs(position.y() - handle.y()) < scaled(kRow) / 2.0) {
      return joint;
    }
  }
  return std::nullopt;
}

bool MappingWires::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    if (const auto sensor = sensor_at(help->pos())) {
      QToolTip::showText(help->globalPos(), sensor_tip(*sensor), this);
      return true;
    }
  }
  return QWidget::event(event);
}

void MappingWires::mousePressEvent(QMouseEvent* event) {
  pointer_ = event->localPos();
  dragged_ = sensor_at(pointer_);
  if (const auto joint = joint_at(pointer_)) {
    select(*joint);
    emit selected_changed(*joint);
  }
  update();
}

void MappingWires::mouseMoveEvent(QMouseEvent* event) {
  pointer_ = event->localPos();
  update();
}

void MappingWires::mouseReleaseEvent(QMouseEvent* event) {
  const auto joint = joint_at(event->localPos());
  const std::optional<int> sensor = std::exchange(dragged_, std::nullopt);
  if (sensor && joint) {
    select(*joint);
    emit selected_changed(*joint);
    emit connected(*joint, *sensor);
  }
  update();
}

void MappingWires::paint_wire(QPainter& painter, const QPointF& from, const QPointF& to,
                              bool strong) const {
  const ThemeColors colors = colors_of(current_theme());
  const double bend = (to.x() - from.x()) / 2.0;
  QPainterPath path(from);
  path.cubicTo(from + QPointF(bend, 0.0), to - QPointF(bend, 0.0), to);
  painter.setPen(strong ? QPen(colors.accent, 2.2) : QPen(faded(colors.muted, 0.7), 1.3));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(path);
}

void MappingWires::paint_sensors(QPainter& painter) const {
  const ThemeColors colors = colors_of(current_theme());
  for (int sensor = 0; sensor < device::kGloveSensors; ++sensor) {
    const bool used =
        std::ranges::count(mapping_.joints, sensor, &device::JointMapping::sensor) > 0;
    const QRectF cell(kWireMargin, sensor * scaled(kRow), scaled(kColumn), scaled(kRow));
    if (input_) {
      const double share = input_->counts.at(static_cast<std::size_t>(sensor)) / kMostCounts;
      painter.fillRect(QRectF(cell.left(), cell.top() + 2, cell.width() * share, scaled(kRow) - 4),
                       faded(used ? colors.accent : colors.muted, 0.16));
    }
    painter.setPen(used ? colors.text : colors.muted);
    painter.drawText(cell.adjusted(3, 0, 0, 0), Qt::AlignVCenter, label_of(sensor));
    painter.setPen(Qt::NoPen);
    painter.setBrush(used ? colors.accent : colors.border);
    painter.drawEllipse(sensor_handle(sensor), kHandleRadius, kHandleRadius);
  }
}

void MappingWires::paint_joints(QPainter& painter) const {
  const ThemeColors colors = colors_of(current_theme());
  for (std::size_t w = 0; w < mapping_.joints.size(); ++w) {
    const device::JointMapping& mapped = mapping_.joints[w];
    const bool driven = mapped.sensor >= 0;
    const QPointF handle = joint_handle(static_cast<int>(w));
    const QRectF cell(handle.x() + 6.0, handle.y() - scaled(kRow) / 2.0, scaled(kColumn),
                      scaled(kRow));
    if (outputs_[w] >= 0.0) {
      painter.fillRect(
          QRectF(cell.left(), cell.top() + 2, cell.width() * outputs_[w], scaled(kRow) - 4),
          faded(driven ? colors.accent : colors.muted, 0.16));
    }
    if (static_cast<int>(w) == selected_) {
      painter.setPen(QPen(colors.accent, 1.2));
      painter.setBrush(Qt::NoBrush);
      painter.drawRoundedRect(cell.adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
    }
    painter.setPen(driven ? colors.text : colors.muted);
    painter.drawText(cell.adjusted(5, 0, 0, 0), Qt::AlignVCenter, joint_label(mapped.joint));
    painter.setPen(Qt::NoPen);
    painter.setBrush(driven ? colors.accent : colors.border);
    painter.drawEllipse(handle, kHandleRadius, kHandleRadius);
  }
}

void MappingWires::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  set_text_size(painter, 11);
  for (std::size_t w = 0; w < mapping_.joints.size(); ++w) {
    if (mapping_.joints[w].sensor >= 0) {
      const int joint = static_cast<int>(w);
      paint_wire(painter, sensor_handle(mapping_.joints[w].sensor), joint_handle(joint),
                 joint == selected_);
    }
  }
  if (dragged_) {
    paint_wire(painter, sensor_handle(*dragged_), pointer_, true);
  }
  paint_sensors(painter);
  paint_joints(painter);
}

}  // namespace handway::gui
