#pragma once

#include "handway/planning/queries/palm_boxes.h"
#include "model/jobs/latest_job.h"
#include "model/planning/palm_roadmap.h"

#include <QObject>

#include <optional>
#include <utility>
#include <vector>

class QAction;

namespace handway::gui {

class Document;
class PlanPanel;
class PlanningSession;
class SceneView;

/// Draws into the view where the palm goes in the hypercubes that the session's planner sweeps,
/// as long as it is wanted: those that are still searched apart from those that aren't.
class HypercubeDisplay : public QObject {
  Q_OBJECT

 public:
  static constexpr int kMostBoxes = 65;  ///< Of more hypercubes every n-th is drawn.

  /// @param shown a switch. All outlive it.
  HypercubeDisplay(Document& document, PlanPanel& panel, PlanningSession& session, SceneView& view,
                   QAction& shown, QObject* parent = nullptr);

  /// Half-side of the hypercubes that are drawn, or would be; nothing: the roadmap has none.
  [[nodiscard]] std::optional<double> half_side() const;
  /// What is drawn.
  [[nodiscard]] const std::vector<planning::PalmBox>& boxes() const { return boxes_; }

 signals:
  void changed();

 private:
  /// What a drawing depends on.
  struct Subject {
    planning::SamplingRegion region;
    std::pair<double, double> range;
  };

  /// The search whose hypercubes are drawn: of several the one that gave the path, or, as long as
  /// none has, the first.
  [[nodiscard]] std::size_t search() const;
  void begin_run();
  void take_roadmap();
  void draw(const Subject& subject);
  void clear();

  Document& document_;
  PlanPanel& panel_;
  PlanningSession& session_;
  SceneView& view_;
  QAction& shown_;
  /// Of the run's searches; empty: no hypercubes.
  std::vector<planning::SamplingRegion> regions_;
  std::optional<Subject> drawn_;
  std::vector<planning::PalmBox> boxes_;
  LatestJob job_;
};

}  // namespace handway::gui
