#pragma once

#include <QObject>

#include <string>

class QMenu;

namespace handway::gui {

class Workbench;

/// Views that are saved with the scene: a menu of them, to go there, to save one and to delete one.
class SavedViews : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives it.
  explicit SavedViews(Workbench& workbench);

 private:
  /// Lists the views of the scene as it is.
  void fill();
  void ask_for_name();
  void save(const std::string& name);

  Workbench& workbench_;
  QMenu* menu_;
};

/// Adds saved views, measuring of distances, and the section plane.
void add_viewing(Workbench& workbench);

}  // namespace handway::gui
