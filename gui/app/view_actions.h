#pragma once

#include "model/jobs/background.h"
#include "model/settings/preferences.h"
#include "view3d/body_meshes.h"

#include <QAction>
#include <QElapsedTimer>
#include <QLabel>
#include <QList>
#include <QObject>
#include <QTimer>

class QActionGroup;
class QMenu;
class QToolButton;

namespace handway::gui {

class SceneView;

/// Shows in the status bar the frames per second of a view; nothing while it rests.
class FrameRateLabel : public QLabel {
  Q_OBJECT

 public:
  /// @param view outlives the label.
  explicit FrameRateLabel(SceneView& view, QWidget* parent = nullptr);

 private:
  void count_frame();
  void show_rate();

  SceneView& view_;
  QTimer tick_;
  QElapsedTimer since_;
  int frames_ = 0;
};

class PlanSettings;
class Workbench;

/// Applies the preferences when the window opens and whenever they change.
class PreferenceEffects : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives it.
  explicit PreferenceEffects(Workbench& workbench);

 signals:
  /// The window shall have other colours.
  void theme_changed(handway::gui::Theme theme);

 private:
  void apply_at_once(const PreferenceValues& values);
  void apply_to_planning(const PreferenceValues& values);
  void follow();

  const Preferences& preferences_;
  SceneView& view_;
  PlanSettings& planning_;
  PreferenceValues applied_;
};

/// Handles the Enter key in the window: on a button it acts as the Space key; in a field it enters
/// the value and then gives the focus back to the view, so that the keys of the view's commands
/// work again.
class EnterKey : public QObject {
  Q_OBJECT

 public:
  /// The window and the view outlive it.
  EnterKey(QWidget& window, QWidget& view);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget& window_;
  QWidget& view_;
};

class Document;
class Preferences;

/// Draws the scene's bodies as they look, or as collision checking has them. Makes what that
/// takes in the background.
class BodyDisplayTool : public QObject {
  Q_OBJECT

 public:
  /// The document and the view outlive it.
  BodyDisplayTool(Document& document, SceneView& view, QObject* parent = nullptr);

  void show(BodyDisplay display);
  [[nodiscard]] BodyDisplay display() const { return display_; }
  /// Returns whether the geometry to draw is still being made.
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
  /// @param workbench, bodies outlive the actions.
  ViewActions(Workbench& workbench, BodyDisplayTool& bodies);

 private:
  QAction* make(const char* name, const QString& text, const char* keys, const QString& tip);
  QAction* make_switch(const char* name, const QString& text, const char* keys, const QString& tip,
                       bool on);
  QMenu* make_standard_views();
  QMenu* make_displays();
  void place_actions();
  void follow_preferences();
  void refresh_icon();

  Workbench& workbench_;
  SceneView& view_;
  BodyDisplayTool& bodies_;
  Preferences& preferences_;
  QAction* show_all_;
  QAction* show_selection_;
  QMenu* standard_views_;
  QAction* orthographic_;
  QAction* floor_;
  QAction* cube_;
  QActionGroup* displays_;
  QMenu* displays_menu_;
  QToolButton* display_button_;
  QToolButton* views_button_;
};

}  // namespace handway::gui
