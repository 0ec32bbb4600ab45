#include "features/glove/wire_form.h"

#include "features/glove/coverage_bars.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/math/units.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <cmath>

namespace handway::gui {
namespace {

constexpr int kShownDigits = 6;

QString shown_number(double value) { return QString::number(value, 'g', kShownDigits); }

QLineEdit* field(const char* name) {
  auto* edit = new QLineEdit;
  edit->setObjectName(QLatin1String(name));
  edit->setMinimumWidth(40);
  return edit;
}

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

WireForm::WireForm(QWidget* parent)
    : QWidget(parent),
      joint_(new QLabel),
      sensor_(new QComboBox),
      gain_(field("wire_gain")),
      offset_(field("wire_offset")),
      curve_(field("wire_curve")),
      fixed_(field("wire_fixed")) {
  sensor_->setObjectName(QStringLiteral("wire_sensor"));
  sensor_->setMinimumContentsLength(6);
  sensor_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  sensor_->addItem(tr("Fixed, no sensor"), -1);
  for (int i = 0; i < static_cast<int>(device::cyberglove_sensors().size()); ++i) {
    const auto& sensor = device::cyberglove_sensors()[static_cast<std::size_t>(i)];
    sensor_->addItem(
        QStringLiteral("%1  %2")
            .arg(QLatin1Char(sensor.letter))
            .arg(QString::fromUtf8(sensor.label.data(), static_cast<int>(sensor.label.size()))),
        i);
  }
  gain_->setToolTip(tr("Joint angle for each unit of the sensor's; -1/3 will do"));
  offset_->setToolTip(tr("Joint angle where the sensor's is 0, degrees"));
  curve_->setToolTip(
      tr("Instead of gain and offset: SENSOR:JOINT pairs in degrees, straight "
         "between, for example 0:-4, 45:-52, 97:-75"));
  curve_->setPlaceholderText(tr("none"));
  fixed_->setToolTip(tr("Where the joint stays, degrees"));
  fixed_->setPlaceholderText(tr("middle of its range"));
  line_part_ = row({new QLabel(tr("Gain")), gain_, new QLabel(tr("Offset °")), offset_});
  curve_part_ = row({new QLabel(tr("Curve")), curve_});
  fixed_part_ = row({new QLabel(tr("At °")), fixed_});
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(row({joint_, sensor_}));
  layout->addWidget(line_part_);
  layout->addWidget(curve_part_);
  layout->addWidget(fixed_part_);
  connect(sensor_, qOverload<int>(&QComboBox::currentIndexChanged), this, &WireForm::take);
  for (QLineEdit* edit : {gain_, offset_, curve_, fixed_}) {
    connect(edit, &QLineEdit::editingFinished, this, [this, edit] {
      if (edit->isModified()) {
        take();
      }
    });
  }
  show_parts();
}

void WireForm::set_wire(const device::JointWire& wire) {
  wire_ = wire;
  const QSignalBlocker quiet(sensor_);
  joint_->setText(QStringLiteral("<b>%1</b>").arg(joint_label(wire.joint)));
  sensor_->setCurrentIndex(sensor_->findData(wire.sensor));
  gain_->setText(shown_number(wire.gain));
  offset_->setText(shown_number(wire.offset / geometric::kDegree));
  curve_->setText(curve_text(wire.curve));
  fixed_->setText(wire.fixed ? shown_number(*wire.fixed / geometric::kDegree) : QString());
  for (QLineEdit* edit : {gain_, offset_, curve_, fixed_}) {
    mark(*edit, true);
  }
  show_parts();
}

void WireForm::mark(QLineEdit& field, bool good) {
  field.setStyleSheet(
      good ? QString()
           : QStringLiteral("border-color: %1;").arg(html(colors_of(current_theme()).bad)));
}

// Only what was typed is taken over: the others keep all their digits.
void WireForm::take() {
  device::JointWire wire = wire_;
  bool good = true;
  const auto take_field = [this, &good](QLineEdit& field, const auto& use) {
    if (field.isModified()) {
      const bool taken = use(field.text().trimmed());
      mark(field, taken);
      good = good && taken;
    }
  };
  wire.sensor = sensor_->currentData().toInt();
  take_field(*gain_, [&](const QString& text) {
    const auto value = parse_ratio(text);
    wire.gain = value.value_or(wire.gain);
    return value.has_value();
  });
  take_field(*offset_, [&](const QString& text) {
    const auto value = parse_ratio(text);
    wire.offset = value ? *value * geometric::kDegree : wire.offset;
    return value.has_value();
  });
  take_field(*curve_, [&](const QString& text) {
    const auto curve = parse_curve(text);
    wire.curve = curve.value_or(std::vector<device::CurvePoint>{});
    return curve.has_value() || text.isEmpty();
  });
  take_field(*fixed_, [&](const QString& text) {
    const auto value = parse_ratio(text);
    wire.fixed = value ? std::optional(*value * geometric::kDegree) : std::nullopt;
    return value.has_value() || text.isEmpty();
  });
  if (wire.sensor >= 0) {
    wire.fixed.reset();
  } else {
    wire.curve.clear();
  }
  if (good) {
    set_wire(wire);
    emit edited(wire_);
  }
}

void WireForm::show_parts() {
  const bool driven = wire_.sensor >= 0;
  line_part_->setVisible(driven);
  line_part_->setEnabled(wire_.curve.empty());
  curve_part_->setVisible(driven);
  fixed_part_->setVisible(!driven);
}

}  // namespace handway::gui
