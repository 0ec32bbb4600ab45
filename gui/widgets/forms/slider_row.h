#pragma once

#include <QString>
#include <QWidget>

class QDoubleSpinBox;
class QLabel;
class QSlider;

namespace handway::gui {

/// A number on a slider with its name in front and a field behind.
class SliderRow : public QWidget {
  Q_OBJECT

 public:
  /// Quantity of the row. Bounds and values are in inside units; the screen shows them multiplied
  /// by `scale`.
  struct Range {
    double lower = 0.0;
    double upper = 1.0;
    double scale = 1.0;
    QString unit;      ///< On screen, for example "°".
    int decimals = 1;  ///< On screen.
  };

  SliderRow(const QString& label, const Range& range, QWidget* parent = nullptr);

  [[nodiscard]] double value() const { return value_; }
  /// Shows `value` without telling anyone; values outside the range are shown at its end.
  void set_value(double value);
  /// A row that only shows.
  void set_read_only();
  /// Marks the row as chosen, so that it stands out from the others.
  void set_chosen(bool chosen);
  /// Name column of a stack of rows, px.
  void set_label_width(int width);
  /// The slider below its name and number, as wide as all.
  void use_two_lines();

 signals:
  /// The person moved it; inside units.
  void value_edited(double value);

 private:
  void edit(double value);
  void show_value(bool slider, bool field);

  Range range_;
  double value_ = 0.0;
  QLabel* label_;
  QSlider* slider_;
  QDoubleSpinBox* field_;
};

}  // namespace handway::gui
