#pragma once

#include <QObject>
#include <QTimer>

namespace handway::gui {

class Workbench;

/// Gives back to the system what scenes, plans and edits no longer need: the allocator keeps freed
/// blocks for later, and what it keeps adds up from scene to scene.
class FreedMemory : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives it.
  explicit FreedMemory(Workbench& workbench);

 private:
  void give_back_when_idle();

  Workbench& workbench_;
  QTimer pause_;
};

}  // namespace handway::gui
