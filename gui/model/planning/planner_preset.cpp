#include "model/planning/planner_preset.h"

#include "handway/geometric/io/input_error.h"

#include <QObject>

#include <algorithm>
#include <initializer_list>

namespace handway::gui {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;
using Texts = std::vector<std::string>;

bool is_of_the_paper(const std::string& planner) {
  return planner == "pmd-prm" || planner == "full-prm";
}

PlannerPreset own_values(const std::string& planner) {
  PlannerPreset preset{QObject::tr("Balanced"), QObject::tr("The planner's own values."), {}, true};
  if (is_of_the_paper(planner)) {
    preset.purpose = QObject::tr(
        "The paper's values (Table 3), in a corridor that does not grow beyond ρₐ = 0.05.");
  }
  return preset;
}

Texts texts_of(const std::vector<planning::Parameter>& parameters) {
  Texts texts;
  texts.reserve(parameters.size());
  for (const planning::Parameter& parameter : parameters) {
    texts.push_back(planning::to_text(parameter));
  }
  return texts;
}

void set_all(const std::vector<planning::Parameter>& parameters, const Texts& texts) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    set_from_text(parameters[i], texts[i]);
  }
}

// What the planner's parameters would be.
Texts values_of(const PlannerPreset& preset, planning::Planner& fresh) {
  const std::vector<planning::Parameter> parameters = fresh.parameters();
  const Texts own = texts_of(parameters);
  try {
    for (const auto& [key, value] : preset.settings) {
      set_from_text(find_parameter(parameters, key), value);
    }
  } catch (const geometric::InputError&) {
    set_all(parameters, own);
    throw;
  }
  Texts values = texts_of(parameters);
  set_all(parameters, own);
  return values;
}

}  // namespace

std::vector<PlannerPreset> built_in_presets(const std::string& planner) {
  std::vector<PlannerPreset> presets{own_values(planner)};
  const auto add = [&](const QString& name, const QString& purpose, Settings settings) {
    presets.push_back({name, purpose, std::move(settings), true});
  };
  const QString as_found = QObject::tr("Takes the path as it is found, without shortening it.");
  const QString shortened =
      QObject::tr("Shortens the path for as long as that still helps: a shorter way, later.");
  const auto is_one_of = [&](std::initializer_list<const char*> names) {
    return std::ranges::find(names, planner) != names.end();
  };
  if (is_one_of({"auto", "pmd-rrt-connect", "rrt-connect", "pmd-lazy"})) {
    add(QObject::tr("Fast"), as_found, {{"smoothing_checks", "0"}});
  }
  if (is_one_of({"auto", "pmd-rrt-connect", "rrt-connect"})) {
    add(QObject::tr("Thorough"), shortened, {{"smoothing_checks", "5000"}});
  }
  if (is_one_of({"auto", "pmd-rrt-connect", "rrt-connect", "pmd-lazy"})) {
    add(QObject::tr("Shortest"),
        QObject::tr("Optimises for the shortest path, whatever the hand looks like."),
        {{"objective", "shortest"}, {"smoothing_checks", "2000"}});
    add(QObject::tr("Safest"), QObject::tr("Optimises for distance from obstacles."),
        {{"objective", "safest"}, {"smoothing_checks", "5000"}});
    add(QObject::tr("Fastest"),
        QObject::tr("Optimises for the time that the joints' velocity limits allow."),
        {{"objective", "fastest"}, {"smoothing_checks", "2000"}});
  }
  if (planner == "pmd-lazy") {
    add(QObject::tr("Thorough"),
        QObject::tr("Chooses the way among more nodes, and shortens it for as long as that helps."),
        {{"batch", "50"}, {"smoothing_checks", "5000"}});
  }
  if (planner == "pmd-rrt-connect") {
    add(QObject::tr("Tight places"),
        QObject::tr(
            "Short steps in poses of the tool, from where few were tried: for hands that have "
            "to leave or reach a narrow place. Needs an arm built like the TX90."),
        {{"corridor", "cartesian"}, {"range", "0.1"}, {"expansions", "1"}});
  }
  if (is_of_the_paper(planner)) {
    add(QObject::tr("As printed"),
        QObject::tr("The paper's values (Table 3) and its Algorithm 4 to the letter: ρₐ grows "
                    "without limit, and N is compared at the end of each pass; smoothing may go "
                    "back along the "
                    "path."),
        {{"rho_max", "0"},
         {"fill_gaps", "false"},
         {"n_checked", "pass"},
         {"smoothing", "both-ways"}});
  }
  if (planner == "pmd-prm") {
    add(QObject::tr("Fast"),
        QObject::tr("Begins with larger hypercubes: a first path sooner on most tasks, but farther "
                    "from the straight motion."),
        {{"rho_a", "0.01"}});
  }
  return presets;
}

void apply_preset(const PlannerPreset& preset, planning::Planner& fresh,
                  planning::Planner& planner) {
  set_all(planner.parameters(), values_of(preset, fresh));
}

bool has_values_of(const PlannerPreset& preset, planning::Planner& fresh,
                   planning::Planner& planner) {
  try {
    return values_of(preset, fresh) == texts_of(planner.parameters());
  } catch (const geometric::InputError&) {
    return false;
  }
}

}  // namespace handway::gui
