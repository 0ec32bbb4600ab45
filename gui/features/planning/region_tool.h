#pragma once

#include "model/jobs/latest_job.h"

#include <QObject>

namespace handway::gui {

class Document;
class PlanPanel;
class RegionPreviewBox;
class SceneView;

/// Shows in the view what the plan panel's parameters mean before they are used: where palm and
/// fingertips are in what the planner would draw.
class RegionTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. Puts a section into the panel.
  RegionTool(Document& document, PlanPanel& panel, SceneView& view, QObject* parent = nullptr);

  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }
  [[nodiscard]] bool is_shown() const { return shown_; }

 private:
  void read_planner();
  void update();
  void clear();

  Document& document_;
  PlanPanel& panel_;
  SceneView& view_;
  RegionPreviewBox* box_;
  bool shown_ = false;
  bool busy_writing_ = false;  ///< A slider's value is on its way into the panel.
  LatestJob job_;
};

}  // namespace handway::gui
