#pragma once

#include "playback/motion_analysis.h"
#include "playback/path_traces.h"

#include <QObject>

namespace handway::gui {

class PlotsPanel;

/// What can be done with the path that is played: its curves over time, and what it leaves in the
/// view.
class PlaybackTools : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. @param menu gets what switches traces of the path.
  PlaybackTools(Document& document, PathPlayer& player, SceneView& view, QMenu& menu,
                QObject* parent = nullptr);

  [[nodiscard]] MotionAnalysis& analysis() { return analysis_; }
  [[nodiscard]] PathTraces& traces() { return traces_; }
  /// For a dock, which owns it.
  [[nodiscard]] PlotsPanel* plots() const { return plots_; }

 signals:
  void exported(const QString& file);
  void failed(const QString& title, const QString& message);

 private:
  MotionAnalysis analysis_;
  PathTraces traces_;
  PlotsPanel* plots_;
};

}  // namespace handway::gui
