#pragma once

#include "handway/geometric/scene/shape.h"

#include <QWidget>

#include <vector>

class QFormLayout;

namespace handway::gui {

class QuantityField;

/// The measures of a shape, typed: edges, radius, length. A mesh tells where it is from.
class ShapeForm : public QWidget {
  Q_OBJECT

 public:
  explicit ShapeForm(QWidget* parent = nullptr);

  void show_shape(const geometric::Shape& shape);
  void set_editable(bool editable);

 signals:
  void shape_edited(const handway::geometric::Shape& shape);

 private:
  void rebuild();
  void take_values();
  void add_field(const QString& label, const char* name);

  QFormLayout* layout_;
  std::vector<QuantityField*> fields_;
  geometric::Shape shape_;
  bool editable_ = true;
};

/// "Box", "Cylinder", …: the word for people.
[[nodiscard]] QString kind_of_shape(const geometric::Shape& shape);

}  // namespace handway::gui
