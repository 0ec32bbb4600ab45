#pragma once

#include <QObject>
#include <QTimer>

#include <cstddef>

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
  void wait_for_idleness();
  void give_back_when_idle();

  Workbench& workbench_;
  QTimer pause_;
  std::size_t returns_ = 0;  ///< Number of returns since the last work.
};

}  // namespace handway::gui
