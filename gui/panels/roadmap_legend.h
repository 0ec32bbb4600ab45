#pragma once

#include "workers/palm_roadmap.h"

#include <QFrame>

class QLabel;

namespace handway::gui {

/// Floats in a corner of the view: how many nodes and edges a roadmap has, and which
/// colour stands for which number of principal motion directions.
class RoadmapLegend : public QFrame {
  Q_OBJECT

 public:
  explicit RoadmapLegend(QWidget* host);

  /// @param roadmap null or empty hides it.
  void show_roadmap(const SharedRoadmap& roadmap);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QLabel* title_;
  QLabel* note_;
  QLabel* counts_;
};

/// Nodes by their number of principal motion directions. @returns shape [most + 1].
[[nodiscard]] std::vector<int> nodes_per_pmds(const PalmRoadmap& roadmap);

}  // namespace handway::gui
