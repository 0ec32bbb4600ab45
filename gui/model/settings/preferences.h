#pragma once

#include "model/settings/navigation.h"
#include "model/settings/orbit_camera.h"

#include <QObject>
#include <QString>

#include <optional>

namespace handway::gui {

enum class LengthUnit { kMillimetre, kCentimetre, kMetre, kInch };
enum class AngleUnit { kDegree, kRadian };

/// The units in which fields show lengths and angles.
struct QuantityUnits {
  LengthUnit length = LengthUnit::kMillimetre;
  AngleUnit angle = AngleUnit::kDegree;

  bool operator==(const QuantityUnits& other) const = default;
};

/// Text of a unit behind a number, and its size in mm or degrees.
struct UnitText {
  QString suffix;
  double size = 1.0;
};
[[nodiscard]] UnitText unit_text(LengthUnit unit);
[[nodiscard]] UnitText unit_text(AngleUnit unit);

enum class Theme { kLight, kDark };

/// Preferences of the user, independent of the open scene. Initial values are the defaults.
struct PreferenceValues {
  std::optional<Theme> theme;  ///< Empty: the desktop's.
  int text_size = 100;         ///< Percent; from the next start.
  QuantityUnits units;

  Projection projection = Projection::kPerspective;
  Navigation navigation;
  bool floor = true;         ///< Show the floor grid,
  bool cube = true;          ///< and the orientation cube.
  int samples = 4;           ///< For each pixel of a picture that stands; 0: edges are not smooth.
  bool shadows = true;       ///< Shadows and darkened corners, in pictures that stand.
  bool always_fine = false;  ///< Smooth edges and all triangles also while something moves.
  int frame_limit = 60;      ///< Pictures at most a second; 0: as many as can be had.

  QString planner;            ///< For scenes that name none; empty: the registry's first.
  int threads = 0;            ///< To plan with; 0: one a processor.
  double time_limit = 300.0;  ///< s; 0: none.

  bool autosave = true;  ///< Keep unsaved changes for when the program ends unexpectedly.

  bool operator==(const PreferenceValues& other) const = default;
};

/// The person's preferences, kept in the settings from one run to the next.
class Preferences : public QObject {
  Q_OBJECT

 public:
  /// Reads what was kept; what can't be understood is as by default.
  explicit Preferences(QObject* parent = nullptr);

  [[nodiscard]] const PreferenceValues& values() const { return values_; }
  /// Stores the values and emits changed(), if they differ.
  void set(const PreferenceValues& values);
  /// Sets one of the values: set(&PreferenceValues::floor, false).
  template <typename Value>
  void set(Value PreferenceValues::*member, const Value& value) {
    PreferenceValues changed = values_;
    changed.*member = value;
    set(changed);
  }

 signals:
  void changed();

 private:
  PreferenceValues values_;
};

}  // namespace handway::gui
