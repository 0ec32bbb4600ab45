#pragma once

#include <QObject>
#include <QTimer>

namespace handway::gui {

class Workbench;

/// Returns unused memory of scenes, plans and edits to the system: the allocator keeps freed blocks
/// for later, and they add up from scene to scene.
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
