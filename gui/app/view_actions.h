#pragma once

#include "model/jobs/background.h"
#include "view3d/body_meshes.h"

#include <QAction>
#include <QList>
#include <QObject>

class QActionGroup;
class QMainWindow;
class QMenu;
class QToolBar;
class QToolButton;

namespace handway::gui {

class Document;
class Preferences;
class SceneView;
class WindowActions;

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

/// The commands of the 3-D view, in the View menu and on the tool bar: where to look from, in
/// which projection, and what to show.
class ViewActions : public QObject {
  Q_OBJECT

 public:
  /// All outlive the actions.
  ViewActions(QMainWindow& window, WindowActions& others, SceneView& view, BodyDisplayTool& bodies,
              Preferences& preferences);

  /// Redraws the icons, after a change of theme.
  void refresh_icons();

 private:
  QAction* make(const char* name, const QString& text, const char* keys, const QString& tip);
  QAction* make_switch(const char* name, const QString& text, const char* keys, const QString& tip,
                       bool on);
  QMenu* make_standard_views();
  QMenu* make_displays();
  void follow_preferences();

  QMainWindow& window_;
  SceneView& view_;
  BodyDisplayTool& bodies_;
  Preferences& preferences_;
  QAction* fit_;
  QAction* orthographic_;
  QAction* floor_;
  QAction* cube_;
  QActionGroup* displays_;
  QToolButton* display_button_;
  QList<QAction*> on_bar_;
  QList<QAction*> with_icon_;
};

}  // namespace handway::gui
