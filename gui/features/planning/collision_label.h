#pragma once

#include "model/document/collision_monitor.h"

#include <QLabel>

namespace handway::gui {

/// "in collision: A with B", or how far the closest bodies are apart.
class CollisionLabel : public QLabel {
  Q_OBJECT

 public:
  explicit CollisionLabel(QWidget* parent = nullptr);

  void show_report(const CollisionReport& report);
  void show_nothing();
};

}  // namespace handway::gui
