#include "reproduce_films.h"

#include "campaign_session.h"
#include "figures_program.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/paths/path_csv.h"

#include <fmt/format.h>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

struct Row {
  const char* scene;
  const char* planner;
  const char* label;
  const char* camera = "";  ///< Keys of the row that turn it, where a shelf is in the way.
};

struct Figure {
  int number;
  const char* caption;
  const char* view;
  std::vector<Row> rows;
};

const std::vector<Figure>& figures_there_are() {
  static const std::vector<Figure> kFigures = {
      {14,
       "The hand along a path: planned in all joints of the hand, and with principal motion "
       "directions",
       "hand",
       {{"can_on_table", "full-prm", "All joints of the hand (full-prm)"},
        {"can_on_table", "pmd-prm", "Principal motion directions (pmd-prm)"}}},
      {17,
       "Paths of the four problems",
       "task",
       {{"cans_on_desk", "auto", "1: Cans on a desk"},
        {"can_in_box", "auto", "2: Can in a box"},
        {"cans_in_shelf", "auto", "3: Cans in a shelf", ", azimuth_deg: -125, elevation_deg: 14"},
        {"t_shape", "auto", "4: T in a kitchen shelf", ", azimuth_deg: -122, elevation_deg: 14"}}}};
  return kFigures;
}

class FilmMaker {
 public:
  FilmMaker(const planning::Extensions& extensions, double time_limit_s, const fs::path& folder)
      : extensions_(extensions), time_limit_s_(time_limit_s), folder_(folder) {}

  [[nodiscard]] ReproducedFigure make(const Figure& figure) const {
    ReproducedFigure made{figure.number, figure.caption, "", {}, {}, ""};
    const std::string name = fmt::format("figure_{}", figure.number);
    make_out_folder(folder_ / name);
    std::string rows;
    for (const Row& row : figure.rows) {
      rows += film_row(row, name, made);
    }
    if (rows.empty()) {
      return made;
    }
    const fs::path file = folder_ / (name + ".yaml");
    geometric::replace_file(file, fmt::format("title: \"{}\"\nframes: 6\nview: {}\nrows:\n{}",
                                              figure.caption, figure.view, rows));
    try {
      draw_figures(file);
      made.pictures.push_back({figure.caption, name + ".png"});
    } catch (const geometric::InputError& error) {
      made.problem += error.what();
    }
    return made;
  }

 private:
  // Nothing, and a sentence in `made`, if there is no path.
  [[nodiscard]] std::string film_row(const Row& row, const std::string& name,
                                     ReproducedFigure& made) const {
    const fs::path scene =
        geometric::resource_dir().parent_path() / "scenes" / fmt::format("{}.yaml", row.scene);
    const planning::LoadedScene loaded = planning::load_scene(scene, extensions_);
    const planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
    const planning::PlanResult result =
        extensions_.planners().create(row.planner)->plan(problem, {.time_limit_s = time_limit_s_});
    if (!result.solved()) {
      made.problem += fmt::format("{}: {} ", row.label, result.reason);
      return "";
    }
    const std::string path = fmt::format("{}/{}_{}.csv", name, row.scene, row.planner);
    planning::write_path_csv(result.path, problem.model(), folder_ / path);
    return fmt::format("  - {{label: \"{}\", scene: \"{}\", path: {}{}}}\n", row.label,
                       fs::absolute(scene).string(), path, row.camera);
  }

  const planning::Extensions& extensions_;
  double time_limit_s_;
  const fs::path& folder_;
};

}  // namespace

const std::set<int>& film_figures() {
  static const std::set<int> kNumbers = [] {
    std::set<int> numbers;
    for (const Figure& figure : figures_there_are()) {
      numbers.insert(figure.number);
    }
    return numbers;
  }();
  return kNumbers;
}

std::vector<ReproducedFigure> reproduce_films(const std::set<int>& figures,
                                              const planning::Extensions& extensions,
                                              double time_limit_s, const fs::path& folder) {
  const FilmMaker maker(extensions, time_limit_s, folder);
  std::vector<ReproducedFigure> made;
  for (const Figure& figure : figures_there_are()) {
    if (figures.contains(figure.number)) {
      made.push_back(maker.make(figure));
    }
  }
  return made;
}

}  // namespace handway::tools
