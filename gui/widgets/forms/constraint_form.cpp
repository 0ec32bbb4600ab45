#include "widgets/forms/constraint_form.h"

#include "handway/geometric/mesh/shape.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/pose_form.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/forms/shape_form.h"

#include <QCheckBox>
#include <QLabel>
#include <QSignalBlocker>

#include <numbers>

namespace handway::gui {
namespace {

constexpr double kLeastAngle = 1e-4;  // rad

QCheckBox* make_switch(const QString& text, const QString& tip, const char* name) {
  auto* box = new QCheckBox(text);
  box->setObjectName(QLatin1String(name));
  box->setToolTip(tip);
  return box;
}

void show_switch(QCheckBox& box, bool on) {
  const QSignalBlocker quiet(&box);
  box.setChecked(on);
}

}  // namespace

ConstraintForm::ConstraintForm(QWidget* parent)
    : QWidget(parent),
      upright_on_(make_switch(tr("Upright within"),
                              tr("Paths keep the axis that is up now as near to the vertical"),
                              "keep_upright")),
      angle_(named("upright_angle",
                   new QuantityField(QuantityField::Kind::kAngle, kLeastAngle, std::numbers::pi))),
      region_on_(make_switch(tr("In a region"), tr("Paths keep its origin inside of a box"),
                             "keep_region")),
      region_box_(new QWidget),
      size_(new ShapeForm),
      centre_(new PoseForm) {
  angle_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  lay_out(*region_box_, in_column({size_, note(tr("Its centre")), centre_}, 5));
  for (auto* field : region_box_->findChildren<QuantityField*>()) {  // an object has such, too
    field->setObjectName(QStringLiteral("region_") + field->objectName());
  }
  lay_out(*this, in_column({in_row({upright_on_, {angle_, 1}}), region_on_, region_box_}, 5));
  connect(upright_on_, &QCheckBox::clicked, this, &ConstraintForm::upright_switched);
  connect(region_on_, &QCheckBox::clicked, this, &ConstraintForm::region_switched);
  connect(angle_, &QuantityField::quantity_edited, this, [this](double angle) {
    upright_.angle = angle;
    emit upright_edited(upright_);
  });
  connect(size_, &ShapeForm::shape_edited, this, [this](const geometric::Shape& shape) {
    region_.size = std::get<geometric::Box>(shape).size;
    emit region_edited(region_);
  });
  connect(centre_, &PoseForm::pose_edited, this, [this](const geometric::Pose& X_WR) {
    region_.X_WR = X_WR;
    emit region_edited(region_);
  });
  show_upright({});
  show_region({});
}

void ConstraintForm::show_upright(const std::optional<geometric::OrientationConstraint>& upright) {
  upright_ = upright.value_or(geometric::OrientationConstraint{});
  show_switch(*upright_on_, upright.has_value());
  angle_->show_quantity(upright_.angle);
  angle_->setEnabled(upright.has_value());
}

void ConstraintForm::show_region(const std::optional<geometric::PositionConstraint>& region) {
  region_ = region.value_or(geometric::PositionConstraint{});
  show_switch(*region_on_, region.has_value());
  region_box_->setVisible(region.has_value());
  size_->show_shape(geometric::Box{region_.size});
  centre_->show_pose(region_.X_WR);
}

}  // namespace handway::gui
