#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/queries/region_draws.h"
#include "model/jobs/background.h"
#include "model/planning/palm_roadmap.h"
#include "widgets/panels/floating_card.h"

#include <QObject>

#include <optional>
#include <string>
#include <utility>
#include <vector>

class QAction;
class QCheckBox;
class QLabel;

class QGridLayout;
class QToolButton;

namespace handway::gui {

class Document;
class PlanSettings;
class PlanningSession;
class SceneView;

/// Draws into the view where the palm goes in the hypercubes that the session's planner sweeps,
/// as long as it is wanted: those that are still searched apart from those that aren't.
class HypercubeDisplay : public QObject {
  Q_OBJECT

 public:
  static constexpr int kMostBoxes = 65;  ///< With more hypercubes, every n-th is drawn.

  /// @param shown a switch. All outlive it.
  HypercubeDisplay(Document& document, PlanSettings& settings, PlanningSession& session,
                   SceneView& view, QAction& shown, QObject* parent = nullptr);

  /// Half-side of the hypercubes that are drawn, or would be; nothing: the roadmap has none.
  [[nodiscard]] std::optional<double> half_side() const;
  /// Returns the boxes that are drawn.
  [[nodiscard]] const std::vector<planning::PalmBox>& boxes() const { return boxes_; }

 signals:
  void changed();

 private:
  /// Input of a drawing.
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
  PlanSettings& settings_;
  PlanningSession& session_;
  SceneView& view_;
  QAction& shown_;
  /// Regions of the run's searches; empty: no hypercubes.
  std::vector<planning::SamplingRegion> regions_;
  std::optional<Subject> drawn_;
  std::vector<planning::PalmBox> boxes_;
  LatestJob job_;
};

/// Floats in a corner of the view: how many nodes and edges a roadmap has, which colour stands
/// for which number of principal motion directions, and whether hypercubes are drawn with it.
class RoadmapLegend : public FloatingCard {
  Q_OBJECT

 public:
  /// Origin of a roadmap.
  struct Search {
    bool goes_on = false;
    std::optional<double> half_side;  ///< ρ_a of the hypercubes; nothing: there are none.
  };

  /// @param hypercubes their switch; outlives it.
  RoadmapLegend(QAction& hypercubes, QWidget* host);

  /// @param roadmap null or empty hides it.
  void show_roadmap(const SharedRoadmap& roadmap, const Search& search);

 private:
  void place() override;

  QLabel* title_;
  QWidget* details_;
  QToolButton* fold_;
  QLabel* note_;
  QLabel* counts_;
  QCheckBox* boxes_;
};

/// Nodes by their number of principal motion directions. @returns shape [most + 1].
[[nodiscard]] std::vector<int> nodes_per_pmds(const PalmRoadmap& roadmap);

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

struct PathRecord;

/// Floats in a corner of the view: which ghost is where a search without a path came to from the
/// start and from the goal, and what collided most.
class FrontierLegend : public FloatingCard {
  Q_OBJECT

 public:
  explicit FrontierLegend(QWidget* host);

  /// @param colliding the bodies that collided most; may be empty.
  void show_frontier(const planning::SearchReach& reach, const std::vector<std::string>& colliding);

 signals:
  /// Show the robot at one of the two.
  void visited(bool from_start);
  void closed();

 private:
  void place() override;
  QLabel* add_row(QGridLayout& rows, const char* name, bool from_start);

  QLabel* from_start_;
  QLabel* from_goal_;
  QLabel* colliding_;
};

/// Shows in the view how far a search that found no path came from both ends, until the next run
/// or edit.
class FrontierDisplay : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  FrontierDisplay(Document& document, PlanningSession& session, SceneView& view,
                  QObject* parent = nullptr);

  /// Returns the reach that is shown, or null.
  [[nodiscard]] const planning::SearchReach* shown() const {
    return shown_ ? &*shown_->reach : nullptr;
  }

 private:
  void note(const PathRecord& record);
  void show();
  void clear();

  Document& document_;
  SceneView& view_;
  FrontierLegend* legend_;
  std::optional<planning::PlanResult> last_;   ///< Result of the present run; has a reach.
  std::optional<planning::PlanResult> shown_;  ///< Has a reach.
};

}  // namespace handway::gui
