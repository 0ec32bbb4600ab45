#pragma once

#include "model/settings/preferences.h"

#include <QObject>

namespace handway::gui {

class PlanSettings;
class Recovery;
class SceneView;

/// Does what the preferences say, when the window opens and whenever they change.
class PreferenceEffects : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  PreferenceEffects(const Preferences& preferences, SceneView& view, PlanSettings& planning,
                    Recovery& recovery, QObject* parent = nullptr);

 signals:
  /// The window shall have other colours.
  void theme_changed(handway::gui::Theme theme);

 private:
  void apply_at_once(const PreferenceValues& values);
  void apply_to_planning(const PreferenceValues& values);
  void follow();

  const Preferences& preferences_;
  SceneView& view_;
  PlanSettings& planning_;
  Recovery& recovery_;
  PreferenceValues applied_;
};

}  // namespace handway::gui
