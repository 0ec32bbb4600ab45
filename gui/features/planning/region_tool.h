#pragma once

#include "handway/planning/queries/region_draws.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QWidget>

#include <optional>

class QCheckBox;
class QLabel;
class QSlider;

namespace handway::gui {

class Document;
class PlanPanel;
class PlanSettings;
class SceneView;

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
  /// Returns the region for the values of the sliders; nothing if there is no region.
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
  bool was_switched_on_ = false;  ///< True until it has shown something.
};

/// Shows in the view what the plan panel's parameters mean before they are used: where palm and
/// fingertips are in what the planner would draw.
class RegionTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. Puts a section into the panel.
  RegionTool(Document& document, PlanSettings& settings, PlanPanel& panel, SceneView& view,
             QObject* parent = nullptr);

  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }
  [[nodiscard]] bool is_shown() const { return shown_; }

 private:
  void read_planner();
  void update();
  void clear();

  Document& document_;
  PlanSettings& settings_;
  PlanPanel& panel_;
  SceneView& view_;
  RegionPreviewBox* box_;
  bool shown_ = false;
  bool busy_writing_ = false;  ///< A slider's value is on its way into the panel.
  LatestJob job_;
};

}  // namespace handway::gui
