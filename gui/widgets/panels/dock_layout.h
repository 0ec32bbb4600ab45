#pragma once

#include <QList>
#include <QMainWindow>
#include <QScrollArea>
#include <QString>

#include <functional>
#include <vector>

class QAction;
class QWidget;

namespace handway::gui {

/// Turns the pages of all tabs that `widget` is in so that it is in front, and shows its dock.
void bring_to_front(const QWidget& widget);

/// Returns whether the dock that `widget` is in is shown, perhaps behind another.
[[nodiscard]] bool is_dock_shown(const QWidget& widget);

/// Content of a dock or a tab.
struct DockContent {
  const char* name;  ///< Its object name, by which its place is kept between runs.
  QString title;
  QWidget* widget;
  int height = 0;  ///< At first, px; for those above each other.
  /// Adds a page of another part of the window; empty: there is no room for any.
  std::function<void(const QString& title, QWidget* page)> add_page = {};
};

/// Contents of the docks around the view.
struct DockContents {
  std::vector<DockContent> left;     ///< Above each other.
  std::vector<DockContent> history;  ///< Behind the last on the left, hidden at first.
  std::vector<DockContent> control;  ///< Tabs on the right.
  std::vector<DockContent> below;    ///< Behind each other below the view, hidden at first.
};

/// Actions that show and hide docks.
struct DockSwitches {
  QList<QAction*> panels;
  QList<QAction*> history;
};

/// Docks at their usual places.
[[nodiscard]] DockSwitches build_docks(QMainWindow& window, const DockContents& contents);

/// Sets the Tab order of a widget to all widgets in it, in the order in which they were put there,
/// also those that were added later than the widgets after it.
void order_tabs(QWidget& widget);

/// A page without a frame that scrolls where it has not enough room. The Tab key goes through what
/// is in it in the order in which it was put there.
class ScrollingPage : public QScrollArea {
 public:
  explicit ScrollingPage(QWidget* parent = nullptr);

 protected:
  bool focusNextPrevChild(bool next) override;
};

/// A panel that scrolls up and down where it has not enough room. It never is narrower than what is
/// in it.
class PanelArea : public ScrollingPage {
 public:
  /// @param content may be given later, by setWidget().
  explicit PanelArea(QWidget* content = nullptr, QWidget* parent = nullptr);

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] int width_around(const QSize& content) const;
};

/// `wanted`, but no larger than the window that a dialog belongs to.
[[nodiscard]] QSize within_window(const QWidget& dialog, const QSize& wanted);

/// Saves the places of the docks and the geometry of the window between runs.
void save_layout(const QMainWindow& window);
/// @returns false if there is none, or one of another version of the program.
bool restore_layout(QMainWindow& window);
/// Restores the place of the window; at first it has the `wanted` size, px, or is maximised on a
/// screen that has no room for that and a frame.
void restore_geometry(QMainWindow& window, const QSize& wanted);

}  // namespace handway::gui
