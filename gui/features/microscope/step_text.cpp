#include "features/microscope/step_text.h"

#include "handway/planning/core/observer.h"

#include <QObject>

namespace handway::gui {
namespace {

namespace lines = planning::algorithm_lines;
using planning::AlgorithmStep;

QString node_name(int node) {
  return node == 0   ? QObject::tr("the start")
         : node == 1 ? QObject::tr("the goal")
                     : QObject::tr("node %1").arg(node);
}

QString percent(double position) {
  return QObject::tr("%1 % of the arm segment").arg(100.0 * position, 0, 'f', 0);
}

QString edge_text(const AlgorithmStep& step, const QString& text) {
  QString whole = text.arg(node_name(step.from), node_name(step.to));
  whole.replace(0, 1, whole.front().toUpper());
  return whole;
}

QString arm_text(const AlgorithmStep& step, bool has_sample) {
  if (!has_sample) {
    return QObject::tr("No configuration of the arm reaches the sampled pose of the tool.");
  }
  return step.yes ? QObject::tr("Arm sample at %1: no self-collision.").arg(percent(step.position))
                  : QObject::tr("Arm sample at %1: self-collision, sampled again.")
                        .arg(percent(step.position));
}

QString hand_text(const RecordedRun& run, const AlgorithmStep& step) {
  const QString axes = step.count == 1 ? QObject::tr("The hand sampled on one axis")
                                       : QObject::tr("The hand sampled on %1 axes").arg(step.count);
  if (step.yes) {
    return QObject::tr("%1 is free: a sample.").arg(axes);
  }
  const auto& [a, b] = run.pairs[static_cast<std::size_t>(step.pair)];
  if (b.empty()) {
    return QObject::tr("%1 is refused: it violates constraint %2.")
        .arg(axes, QString::fromStdString(a));
  }
  return QObject::tr("%1 is refused: %2 touches %3.")
      .arg(axes, QString::fromStdString(a), QString::fromStdString(b));
}

}  // namespace

QString step_text(const RecordedRun& run, std::size_t index) {
  const RecordedStep& recorded = run.steps[index];
  const AlgorithmStep& step = recorded.step;
  if (step.line == lines::kArmFree) {
    return arm_text(step, recorded.sample >= 0);
  }
  if (step.line == lines::kNoArm) {
    return QObject::tr("All samples for the arm are used. Next attempt.");
  }
  if (step.line == lines::kHandFreeOfSelf || step.line == lines::kHandFree) {
    return hand_text(run, step);
  }
  if (step.line == lines::kAddNode) {
    return step.from <= 1 ? QObject::tr("The roadmap begins with %1.").arg(node_name(step.from))
                          : QObject::tr("The sample becomes %1.").arg(node_name(step.from));
  }
  if (step.line == lines::kNeighbours) {
    return (step.count == 1 ? QObject::tr("%1 has one neighbour near enough.")
                            : QObject::tr("%1 has %2 neighbours near enough.")
                                  .arg(QStringLiteral("%1"))
                                  .arg(step.count))
        .arg(node_name(step.from).replace(0, 1, QLatin1Char('N')));
  }
  if (step.line == lines::kSameComponent) {
    return edge_text(step, QObject::tr("%1 and %2 are joined already: no edge is needed."));
  }
  if (step.line == lines::kLocalPlan) {
    return edge_text(step, step.yes ? QObject::tr("%1 to %2: the straight motion is free.")
                                    : QObject::tr("%1 to %2: the straight motion collides."));
  }
  if (step.line == lines::kAddEdge) {
    return edge_text(step, QObject::tr("%1 and %2 get an edge."));
  }
  if (step.line == lines::kWiden) {
    return QObject::tr("Another pass along the arm segment, with hypercubes of ±%1.")
        .arg(step.rho_a, 0, 'g', 3);
  }
  if (step.line == lines::kHypercube) {
    return QObject::tr("The hypercube at %1 is next.").arg(percent(step.position));
  }
  if (step.line == lines::kJoined) {
    return step.yes ? QObject::tr("Start and goal are joined: there is a path.")
                    : QObject::tr("Start and goal are not joined yet.");
  }
  if (step.line == lines::kSearchRange) {
    return QObject::tr("From now on only from %1 % to %2 % of the arm segment is searched.")
        .arg(100.0 * step.position, 0, 'f', 0)
        .arg(100.0 * step.range_end, 0, 'f', 0);
  }
  return QObject::tr("The search ends without a path.");
}

}  // namespace handway::gui
