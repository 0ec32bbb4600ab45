#include "app/start/shipped_scenes.h"

#include "handway/geometric/io/resources.h"

#include <algorithm>
#include <system_error>

namespace handway::gui {

namespace fs = std::filesystem;

std::vector<ShippedScene> shipped_scenes() {
  std::vector<ShippedScene> scenes;
  std::error_code none;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(geometric::resource_dir().parent_path() / "scenes", none)) {
    if (entry.path().extension() != ".yaml") {
      continue;
    }
    const QString stem = QString::fromStdString(entry.path().stem().string());
    QString title = stem;
    title.replace('_', ' ');
    title[0] = title[0].toUpper();
    scenes.push_back({entry.path(), title, QStringLiteral(":/thumbnails/%1.jpg").arg(stem)});
  }
  std::ranges::sort(scenes, {}, &ShippedScene::file);
  return scenes;
}

}  // namespace handway::gui
