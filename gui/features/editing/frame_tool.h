#pragma once

#include "handway/geometric/math/pose.h"
#include "model/document/selection.h"

#include <QObject>

namespace handway::gui {

class Workbench;

/// Draws the named frames of the scene, also while one of them is dragged, and adds frames.
class FrameTool : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives the tool.
  explicit FrameTool(Workbench& workbench);

 private:
  void add_command();
  void show();
  void drag(const SceneItem& item, const geometric::Pose& X_WF);

  Workbench& workbench_;
  bool has_shown_ = false;  ///< Frames are drawn.
};

}  // namespace handway::gui
