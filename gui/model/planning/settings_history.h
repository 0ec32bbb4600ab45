#pragma once

#include "model/document/scene_editor.h"
#include "model/planning/plan_settings.h"

#include <QObject>
#include <QTimer>

namespace handway::gui {

/// Puts what a person changes of the planner and its settings onto the undo stack, one entry for
/// all that changes at once. They alone make no unsaved work, of which a person would be asked.
class SettingsHistory : public QObject {
  Q_OBJECT

 public:
  /// Both outlive it.
  SettingsHistory(PlanSettings& settings, SceneEditor& editor, QObject* parent = nullptr);

  /// The settings as they are now are those to begin with, as of a scene that was opened.
  void begin();

 private:
  void note_change();

  PlanSettings& settings_;
  SceneEditor& editor_;
  PlanChoices before_;
  QTimer soon_;
};

}  // namespace handway::gui
