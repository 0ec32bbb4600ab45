#include "widgets/forms/slider_row.h"

#include "widgets/style/theme.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

constexpr int kSteps = 2000;

}  // namespace

SliderRow::SliderRow(const QString& label, const Range& range, QWidget* parent)
    : QWidget(parent),
      range_(range),
      label_(new QLabel(label)),
      slider_(new QSlider(Qt::Horizontal)),
      field_(new QDoubleSpinBox) {
  label_->setToolTip(label);
  slider_->setRange(0, kSteps);
  slider_->setPageStep(kSteps / 20);
  slider_->setFocusPolicy(Qt::StrongFocus);
  slider_->setObjectName(QStringLiteral("slider"));
  field_->setDecimals(range.decimals);
  field_->setRange(range.lower * range.scale, range.upper * range.scale);
  field_->setSingleStep(
      std::max(std::pow(10.0, -range.decimals), (range.upper - range.lower) * range.scale / 100.0));
  field_->setSuffix(range.unit);
  field_->setAlignment(Qt::AlignRight);
  field_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field_->setKeyboardTracking(false);
  field_->setFixedWidth(68);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(label_);
  layout->addWidget(slider_, 1);
  layout->addWidget(field_);
  setToolTip(QStringLiteral("%1: %2%4 to %3%4")
                 .arg(label)
                 .arg(range.lower * range.scale, 0, 'f', range.decimals)
                 .arg(range.upper * range.scale, 0, 'f', range.decimals)
                 .arg(range.unit));

  connect(slider_, &QSlider::valueChanged, this, [this](int step) {
    edit(range_.lower + (range_.upper - range_.lower) * step / kSteps);
    show_value(false, true);
  });
  connect(field_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double shown) {
    edit(std::clamp(shown / range_.scale, range_.lower, range_.upper));
    show_value(true, false);
  });
  set_value(std::clamp(0.0, range.lower, range.upper));
}

void SliderRow::edit(double value) {
  value_ = value;
  emit value_edited(value);
}

void SliderRow::set_value(double value) {
  value_ = std::clamp(value, range_.lower, range_.upper);
  show_value(true, true);
}

void SliderRow::show_value(bool slider, bool field) {
  const QSignalBlocker quiet_slider(slider_), quiet_field(field_);
  const double range = range_.upper - range_.lower;
  if (slider) {
    slider_->setValue(
        range > 0.0 ? static_cast<int>(std::lround((value_ - range_.lower) / range * kSteps)) : 0);
  }
  if (field) {
    field_->setValue(value_ * range_.scale);
  }
}

void SliderRow::set_read_only() {
  slider_->setEnabled(false);
  field_->setReadOnly(true);
  field_->setEnabled(false);
  label_->setEnabled(false);
}

void SliderRow::set_chosen(bool chosen) {
  set_role(*label_, chosen ? QStringLiteral("chosen") : QString());
}

void SliderRow::set_label_width(int width) {
  label_->setFixedWidth(width);
  const QString text = label_->toolTip();
  label_->setText(label_->fontMetrics().elidedText(text, Qt::ElideMiddle, width));
}

}  // namespace handway::gui
