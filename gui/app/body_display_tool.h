#pragma once

#include "model/document/body_display.h"
#include "model/jobs/latest_job.h"

#include <QObject>

namespace handway::gui {

class Document;
class SceneView;

/// Draws the scene's bodies as they look, or as collision checking has them. Makes what that
/// takes on a thread of its own.
class BodyDisplayTool : public QObject {
  Q_OBJECT

 public:
  /// Both outlive it.
  BodyDisplayTool(Document& document, SceneView& view, QObject* parent = nullptr);

  void show(BodyDisplay display);
  [[nodiscard]] BodyDisplay display() const { return display_; }
  /// True while what to draw is being made.
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

 private:
  void refresh();

  Document& document_;
  SceneView& view_;
  BodyDisplay display_ = BodyDisplay::kVisual;
  LatestJob job_;
};

}  // namespace handway::gui
