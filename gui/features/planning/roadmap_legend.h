#pragma once

#include "model/planning/palm_roadmap.h"
#include "widgets/panels/floating_card.h"

#include <optional>

class QAction;
class QCheckBox;
class QLabel;

namespace handway::gui {

/// Floats in a corner of the view: how many nodes and edges a roadmap has, which colour stands
/// for which number of principal motion directions, and whether hypercubes are drawn with it.
class RoadmapLegend : public FloatingCard {
  Q_OBJECT

 public:
  /// How a roadmap came about.
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
  QLabel* note_;
  QLabel* counts_;
  QCheckBox* boxes_;
};

/// Nodes by their number of principal motion directions. @returns shape [most + 1].
[[nodiscard]] std::vector<int> nodes_per_pmds(const PalmRoadmap& roadmap);

}  // namespace handway::gui
