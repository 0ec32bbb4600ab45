#pragma once

#include "handway/geometric/math/pose.h"
#include "model/settings/preferences.h"

#include <QDoubleSpinBox>
#include <QObject>
#include <QString>
#include <QWidget>

#include <array>

class QDoubleSpinBox;
class QLabel;
class QSlider;

namespace handway::gui {

/// A spin box for a length, an angle or a speed of turning. It shows the user's units, parses typed
/// quantities ("35", "3.5 cm", "0.2 m", "90°", "1.57 rad"), and its values are in SI units.
class QuantityField : public QDoubleSpinBox {
  Q_OBJECT

 public:
  enum class Kind { kLength, kAngle, kAngularSpeed };

  /// @param lower, upper in m, rad or rad/s.
  QuantityField(Kind kind, double lower, double upper, QWidget* parent = nullptr);

  /// All fields, those to come as well, show these units.
  static void show_units(const QuantityUnits& units);

  /// m, rad or rad/s.
  [[nodiscard]] double quantity() const;
  /// Shows a value without telling anyone.
  void show_quantity(double value);

  [[nodiscard]] double valueFromText(const QString& text) const override;
  [[nodiscard]] QString textFromValue(double value) const override;
  [[nodiscard]] QValidator::State validate(QString& text, int& position) const override;

 signals:
  /// A person has changed it. @param value m, rad or rad/s.
  void quantity_edited(double value);

 private:
  void use_units();

  Kind kind_;
  UnitText unit_;
};

/// Position and roll, pitch, yaw of a pose, typed.
class PoseForm : public QWidget {
  Q_OBJECT

 public:
  explicit PoseForm(QWidget* parent = nullptr);

  void show_pose(const geometric::Pose& X);
  void set_editable(bool editable);
  [[nodiscard]] QSize minimumSizeHint() const override;

 signals:
  /// Emitted with the edited pose. Values that were not typed are exactly those that were shown.
  void pose_edited(const handway::geometric::Pose& X);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// @param narrow the rotation below the position, not beside it.
  void arrange(bool narrow);
  [[nodiscard]] int width_of_columns() const;

  std::array<QuantityField*, 3> position_;
  std::array<QuantityField*, 3> rotation_;
  geometric::Pose X_ = geometric::Pose::Identity();
  std::array<QLabel*, 6> labels_{};  ///< Labels of position, then of rotation.
  bool is_narrow_ = false;
};

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

/// Prevents the wheel from changing sliders, number fields and choices that it merely scrolls over:
/// it changes only those that have the focus, and otherwise scrolls.
class WheelGuard : public QObject {
  Q_OBJECT

 public:
  /// Watches all widgets of the program for as long as it lives.
  explicit WheelGuard(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace handway::gui
