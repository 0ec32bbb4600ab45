#pragma once

#include "model/document/arrange.h"

#include <QObject>

#include <string>
#include <vector>

namespace handway::gui {

class ArrayCard;
class SceneEditor;
class SceneView;

/// Copies of the selected objects in rows or around an axis: shown while a card over the
/// view is filled in, made in one edit.
class ArrayTool : public QObject {
  Q_OBJECT

 public:
  /// Most copies that are made at once.
  static constexpr int kMostCopies = 400;

  /// All outlive it.
  ArrayTool(SceneEditor& editor, SceneView& view, QObject* parent = nullptr);

  void begin();

 private:
  void show_copies();
  void finish();
  void end();

  SceneEditor& editor_;
  SceneView& view_;
  ArrayCard* card_;
  ObjectNames names_;  ///< What is copied.
  Copies copies_;
};

}  // namespace handway::gui
