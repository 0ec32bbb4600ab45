#pragma once

#include "panels/floating_card.h"
#include "workers/palm_roadmap.h"

class QLabel;

namespace handway::gui {

/// Floats in a corner of the view: how many nodes and edges a roadmap has, and which
/// colour stands for which number of principal motion directions.
class RoadmapLegend : public FloatingCard {
  Q_OBJECT

 public:
  explicit RoadmapLegend(QWidget* host);

  /// @param roadmap null or empty hides it.
  void show_roadmap(const SharedRoadmap& roadmap);

 private:
  void place() override;

  QLabel* title_;
  QLabel* note_;
  QLabel* counts_;
};

/// Nodes by their number of principal motion directions. @returns shape [most + 1].
[[nodiscard]] std::vector<int> nodes_per_pmds(const PalmRoadmap& roadmap);

}  // namespace handway::gui
