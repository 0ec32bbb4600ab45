#pragma once

#include "handway/geometric/io/parameter.h"

#include <QDoubleSpinBox>
#include <QWidget>

#include <string>
#include <utility>
#include <vector>

class QFormLayout;

namespace handway::gui {

/// A spin box for numbers of any size: shows as many digits as the value needs
/// (0.005, 1e-06) and steps in proportion to it.
class NumberField : public QDoubleSpinBox {
  Q_OBJECT

 public:
  NumberField(double lower, double upper, QWidget* parent = nullptr);

  [[nodiscard]] QString textFromValue(double value) const override;
};

/// A form for parameters: a field with unit, range and help for each number, a
/// list for choices, a box for switches.
class ParameterForm : public QWidget {
  Q_OBJECT

 public:
  explicit ParameterForm(const std::vector<geometric::Parameter>& parameters,
                         QWidget* parent = nullptr);

  /// Enables or disables the field of a parameter, with its label. @pre `key` is one of them.
  void set_enabled(const std::string& key, bool enabled);

  /// Makes these stand out among the others.
  void mark(const std::vector<std::string>& keys);

 signals:
  /// `value` is text as geometric::set_from_text() takes it.
  void edited(const std::string& key, const std::string& value);

 private:
  QWidget* make_field(const geometric::Parameter& parameter);
  /// Weights of an objective are shown where they count: if it is a custom one.
  void show_weights();

  std::vector<std::pair<std::string, QWidget*>> names_;  ///< Label of each parameter, by key.
  QFormLayout* layout_;
  std::vector<std::pair<QWidget*, QWidget*>> weights_;  ///< Their names and fields.
  int weights_row_ = 0;                                 ///< Row of the weights.
  bool has_weights_ = true;                             ///< They are in the layout.
};

}  // namespace handway::gui
