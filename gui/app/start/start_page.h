#pragma once

#include "widgets/panels/dock_layout.h"

#include <QString>

#include <filesystem>
#include <string>
#include <vector>

class QVBoxLayout;

namespace handway::gui {

/// A scene that comes with the program.
struct ShippedScene {
  std::filesystem::path file;
  QString title;  ///< "Can on a table"
  QString description;
  QString picture;  ///< In the resource folder; may not exist.
};

/// Returns the scenes that ship in alphabetical order; empty if their folder is missing.
[[nodiscard]] std::vector<ShippedScene> shipped_scenes();
/// Returns whether the scene is in the folder of the scenes that ship.
[[nodiscard]] bool is_shipped(const std::filesystem::path& scene);

/// Page of an empty window: scenes to open, robots to begin with, recent files.
class StartPage : public ScrollingPage {
  Q_OBJECT

 public:
  explicit StartPage(QWidget* parent = nullptr);

  /// Rebuilds the page, after a change of theme or of the recent files.
  void refresh();

 signals:
  void open_requested(const QString& file);
  /// Emitted when a scene is to be opened, planned and played.
  void try_requested(const QString& file);
  void browse_requested();
  void new_requested(const std::string& robot);
  /// Emitted when an arm and a hand are to be chosen from pictures.
  void choice_requested();

 protected:
  void resizeEvent(QResizeEvent* event) override;
  /// Takes the focus, so that the Tab key goes to its pictures first.
  void showEvent(QShowEvent* event) override;

 private:
  void add_trial(QVBoxLayout& layout);
  void add_scenes(QVBoxLayout& layout);
  void add_robots(QVBoxLayout& layout);
  void add_recent(QVBoxLayout& layout);

  int columns_ = 1;  ///< Number of columns of pictures.
};

}  // namespace handway::gui
