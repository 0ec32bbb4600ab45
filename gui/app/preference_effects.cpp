#include "app/preference_effects.h"

#include "features/editing/recovery.h"
#include "model/planning/plan_settings.h"
#include "view3d/scene_view.h"
#include "widgets/forms/quantity_field.h"

#include <utility>

namespace handway::gui {

PreferenceEffects::PreferenceEffects(const Preferences& preferences, SceneView& view,
                                     PlanSettings& planning, Recovery& recovery, QObject* parent)
    : QObject(parent),
      preferences_(preferences),
      view_(view),
      planning_(planning),
      recovery_(recovery),
      applied_(preferences.values()) {
  apply_at_once(applied_);
  planning_.set_usual_planner(applied_.planner.toStdString());
  planning_.set_threads(applied_.threads);
  planning_.set_time_limit(applied_.time_limit);
  connect(&preferences_, &Preferences::changed, this, &PreferenceEffects::follow);
}

void PreferenceEffects::apply_at_once(const PreferenceValues& values) {
  view_.set_projection(values.projection);
  view_.set_navigation(values.navigation);
  view_.set_floor_visible(values.floor);
  view_.set_cube_visible(values.cube);
  view_.set_samples(values.samples);
  view_.set_always_fine(values.always_fine);
  view_.set_frame_limit(values.frame_limit);
  QuantityField::show_units(values.units);
  recovery_.set_enabled(values.autosave);
}

// The panel's fields are for one run each: only a preference that has changed is put there.
void PreferenceEffects::apply_to_planning(const PreferenceValues& values) {
  if (values.planner != applied_.planner) {
    planning_.set_usual_planner(values.planner.toStdString());
  }
  if (values.threads != applied_.threads) {
    planning_.set_threads(values.threads);
  }
  if (values.time_limit != applied_.time_limit) {
    planning_.set_time_limit(values.time_limit);
  }
}

void PreferenceEffects::follow() {
  const PreferenceValues& values = preferences_.values();
  apply_at_once(values);
  apply_to_planning(values);
  const bool recolor = values.theme != std::exchange(applied_, values).theme;
  if (recolor) {
    emit theme_changed(values.theme);
  }
}

}  // namespace handway::gui
