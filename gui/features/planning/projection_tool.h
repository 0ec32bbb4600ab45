#pragma once

#include "model/jobs/background.h"

#include <QObject>

namespace handway::gui {

class Document;
class PathPlayer;
class PlanningSession;
class ProjectionPanel;

/// Keeps the projection of the session's roadmap up to date while it is seen, and moves the
/// robot to nodes that are clicked.
class ProjectionTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. Makes the panel; a window takes it over.
  ProjectionTool(Document& document, PathPlayer& player, QObject* parent = nullptr);

  /// @param session outlives it.
  void follow(PlanningSession& session);

  [[nodiscard]] ProjectionPanel* panel() const { return panel_; }
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

 private:
  void update();

  Document& document_;
  PathPlayer& player_;
  PlanningSession* session_ = nullptr;
  ProjectionPanel* panel_;
  bool outdated_ = false;
  LatestJob job_;
};

}  // namespace handway::gui
