#include "reproduce_figures.h"

#include "reproduce_films.h"
#include "reproduce_postures.h"

#include <iterator>
#include <utility>

namespace handway::tools {

std::set<int> reproducible_figures() {
  std::set<int> all = posture_figures();
  all.insert(film_figures().begin(), film_figures().end());
  return all;
}

std::vector<ReproducedFigure> reproduce_figures(const std::set<int>& figures,
                                                const planning::Extensions& extensions,
                                                double time_limit_s,
                                                const std::filesystem::path& folder) {
  std::vector<ReproducedFigure> made = reproduce_postures(figures, folder);
  std::vector<ReproducedFigure> films = reproduce_films(figures, extensions, time_limit_s, folder);
  made.insert(made.end(), std::make_move_iterator(films.begin()),
              std::make_move_iterator(films.end()));
  return made;
}

}  // namespace handway::tools
