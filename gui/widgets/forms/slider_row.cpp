#include "widgets/forms/slider_row.h"

#include "widgets/forms/arrangement.h"
#include "widgets/forms/typed_input.h"
#include "widgets/style/theme.h"

#include <QAbstractSpinBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QSlider>

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

constexpr int kKeptDecimals = 7;  // fewer are shown
constexpr int kSliderSteps = 2000;

// A number of which fewer digits are shown than it has: 12.345 is typed, kept, and shown as 12.3.
class PreciseField : public QDoubleSpinBox {
 public:
  explicit PreciseField(int shown) : shown_(shown) { setDecimals(kKeptDecimals); }

  [[nodiscard]] QString textFromValue(double value) const override {
    const double unit = std::pow(10.0, shown_);
    return locale().toString(std::round(value * unit) / unit + 0.0, 'f', shown_);
  }
  [[nodiscard]] double valueFromText(const QString& text) const override {
    return text == textFromValue(value()) + suffix() ? value()
                                                     : QDoubleSpinBox::valueFromText(text);
  }

 private:
  int shown_;
};

}  // namespace

SliderRow::SliderRow(const QString& label, const Range& range, QWidget* parent)
    : QWidget(parent),
      range_(range),
      label_(new QLabel(label)),
      slider_(named("slider", new QSlider(Qt::Horizontal))),
      field_(new PreciseField(range.decimals)) {
  label_->setToolTip(label);
  slider_->setAccessibleName(label);
  field_->setAccessibleName(label);
  slider_->setRange(0, kSliderSteps);
  slider_->setPageStep(kSliderSteps / 20);
  slider_->setFocusPolicy(Qt::StrongFocus);
  field_->setRange(range.lower * range.scale, range.upper * range.scale);
  field_->setSingleStep(
      std::max(std::pow(10.0, -range.decimals), (range.upper - range.lower) * range.scale / 100.0));
  field_->setSuffix(range.unit);
  field_->setAlignment(Qt::AlignRight);
  field_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field_->setKeyboardTracking(false);
  field_->setFixedWidth(scaled(68));
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setHorizontalSpacing(8);
  layout->setVerticalSpacing(0);
  layout->setColumnStretch(1, 1);
  layout->addWidget(label_, 0, 0);
  layout->addWidget(slider_, 0, 1);
  layout->addWidget(field_, 0, 2);
  setToolTip(QStringLiteral("%1: %2%4 to %3%4")
                 .arg(label, QString::number(range.lower * range.scale, 'f', range.decimals),
                      QString::number(range.upper * range.scale, 'f', range.decimals), range.unit));

  connect(slider_, &QSlider::valueChanged, this, [this](int step) {
    edit(range_.lower + (range_.upper - range_.lower) * step / kSliderSteps);
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
  const double range = range_.upper - range_.lower;
  if (slider) {
    gui::show_value(*slider_, range > 0.0 ? static_cast<int>(std::lround((value_ - range_.lower) /
                                                                         range * kSliderSteps))
                                          : 0);
  }
  if (field) {
    gui::show_value(*field_, value_ * range_.scale);
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

void SliderRow::use_two_lines() {
  auto* grid = qobject_cast<QGridLayout*>(layout());
  grid->addWidget(slider_, 1, 0, 1, 3);
}

void SliderRow::set_label_width(int width) {
  label_->setFixedWidth(width);
  const QString text = label_->toolTip();
  label_->setText(label_->fontMetrics().elidedText(text, Qt::ElideMiddle, width));
}

}  // namespace handway::gui
