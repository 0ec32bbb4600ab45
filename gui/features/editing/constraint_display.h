#pragma once

#include <QObject>

namespace handway::gui {

class Document;
class SceneView;

/// Draws the scene's constraints into the view, for the posture on screen.
class ConstraintDisplay : public QObject {
  Q_OBJECT

 public:
  /// Both outlive it.
  ConstraintDisplay(Document& document, SceneView& view, QObject* parent = nullptr);

 private:
  void show();

  Document& document_;
  SceneView& view_;
};

}  // namespace handway::gui
