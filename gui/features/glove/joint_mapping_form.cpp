#include "features/glove/joint_mapping_form.h"

#include "features/glove/joint_label.h"
#include "handway/device/glove/angle_ranges.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/typed_input.h"
#include "widgets/style/color_math.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>
#include <limits>

namespace handway::gui {
namespace {

using device::CurvePoint;
using geometric::kDegree;

// Ranges of human joints and the sensors on them.
constexpr double kLeastSensor = -40.0 * kDegree;
constexpr double kMostSensor = 120.0 * kDegree;
constexpr double kBeyondLimits = 0.08;  // of the joint's range
constexpr double kNear = 9.0;           // px
constexpr double kCurveDot = 3.5;       // px
constexpr double kApart = 1.0 * kDegree;

double whole_degrees(double angle) { return std::round(angle / kDegree) * kDegree; }

}  // namespace

CurveView::CurveView(QWidget* parent)
    : QWidget(parent), sensor_(std::numeric_limits<double>::quiet_NaN()) {
  setObjectName(QStringLiteral("wire_curve_view"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setCursor(Qt::CrossCursor);
  setToolTip(
      tr("Joint angle over sensor angle. Click to add a point, drag to move it, right-click to "
         "remove it"));
}

void CurveView::set_joint_mapping(const device::JointMapping& mapped, double lower, double upper) {
  const bool same = mapped.joint == mapped_.joint && mapped.curve.size() == mapped_.curve.size();
  mapped_ = mapped;
  lower_ = lower;
  upper_ = std::max(upper, lower + kApart);
  if (!same) {
    dragged_.reset();
  }
  update();
}

void CurveView::show_sensor(double angle) {
  sensor_ = angle;
  update();
}

QRectF CurveView::area() const {
  return QRectF(rect()).adjusted(scaled(34), 6, -scaled(16), -scaled(18));
}

QPointF CurveView::place_of(double angle, double joint) const {
  const QRectF box = area();
  const double margin = kBeyondLimits * (upper_ - lower_);
  const double x = (angle - kLeastSensor) / (kMostSensor - kLeastSensor);
  const double y = (joint - lower_ + margin) / (upper_ - lower_ + 2.0 * margin);
  return {box.left() + x * box.width(), box.bottom() - y * box.height()};
}

CurvePoint CurveView::point_at(const QPointF& place) const {
  const QRectF box = area();
  const double margin = kBeyondLimits * (upper_ - lower_);
  const double x = (place.x() - box.left()) / box.width();
  const double y = (box.bottom() - place.y()) / box.height();
  const double joint = lower_ - margin + y * (upper_ - lower_ + 2.0 * margin);
  return {whole_degrees(std::clamp(kLeastSensor + x * (kMostSensor - kLeastSensor), kLeastSensor,
                                   kMostSensor)),
          std::clamp(whole_degrees(joint), lower_, upper_)};
}

double CurveView::joint_at(double angle) const {
  const std::vector<CurvePoint>& curve = mapped_.curve;
  if (curve.empty()) {
    return mapped_.gain * angle + mapped_.offset;
  }
  const auto after = std::ranges::upper_bound(curve, angle, std::less<>{},
                                              [](const CurvePoint& p) { return p.angle; });
  if (after == curve.begin() || after == curve.end()) {
    return after == curve.begin() ? curve.front().joint : curve.back().joint;
  }
  const CurvePoint& before = *(after - 1);
  const double share = (angle - before.angle) / (after->angle - before.angle);
  return before.joint + share * (after->joint - before.joint);
}

std::optional<std::size_t> CurveView::point_near(const QPointF& place) const {
  for (std::size_t i = 0; i < mapped_.curve.size(); ++i) {
    const QPointF offset = place_of(mapped_.curve[i].angle, mapped_.curve[i].joint) - place;
    if (std::hypot(offset.x(), offset.y()) < kNear) {
      return i;
    }
  }
  return std::nullopt;
}

// A straight mapping becomes a curve that is the same as far as the joint goes.
std::size_t CurveView::add_point(const CurvePoint& point) {
  std::vector<CurvePoint>& curve = mapped_.curve;
  if (curve.empty()) {
    double first = kLeastSensor;
    double last = kMostSensor;
    if (mapped_.gain != 0.0) {
      const double at_lower = (lower_ - mapped_.offset) / mapped_.gain;
      const double at_upper = (upper_ - mapped_.offset) / mapped_.gain;
      first = std::clamp(std::min(at_lower, at_upper), kLeastSensor, kMostSensor - kApart);
      last = std::clamp(std::max(at_lower, at_upper), first + kApart, kMostSensor);
    }
    const double first_joint = std::clamp(joint_at(first), lower_, upper_);
    const double last_joint = std::clamp(joint_at(last), lower_, upper_);
    curve = {{first, first_joint}, {last, last_joint}};
  }
  const auto after = std::ranges::find_if(
      curve, [&](const CurvePoint& other) { return other.angle > point.angle - kApart; });
  const auto index = static_cast<std::size_t>(after - curve.begin());
  if (after != curve.end() && after->angle < point.angle + kApart) {
    *after = {after->angle, point.joint};
    return index;
  }
  curve.insert(after, point);
  return index;
}

void CurveView::notify() {
  update();
  emit edited(mapped_);
}

void CurveView::mousePressEvent(QMouseEvent* event) {
  const QPointF place = event->localPos();
  const std::optional<std::size_t> near = point_near(place);
  if (event->button() == Qt::RightButton && near) {
    if (mapped_.curve.size() <= 2) {
      mapped_.curve.clear();
    } else {
      mapped_.curve.erase(mapped_.curve.begin() + static_cast<std::ptrdiff_t>(*near));
    }
    notify();
  } else if (event->button() == Qt::LeftButton) {
    dragged_ = near ? *near : add_point(point_at(place));
    if (!near) {
      notify();
    }
  }
}

void CurveView::mouseMoveEvent(QMouseEvent* event) {
  if (!dragged_ || !(event->buttons() & Qt::LeftButton) || *dragged_ >= mapped_.curve.size()) {
    return;
  }
  std::vector<CurvePoint>& curve = mapped_.curve;
  CurvePoint point = point_at(event->localPos());
  if (*dragged_ > 0) {
    point.angle = std::max(point.angle, curve[*dragged_ - 1].angle + kApart);
  }
  if (*dragged_ + 1 < curve.size()) {
    point.angle = std::min(point.angle, curve[*dragged_ + 1].angle - kApart);
  }
  curve[*dragged_] = point;
  notify();
}

void CurveView::mouseReleaseEvent(QMouseEvent* /*event*/) { dragged_.reset(); }

void CurveView::paint_axes(QPainter& painter) const {
  const ThemeColors colors = colors_of(current_theme());
  const QRectF box = area();
  painter.fillRect(QRectF(place_of(kLeastSensor, upper_), place_of(kMostSensor, lower_)),
                   faded(colors.accent, 0.06));
  set_text_size(painter, 10);
  for (double degrees = -30.0; degrees <= 120.0; degrees += 30.0) {
    const double x = place_of(degrees * kDegree, lower_).x();
    painter.setPen(QPen(faded(colors.border, degrees == 0.0 ? 1.0 : 0.6), 1.0));
    painter.drawLine(QPointF(x, box.top()), QPointF(x, box.bottom()));
    painter.setPen(colors.muted);
    painter.drawText(QRectF(x - scaled(20), box.bottom() + 2.0, scaled(40), scaled(14)),
                     Qt::AlignCenter, QStringLiteral("%1°").arg(degrees));
  }
  for (const double joint : {lower_, upper_}) {
    const double y = place_of(0.0, joint).y();
    painter.setPen(QPen(faded(colors.border, 0.9), 1.0));
    painter.drawLine(QPointF(box.left(), y), QPointF(box.right(), y));
    painter.setPen(colors.muted);
    painter.drawText(QRectF(0.0, y - scaled(7), box.left() - 5.0, scaled(14)),
                     Qt::AlignRight | Qt::AlignVCenter,
                     QStringLiteral("%1°").arg(joint / kDegree, 0, 'f', 0));
  }
}

void CurveView::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  paint_axes(painter);
  painter.setClipRect(
      area().adjusted(-kCurveDot - 1, -kCurveDot - 1, kCurveDot + 1, kCurveDot + 1));
  QPolygonF line;
  line << place_of(kLeastSensor, joint_at(kLeastSensor));
  for (const CurvePoint& point : mapped_.curve) {
    line << place_of(point.angle, point.joint);
  }
  line << place_of(kMostSensor, joint_at(kMostSensor));
  painter.setPen(QPen(colors.accent, 1.8));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolyline(line);
  painter.setBrush(colors.surface);
  for (const CurvePoint& point : mapped_.curve) {
    painter.drawEllipse(place_of(point.angle, point.joint), kCurveDot, kCurveDot);
  }
  if (std::isfinite(sensor_)) {
    const double joint = std::clamp(joint_at(sensor_), lower_, upper_);
    painter.setPen(Qt::NoPen);
    painter.setBrush(attention_color());
    painter.drawEllipse(place_of(sensor_, joint), kCurveDot, kCurveDot);
  }
}

namespace {

constexpr int kShownDigits = 6;

QString shown_number(double value) { return QString::number(value, 'g', kShownDigits); }

QLineEdit* field(const char* name) {
  auto* edit = new QLineEdit;
  edit->setObjectName(QLatin1String(name));
  edit->setMinimumWidth(scaled(40));
  return edit;
}

constexpr int kFixed = -1;  // data of the entries that are no sensors
constexpr int kOfArm = -2;

QWidget* row(std::initializer_list<QWidget*> parts) {
  auto* widget = new QWidget;
  auto* layout = new QHBoxLayout(widget);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  for (QWidget* part : parts) {
    layout->addWidget(part, qobject_cast<QLabel*>(part) ? 0 : 1);
  }
  return widget;
}

std::optional<double> parse_number(const QString& text) {
  bool good = false;
  const double value = QLocale::c().toDouble(text.trimmed(), &good);
  return good && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<double> parse_ratio(const QString& text) {
  const QStringList parts = text.split(QLatin1Char('/'));
  const auto above = parse_number(parts.front());
  if (parts.size() == 1 || !above) {
    return above;
  }
  const auto below = parts.size() == 2 ? parse_number(parts.back()) : std::nullopt;
  return below && *below != 0.0 ? std::optional(*above / *below) : std::nullopt;
}

std::optional<std::vector<device::CurvePoint>> parse_curve(const QString& text) {
  std::vector<device::CurvePoint> curve;
  for (const QString& pair : text.split(QLatin1Char(','))) {
    const QStringList parts = pair.split(QLatin1Char(':'));
    const auto angle = parts.size() == 2 ? parse_number(parts[0]) : std::nullopt;
    const auto joint = parts.size() == 2 ? parse_number(parts[1]) : std::nullopt;
    if (!angle || !joint || (!curve.empty() && *angle * geometric::kDegree <= curve.back().angle)) {
      return std::nullopt;
    }
    curve.push_back({*angle * geometric::kDegree, *joint * geometric::kDegree});
  }
  return curve.size() >= 2 ? std::optional(curve) : std::nullopt;
}

QString curve_text(const std::vector<device::CurvePoint>& curve) {
  QStringList pairs;
  for (const device::CurvePoint& point : curve) {
    pairs << QStringLiteral("%1:%2").arg(shown_number(point.angle / geometric::kDegree),
                                         shown_number(point.joint / geometric::kDegree));
  }
  return pairs.join(QStringLiteral(", "));
}

QString sensor_tip(int sensor) {
  const auto place = static_cast<std::size_t>(sensor);
  const device::GloveSensor& about = device::cyberglove_sensors()[place];
  const auto text = [](std::string_view words) {
    return QString::fromUtf8(words.data(), static_cast<int>(words.size()));
  };
  const auto& [least, most] = device::typical_angle_ranges().at(place);
  return QObject::tr("%1 (%2): %3; typically %4° to %5°")
      .arg(text(about.label), text(about.name), text(about.measures))
      .arg(least / kDegree, 0, 'f', 0)
      .arg(most / kDegree, 0, 'f', 0);
}

JointMappingForm::JointMappingForm(QWidget* parent)
    : QWidget(parent),
      joint_(new QLabel),
      sensor_(named("wire_sensor", new QComboBox)),
      gain_(field("wire_gain")),
      offset_(field("wire_offset")),
      curve_(field("wire_curve")),
      fixed_(field("wire_fixed")) {
  joint_->setTextFormat(Qt::RichText);
  sensor_->setMinimumContentsLength(6);
  sensor_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  sensor_->addItem(tr("Fixed, no sensor"), kFixed);
  sensor_->addItem(tr("Joint of the arm"), kOfArm);
  sensor_->setItemData(1,
                       tr("The hand does not move this joint: it is planned as a joint of the arm"),
                       Qt::ToolTipRole);
  for (int i = 0; i < static_cast<int>(device::cyberglove_sensors().size()); ++i) {
    const auto& sensor = device::cyberglove_sensors()[static_cast<std::size_t>(i)];
    sensor_->addItem(
        QStringLiteral("%1  %2")
            .arg(QLatin1Char(sensor.letter))
            .arg(QString::fromUtf8(sensor.label.data(), static_cast<int>(sensor.label.size()))),
        i);
    sensor_->setItemData(sensor_->count() - 1, sensor_tip(i), Qt::ToolTipRole);
  }
  gain_->setToolTip(tr("Joint angle per sensor angle; fractions such as -1/3 are accepted"));
  offset_->setToolTip(tr("Joint angle at sensor angle 0, degrees"));
  curve_->setToolTip(
      tr("Instead of gain and offset: SENSOR:JOINT pairs in degrees, interpolated linearly, for "
         "example 0:-4, 45:-52, 97:-75"));
  curve_->setPlaceholderText(tr("none"));
  fixed_->setToolTip(tr("Fixed value of the joint, degrees"));
  fixed_->setPlaceholderText(tr("middle of its range"));
  line_part_ = row({new QLabel(tr("Gain")), gain_, new QLabel(tr("Offset °")), offset_});
  curve_part_ = row({new QLabel(tr("Curve")), curve_});
  fixed_part_ = row({new QLabel(tr("At °")), fixed_});
  lay_out(*this, in_column({row({joint_, sensor_}), line_part_, curve_part_, fixed_part_}, 6));
  connect(sensor_, qOverload<int>(&QComboBox::currentIndexChanged), this, &JointMappingForm::take);
  for (QLineEdit* edit : {gain_, offset_, curve_, fixed_}) {
    connect(edit, &QLineEdit::editingFinished, this, [this, edit] {
      if (edit->isModified()) {
        take();
      }
    });
  }
  show_parts();
}

void JointMappingForm::set_joint_mapping(const device::JointMapping& mapped) {
  mapped_ = mapped;
  const QSignalBlocker quiet(sensor_);
  joint_->setText(QStringLiteral("<b>%1</b>").arg(joint_label(mapped.joint).toHtmlEscaped()));
  sensor_->setCurrentIndex(sensor_->findData(mapped.left_to_arm ? kOfArm : mapped.sensor));
  sensor_->setToolTip(sensor_->currentData(Qt::ToolTipRole).toString());
  show_text(*gain_, shown_number(mapped.gain));
  show_text(*offset_, shown_number(mapped.offset / geometric::kDegree));
  show_text(*curve_, curve_text(mapped.curve));
  show_text(*fixed_, mapped.fixed ? shown_number(*mapped.fixed / geometric::kDegree) : QString());
  for (QLineEdit* edit : {gain_, offset_, curve_, fixed_}) {
    mark(*edit, true);
  }
  show_parts();
}

void JointMappingForm::mark(QLineEdit& field, bool good) {
  field.setStyleSheet(
      good ? QString()
           : QStringLiteral("border-color: %1;").arg(html(colors_of(current_theme()).bad)));
}

// Takes only values that were typed: the others keep all their digits.
void JointMappingForm::take() {
  device::JointMapping mapped = mapped_;
  bool good = true;
  const auto take_field = [this, &good](QLineEdit& field, const auto& use) {
    if (field.isModified()) {
      const bool taken = use(field.text().trimmed());
      mark(field, taken);
      good = good && taken;
    }
  };
  const int chosen = sensor_->currentData().toInt();
  mapped.sensor = std::max(chosen, kFixed);
  mapped.left_to_arm = chosen == kOfArm;
  take_field(*gain_, [&](const QString& text) {
    const auto value = parse_ratio(text);
    mapped.gain = value.value_or(mapped.gain);
    return value.has_value();
  });
  take_field(*offset_, [&](const QString& text) {
    const auto value = parse_ratio(text);
    mapped.offset = value ? *value * geometric::kDegree : mapped.offset;
    return value.has_value();
  });
  take_field(*curve_, [&](const QString& text) {
    const auto curve = parse_curve(text);
    mapped.curve = curve.value_or(std::vector<device::CurvePoint>{});
    return curve.has_value() || text.isEmpty();
  });
  take_field(*fixed_, [&](const QString& text) {
    const auto value = parse_ratio(text);
    mapped.fixed = value ? std::optional(*value * geometric::kDegree) : std::nullopt;
    return value.has_value() || text.isEmpty();
  });
  if (mapped.sensor >= 0 || mapped.left_to_arm) {
    mapped.fixed.reset();
  } else {
    mapped.curve.clear();
  }
  if (good) {
    set_joint_mapping(mapped);
    emit edited(mapped_);
  }
}

void JointMappingForm::show_parts() {
  const bool driven = mapped_.sensor >= 0;
  line_part_->setVisible(driven);
  line_part_->setEnabled(mapped_.curve.empty());
  curve_part_->setVisible(driven);
  fixed_part_->setVisible(!driven && !mapped_.left_to_arm);
}

}  // namespace handway::gui
