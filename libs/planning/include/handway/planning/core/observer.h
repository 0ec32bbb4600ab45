#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/planning/paths/path.h"

#include <string_view>

namespace handway::planning {

/// A roadmap or tree node as an observer sees it.
struct NodeEvent {
  int id = 0;
  const geometric::Configuration& q;
  int pmd_count = 0;   ///< Principal directions used for the sample; 0: none.
  double step = 0.0;   ///< Where on the arm segment, [0, 1]: its hypercube or arm_progress().
  double rho_a = 0.0;  ///< Half-side of the hypercube it was drawn from.
  int search = 0;      ///< Which of several searches that run side by side found it.
};

class AlgorithmObserver;

/// Told what a planner does while it plans, on the planner's own thread and in
/// the same order on every run. Everything defaults to nothing.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void on_node(const NodeEvent& /*node*/) {}
  virtual void on_edge(int /*from*/, int /*to*/) {}
  /// Of several searches, the one whose path is the planner's.
  virtual void on_winner(int /*search*/) {}
  /// The stretch of the arm segment that is still being searched.
  virtual void on_search_range(double /*d_ini*/, double /*d_goal*/) {}
  /// A free path from start to goal that is being optimised.
  virtual void on_path(const Path& /*path*/) {}
  /// `fraction` of the sample budget that is spent, in [0, 1], and what is being done.
  virtual void on_progress(double /*fraction*/, std::string_view /*activity*/) {}

  /// Who watches the steps of the paper's algorithms, too; null: nobody.
  [[nodiscard]] virtual AlgorithmObserver* algorithm() { return nullptr; }
};

}  // namespace handway::planning
