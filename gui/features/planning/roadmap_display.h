#pragma once

#include <QObject>

class QAction;

namespace handway::gui {

class HypercubeDisplay;
class PlanningSession;
class RoadmapLegend;
class SceneView;

/// Draws the session's roadmap into the view, with a legend, as long as it is wanted.
class RoadmapDisplay : public QObject {
  Q_OBJECT

 public:
  /// @param shown, hypercubes_shown switches. All outlive it.
  RoadmapDisplay(PlanningSession& session, SceneView& view, QAction& shown,
                 HypercubeDisplay& hypercubes, QAction& hypercubes_shown,
                 QObject* parent = nullptr);

 private:
  void draw();
  void show_legend();

  PlanningSession& session_;
  SceneView& view_;
  QAction& shown_;
  HypercubeDisplay& hypercubes_;
  RoadmapLegend* legend_;
};

}  // namespace handway::gui
