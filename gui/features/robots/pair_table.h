#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/setup/collision_sampling.h"

#include <QString>
#include <QTreeWidget>

#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// Pairs of a robot's links: whether they may touch and why, and in which share of the samples they
/// do. The check box of a row lets a person decide.
class PairTable : public QTreeWidget {
  Q_OBJECT

 public:
  explicit PairTable(QWidget* parent = nullptr);

  /// Lists all pairs that move against each other, and those that joints connect.
  /// @param sampled of the model. @param allowed what follows from it.
  void show_pairs(const geometric::SelfCollisionSamples& sampled,
                  const geometric::AllowedCollisions& allowed);
  /// Returns the listed kinds with the number of pairs: "Never (140)"; the first is all.
  [[nodiscard]] QStringList kinds() const;
  /// Hides pairs of other kinds. @param kind of kinds(), by its place.
  void show_kind(int kind);

 signals:
  void decided(const handway::geometric::AllowedCollisions::Pair& pair, bool allowed_collisions);
  void looked_at(const handway::geometric::AllowedCollisions::Pair& pair);

 private:
  void add(const geometric::AllowedCollisions::Pair& pair,
           std::optional<geometric::AllowedReason> reason, double share);
};

}  // namespace handway::gui
