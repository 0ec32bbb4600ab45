#pragma once

#include <QString>

#include <filesystem>
#include <vector>

namespace handway::gui {

/// A scene that comes with the program.
struct ShippedScene {
  std::filesystem::path file;
  QString title;    ///< "Can on a table"
  QString picture;  ///< Of the resources; may not be there.
};

/// In alphabetical order; empty if the program's scenes are not where they belong.
[[nodiscard]] std::vector<ShippedScene> shipped_scenes();

}  // namespace handway::gui
