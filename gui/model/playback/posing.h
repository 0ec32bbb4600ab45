#pragma once

#include "model/document/document.h"
#include "model/playback/path_player.h"

#include <QObject>

namespace handway::gui {

/// Moves the document's robot by hand, which pauses a path that is played.
class Posing : public QObject {
 public:
  /// Both outlive it.
  Posing(Document& document, PathPlayer& player, QObject* parent = nullptr)
      : QObject(parent), document_(document), player_(player) {}

  void set(const Eigen::VectorXd& q) {
    player_.pause();
    document_.set_configuration(q);
  }
  void apply(const geometric::NamedPosture& posture) {
    player_.pause();
    document_.apply_posture(posture);
  }

 private:
  Document& document_;
  PathPlayer& player_;
};

}  // namespace handway::gui
