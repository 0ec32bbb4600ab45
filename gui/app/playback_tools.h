#pragma once

#include "features/playback/path_traces.h"
#include "model/planning/path_history.h"
#include "model/playback/motion_analysis.h"
#include "widgets/panels/dock_layout.h"

#include <QObject>

namespace handway::gui {

class MicroscopePanel;
class PlanSettings;
class PlaybackBar;
class PlotsPanel;
class RunsPanel;
class WindowActions;

/// What PlaybackTools works with; all outlive it.
struct PlaybackParts {
  QWidget& window;
  WindowActions& actions;
  Document& document;
  PathPlayer& player;
  SceneView& view;
  PlaybackBar& bar;
  PlanSettings& planning;
};

/// What can be done with the path that is played: its curves over time, what it leaves in the
/// view, its pictures, comparing it with others; and how it was found, step by step.
class PlaybackTools : public QObject {
  Q_OBJECT

 public:
  explicit PlaybackTools(const PlaybackParts& parts, QObject* parent = nullptr);

  [[nodiscard]] MotionAnalysis& analysis() { return analysis_; }
  [[nodiscard]] PathTraces& traces() { return traces_; }
  [[nodiscard]] PathHistory& history() { return history_; }
  /// All panels and another one behind them, for docks, which own them.
  [[nodiscard]] std::vector<DockContent> docks(const DockContent& last) const;
  [[nodiscard]] RunsPanel* runs() const { return runs_; }
  [[nodiscard]] PlotsPanel* plots() const { return plots_; }
  [[nodiscard]] MicroscopePanel* microscope() const { return microscope_; }

 signals:
  void exported(const QString& file);
  void failed(const QString& title, const QString& message);

 private:
  void remember();
  void export_pictures();
  void compare();

  PlaybackParts parts_;
  MotionAnalysis analysis_;
  PathTraces traces_;
  PathHistory history_;
  RunsPanel* runs_;
  PlotsPanel* plots_;
  MicroscopePanel* microscope_;
};

}  // namespace handway::gui
