#include "widgets/forms/shape_form.h"

#include "handway/geometric/math/units.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/planning/edits/resizing.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/forms/typed_input.h"

#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace handway::gui {
namespace {

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
  Values operator()(const geometric::Cloud& cloud) const {
    return {cloud.cells.size, cloud.cells.radius};
  }
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
  void operator()(geometric::Cloud& /*cloud*/) const {}
};

QString mesh_text(const geometric::Mesh& mesh) {
  const QString file = mesh.file.empty() ? QObject::tr("made by an importer")
                                         : QString::fromStdString(mesh.file.filename().string());
  const std::size_t count = mesh.triangles ? mesh.triangles->triangles.size() : 0;
  if (count == 0) {
    return QObject::tr("%1, no triangles").arg(file);
  }
  const Eigen::Vector3d size = geometric::bounding_box(*mesh.triangles).size();
  const auto millimetres = [](double length) {
    return QString::number(geometric::millimetres(length), 'f', 0);
  };
  return QObject::tr("%1: %2 × %3 × %4 mm, %5 triangles")
      .arg(file, millimetres(size.x()), millimetres(size.y()), millimetres(size.z()))
      .arg(count);
}

QString cloud_text(const geometric::Cloud& cloud) {
  const QString file = cloud.file.empty() ? QObject::tr("not saved yet")
                                          : QString::fromStdString(cloud.file.filename().string());
  return QObject::tr(
             "%1: %2 points. All cells of a grid that have a point, or are nearer to one "
             "than the radius, are solid.")
      .arg(file)
      .arg(cloud.points->size());
}

// A mesh is shown by its file and its size.
bool has_same_fields(const geometric::Shape& a, const geometric::Shape& b) {
  if (const auto* cloud = std::get_if<geometric::Cloud>(&a)) {
    const auto* same = std::get_if<geometric::Cloud>(&b);
    return same && same->file == cloud->file && same->points == cloud->points;
  }
  const auto* one = std::get_if<geometric::Mesh>(&a);
  const auto* other = std::get_if<geometric::Mesh>(&b);
  return a.index() == b.index() &&
         (!one || (one->file == other->file && one->triangles == other->triangles));
}

}  // namespace

QString kind_of_shape(const geometric::Shape& shape) {
  const std::array<QString, 6> words{QObject::tr("Box"),      QObject::tr("Sphere"),
                                     QObject::tr("Cylinder"), QObject::tr("Cone"),
                                     QObject::tr("Mesh"),     QObject::tr("Point cloud")};
  return words.at(shape.index());
}

ShapeForm::ShapeForm(QWidget* parent) : QWidget(parent), layout_(new QFormLayout(this)) {
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setVerticalSpacing(5);
  layout_->setHorizontalSpacing(10);
  rebuild();
}

ShapeForm::~ShapeForm() { hide(); }

void ShapeForm::add_field(const QString& label, const char* name, double least, double most) {
  auto* field = new QuantityField(QuantityField::Kind::kLength, least, most);
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
  mesh_ = nullptr;
  if (std::holds_alternative<geometric::Box>(shape_)) {
    add_field(tr("Length (x)"), "size_x");
    add_field(tr("Width (y)"), "size_y");
    add_field(tr("Height (z)"), "size_z");
  } else if (const auto* mesh = std::get_if<geometric::Mesh>(&shape_)) {
    mesh_ = named("mesh_note", note(mesh_text(*mesh)));
    mesh_->setWordWrap(true);
    layout_->addRow(mesh_);
    add_scale();
  } else if (const auto* cloud = std::get_if<geometric::Cloud>(&shape_)) {
    QLabel* text = named("cloud_note", note(cloud_text(*cloud)));
    text->setWordWrap(true);
    layout_->addRow(text);
    add_field(tr("Cell"), "cloud_cell", geometric::kSmallestCell, geometric::kLargestCell);
    add_field(tr("Radius"), "cloud_radius", 0.0, geometric::most_radius(geometric::kLargestCell));
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
  if (mesh_) {
    mesh_->setText(mesh_text(std::get<geometric::Mesh>(shape)));
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
  if (std::holds_alternative<geometric::Cloud>(shape_)) {
    emit cells_edited({values[0], std::min(values[1], geometric::most_radius(values[0]))});
    return;
  }
  geometric::Shape resized = shape_;
  std::visit(Resize{values}, resized);
  emit shape_edited(resized);
}

}  // namespace handway::gui
