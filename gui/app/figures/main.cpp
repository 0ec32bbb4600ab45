/// handway-figures FOLDER: takes pictures of the hand for the basis that `handway pca --plots
/// FOLDER` wrote there. handway-figures FILE.yaml: takes the film strips of a file that `handway
/// reproduce` wrote, beside it.
#include "app/figures/basis_figures.h"
#include "app/figures/film_figures.h"

#include <QApplication>
#include <QTemporaryDir>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

namespace gui = handway::gui;

namespace {

constexpr int kDone = 0;
constexpr int kWrongUsage = 2;
constexpr int kInvalidInput = 3;

bool has_display() { return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY"); }

void draw_film(const std::filesystem::path& file) {
  const QString path = QString::fromStdString((file.parent_path() / file.stem()).string());
  gui::write_film_figure(gui::read_film_data(file), path);
}

void draw_basis(const std::filesystem::path& folder) {
  const gui::FigureData data = gui::read_figure_data(folder);
  const auto path = [&](const char* name) {
    return QString::fromStdString((folder / name).string());
  };
  gui::write_direction_figure(data, path("directions"));
  gui::write_grid_figure(data, path("grid"));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("handway-figures: usage: handway-figures FOLDER | FILE.yaml\n", stderr);
    return kWrongUsage;
  }
  if (!has_display()) {
    std::fputs("handway-figures: no display. Start it under xvfb-run\n", stderr);
    return kWrongUsage;
  }
  try {
    // Qt complains where a session has no folder of its own, as in containers.
    const QTemporaryDir runtime;
    if (!std::getenv("XDG_RUNTIME_DIR") && runtime.isValid()) {
      qputenv("XDG_RUNTIME_DIR", runtime.path().toLocal8Bit());
    }
    const QApplication application(argc, argv);
    const std::filesystem::path source = argv[1];
    const bool is_film = !std::filesystem::is_directory(source) && source.extension() == ".yaml";
    (is_film ? draw_film : draw_basis)(source);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "handway-figures: %s\n", error.what());
    return kInvalidInput;
  }
  return kDone;
}
