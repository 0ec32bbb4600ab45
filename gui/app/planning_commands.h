#pragma once

#include <QObject>
#include <QString>

namespace handway::gui {

class LogPanel;
class PlanSettings;
class PlanningSession;
class PresetBar;
class WindowActions;

/// The window's commands to plan and to cancel, and what its messages tell of planning.
class PlanningCommands : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  PlanningCommands(WindowActions& actions, PlanningSession& session, PlanSettings& settings,
                   PresetBar& presets, LogPanel& log, QObject* parent = nullptr);

  /// Tells what is wrong with the person's presets, if anything is.
  void tell_of_presets();

 signals:
  void failed(const QString& title, const QString& message);

 private:
  void show_running();
  void show_start();
  void show_end(bool solved, const QString& text);

  WindowActions& actions_;
  PlanSettings& settings_;
  PresetBar& presets_;
  LogPanel& log_;
};

}  // namespace handway::gui
