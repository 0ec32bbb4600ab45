#pragma once

#include <QObject>

#include <memory>

class QAction;
class QWidget;

namespace handway::gui {

class Document;
class FrontierDisplay;
class HypercubeDisplay;
class PathPlayer;
class PlanPanel;
class PlanSettings;
class PlanningSession;
class ProjectionTool;
class RegionTool;
class RoadmapDisplay;
class SceneView;

/// What there is to see of planning besides its result: the region that is sampled, the
/// roadmap in the view, and its projection.
class PlanningViews : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  PlanningViews(Document& document, PathPlayer& player, PlanSettings& settings, PlanPanel& panel,
                SceneView& view);
  ~PlanningViews() override;

  /// @param roadmap_shown, hypercubes_shown switches. All outlive it.
  void follow(PlanningSession& session, QAction& roadmap_shown, QAction& hypercubes_shown);

  /// For a window to take over.
  [[nodiscard]] QWidget* projection_panel() const;
  [[nodiscard]] ProjectionTool& projection() const { return *projection_; }
  [[nodiscard]] RegionTool& region() const { return *region_; }
  /// @pre follow() was called.
  [[nodiscard]] FrontierDisplay& frontier() const { return *frontier_; }
  /// @pre follow() was called.
  [[nodiscard]] HypercubeDisplay& hypercubes() const { return *hypercubes_; }

 private:
  Document& document_;
  PlanSettings& settings_;
  SceneView& view_;
  std::unique_ptr<RegionTool> region_;
  std::unique_ptr<ProjectionTool> projection_;
  std::unique_ptr<HypercubeDisplay> hypercubes_;
  std::unique_ptr<RoadmapDisplay> roadmap_;
  std::unique_ptr<FrontierDisplay> frontier_;
};

}  // namespace handway::gui
