#pragma once

#include "handway/planning/queries/region_draws.h"

#include <QWidget>

#include <optional>

class QCheckBox;
class QLabel;
class QSlider;

namespace handway::gui {

/// A section of the plan panel: whether the view shows what region a planner draws from, with
/// sliders for the corridor's half-width and the number of principal directions.
class RegionPreviewBox : public QWidget {
  Q_OBJECT

 public:
  explicit RegionPreviewBox(QWidget* parent = nullptr);

  [[nodiscard]] bool is_on() const;
  /// @param region that the planner begins with; nothing: it has none, or there is no scene.
  /// @param directions of the hand's basis.
  /// @param bound the planner has these parameters, which go with the sliders.
  void show_region(const std::optional<planning::SamplingRegion>& region, int directions,
                   bool bound);
  /// As the sliders are; nothing if there is no region.
  [[nodiscard]] const std::optional<planning::SamplingRegion>& region() const { return region_; }

  void show_draws(const planning::RegionDraws& draws);
  void show_failure(const QString& message);

 signals:
  /// Switched on or off, or a slider was moved.
  void changed();
  /// A person moved a slider.
  void rho_edited(double rho);
  void pmds_edited(int pmds);

 private:
  void set_note(const QString& text);
  void come_into_sight();
  void take_sliders();
  void label_values();

  QCheckBox* on_;
  QWidget* sliders_;
  QSlider* rho_;
  QSlider* pmds_;
  QLabel* rho_value_;
  QLabel* pmds_value_;
  QLabel* note_;
  QLabel* legend_;
  std::optional<planning::SamplingRegion> region_;
  bool bound_ = false;
  bool was_switched_on_ = false;  ///< And has shown nothing yet.
};

}  // namespace handway::gui
