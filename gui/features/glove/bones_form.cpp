#include "features/glove/bones_form.h"

#include "handway/geometric/math/units.h"
#include "widgets/style/theme.h"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QString>

#include <array>
#include <cstddef>

namespace handway::gui {
namespace {

constexpr double kLongestHand = 300.0;  // mm
constexpr double kLongestBone = 150.0;  // mm

QDoubleSpinBox* length_field(double most, const QString& name) {
  auto* field = new QDoubleSpinBox;
  field->setRange(1.0, most);
  field->setDecimals(1);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setMinimumWidth(scaled(46));
  field->setAccessibleName(name);
  return field;
}

}  // namespace

BonesForm::BonesForm(QWidget* parent)
    : QWidget(parent), length_(length_field(kLongestHand, tr("Length of the hand, mm"))) {
  setObjectName(QStringLiteral("calibration_bones"));
  length_->setObjectName(QStringLiteral("hand_length"));
  length_->setToolTip(
      tr("Length from the crease of the wrist to the tip of the middle finger; all bones are "
         "scaled to it"));
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(4);
  grid->addWidget(new QLabel(tr("Hand, mm")), 0, 0);
  grid->addWidget(length_, 0, 1);
  const std::array<QString, 4> bones{tr("to base"), tr("1st"), tr("2nd"), tr("3rd")};
  for (int i = 0; i < static_cast<int>(bones.size()); ++i) {
    grid->addWidget(new QLabel(bones.at(static_cast<std::size_t>(i))), 1, i + 1);
  }
  const std::array<QString, device::kFingers> fingers{tr("Thumb"), tr("Index"), tr("Middle"),
                                                      tr("Ring"), tr("Little")};
  for (int f = 0; f < device::kFingers; ++f) {
    const QString& finger = fingers.at(static_cast<std::size_t>(f));
    grid->addWidget(new QLabel(finger), f + 2, 0);
    for (int i = 0; i < static_cast<int>(bones.size()); ++i) {
      const QString name =
          tr("%1, %2, mm").arg(finger, i == 0 ? tr("wrist to base") : tr("bone %1").arg(i));
      QDoubleSpinBox* field = length_field(kLongestBone, name);
      field->setObjectName(QStringLiteral("bone_%1_%2").arg(f).arg(i));
      field->setToolTip(name);
      lengths_.push_back(field);
      grid->addWidget(field, f + 2, i + 1);
    }
  }
  connect(length_, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this](double mm) { show_bones(device::typical_bones(mm * geometric::kMillimetre)); });
  length_->setValue(device::kTypicalHandLength / geometric::kMillimetre);
}

void BonesForm::show_bones(const device::HandBones& bones) {
  std::size_t place = 0;
  for (const auto& finger : bones) {
    for (const double length : finger) {
      lengths_[place++]->setValue(length / geometric::kMillimetre);
    }
  }
}

device::HandBones BonesForm::bones() const {
  device::HandBones bones{};
  std::size_t place = 0;
  for (auto& finger : bones) {
    for (double& length : finger) {
      length = lengths_[place++]->value() * geometric::kMillimetre;
    }
  }
  return bones;
}

}  // namespace handway::gui
