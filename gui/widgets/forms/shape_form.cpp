#include "widgets/forms/shape_form.h"

#include "handway/planning/edits/resizing.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/pose_form.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/forms/typed_input.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QSignalBlocker>

#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace handway::gui {
namespace {

constexpr double kSmallest = 1e-4;  // m
constexpr double kLargest = 100.0;  // m

using Values = std::vector<double>;

struct Measures {
  Values operator()(const geometric::Box& box) const {
    return {box.size.x(), box.size.y(), box.size.z()};
  }
  Values operator()(const geometric::Sphere& sphere) const { return {sphere.radius}; }
  Values operator()(const geometric::Cylinder& cylinder) const {
    return {cylinder.radius, cylinder.length};
  }
  Values operator()(const geometric::Cone& cone) const { return {cone.radius, cone.length}; }
  Values operator()(const geometric::Mesh& /*mesh*/) const { return {}; }
};

struct Resize {
  std::span<const double> values;

  void operator()(geometric::Box& box) const { box.size = {values[0], values[1], values[2]}; }
  void operator()(geometric::Sphere& sphere) const { sphere.radius = values[0]; }
  void operator()(geometric::Cylinder& cylinder) const {
    cylinder.radius = values[0];
    cylinder.length = values[1];
  }
  void operator()(geometric::Cone& cone) const {
    cone.radius = values[0];
    cone.length = values[1];
  }
  void operator()(geometric::Mesh& /*mesh*/) const {}
};

}  // namespace

QString kind_of_shape(const geometric::Shape& shape) {
  const std::array<QString, 5> words{QObject::tr("Box"), QObject::tr("Sphere"),
                                     QObject::tr("Cylinder"), QObject::tr("Cone"),
                                     QObject::tr("Mesh")};
  return words.at(shape.index());
}

namespace {

// A mesh is shown by its file and its size in triangles.
bool has_same_fields(const geometric::Shape& a, const geometric::Shape& b) {
  const auto* one = std::get_if<geometric::Mesh>(&a);
  const auto* other = std::get_if<geometric::Mesh>(&b);
  return a.index() == b.index() &&
         (!one || (one->file == other->file && one->triangles == other->triangles));
}

}  // namespace

ShapeForm::ShapeForm(QWidget* parent) : QWidget(parent), layout_(new QFormLayout(this)) {
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setVerticalSpacing(5);
  layout_->setHorizontalSpacing(10);
  rebuild();
}

void ShapeForm::add_field(const QString& label, const char* name) {
  auto* field = new QuantityField(QuantityField::Kind::kLength, kSmallest, kLargest);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  field->setObjectName(QLatin1String(name));
  layout_->addRow(note(label), field);
  fields_.push_back(field);
  connect(field, &QuantityField::quantity_edited, this, &ShapeForm::take_values);
}

void ShapeForm::add_scale() {
  scale_ = new QDoubleSpinBox;
  scale_->setObjectName(QStringLiteral("size_scale"));
  scale_->setRange(1e-4, 1e4);
  scale_->setDecimals(4);
  scale_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  scale_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  scale_->setToolTip(tr("Unit of the numbers in the file, m; 0.001 for millimetres"));
  layout_->addRow(note(tr("Scale")), scale_);
  connect(scale_, &QDoubleSpinBox::editingFinished, this, [this] {
    const auto& mesh = std::get<geometric::Mesh>(shape_);
    const double factor = scale_->value() / std::abs(mesh.scale.x());
    if (std::abs(factor - 1.0) > 1e-6) {
      emit shape_edited(planning::scaled(mesh, factor));
    }
  });
}

void ShapeForm::rebuild() {
  while (layout_->rowCount() > 0) {
    layout_->removeRow(0);
  }
  fields_.clear();
  scale_ = nullptr;
  if (std::holds_alternative<geometric::Box>(shape_)) {
    add_field(tr("Length (x)"), "size_x");
    add_field(tr("Width (y)"), "size_y");
    add_field(tr("Height (z)"), "size_z");
  } else if (const auto* mesh = std::get_if<geometric::Mesh>(&shape_)) {
    auto* file =
        note(tr("%1, %2 triangles")
                 .arg(mesh->file.empty() ? tr("made by an importer")
                                         : QString::fromStdString(mesh->file.filename().string()))
                 .arg(mesh->triangles ? mesh->triangles->triangles.size() : 0));
    file->setWordWrap(true);
    layout_->addRow(file);
    add_scale();
  } else {
    add_field(tr("Radius"), "size_radius");
    if (!std::holds_alternative<geometric::Sphere>(shape_)) {
      add_field(std::holds_alternative<geometric::Cone>(shape_) ? tr("Height") : tr("Length"),
                "size_length");
    }
  }
}

void ShapeForm::show_shape(const geometric::Shape& shape) {
  const bool other_fields = !has_same_fields(shape, shape_);
  shape_ = shape;
  if (other_fields) {
    rebuild();
  }
  const Values values = std::visit(Measures{}, shape);
  for (std::size_t i = 0; i < values.size(); ++i) {
    fields_[i]->show_quantity(values[i]);
  }
  if (scale_) {
    show_value(*scale_, std::abs(std::get<geometric::Mesh>(shape).scale.x()));
  }
  set_editable(editable_);
}

void ShapeForm::set_editable(bool editable) {
  editable_ = editable;
  for (QuantityField* field : fields_) {
    field->setReadOnly(!editable);
  }
  if (scale_) {
    scale_->setReadOnly(!editable);
  }
}

void ShapeForm::take_values() {
  Values values = std::visit(Measures{}, shape_);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (sender() == fields_[i]) {
      values[i] = fields_[i]->quantity();
    }
  }
  geometric::Shape resized = shape_;
  std::visit(Resize{values}, resized);
  emit shape_edited(resized);
}

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
