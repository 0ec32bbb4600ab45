#include "model/planning/preset_store.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/planning/planners/planner.h"

#include <QFileInfo>
#include <QObject>
#include <QSettings>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <utility>

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

Texts texts_of(const std::vector<geometric::Parameter>& parameters) {
  Texts texts;
  texts.reserve(parameters.size());
  for (const geometric::Parameter& parameter : parameters) {
    texts.push_back(geometric::to_text(parameter));
  }
  return texts;
}

// Settings by which the planner differs from its defaults under a preset of its own.
Settings settings_of(const std::string& name, std::string_view preset) {
  const std::unique_ptr<planning::Planner> planner = planning::PlannerRegistry().create(name);
  const std::vector<geometric::Parameter> usual = planner->parameters();
  planner->set_parameter(planning::kPresetKey, preset);
  Settings settings;
  for (const geometric::Parameter& parameter : planner->parameters()) {
    std::string value = to_text(parameter);
    if (value != to_text(geometric::find_parameter(usual, parameter.key))) {
      settings.emplace_back(parameter.key, std::move(value));
    }
  }
  return settings;
}

// Returns the values of the planner's parameters under the preset.
std::vector<geometric::Parameter> values_of(const PlannerPreset& preset, planning::Planner& fresh) {
  std::vector<geometric::Parameter> parameters = fresh.parameters();
  for (const auto& [key, value] : preset.settings) {
    set_from_text(geometric::find_parameter(parameters, key), value);
  }
  return parameters;
}

}  // namespace

std::vector<PlannerPreset> built_in_presets(const std::string& planner) {
  std::vector<PlannerPreset> presets{own_values(planner)};
  const auto add = [&](const QString& name, const QString& purpose, Settings settings) {
    presets.push_back({name, purpose, std::move(settings), true});
  };
  const QString as_found = QObject::tr("Keeps the path as it was found, without shortening it.");
  const QString shortened =
      QObject::tr("Shortens the path until it converges: shorter paths, but longer planning.");
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
        QObject::tr("Optimises for the shortest path, without human-likeness."),
        {{"objective", "shortest"}, {"smoothing_checks", "2000"}});
    add(QObject::tr("Safest"), QObject::tr("Optimises for distance from obstacles."),
        {{"objective", "safest"}, {"smoothing_checks", "5000"}});
    add(QObject::tr("Fastest"),
        QObject::tr("Optimises for the shortest duration under the joints' velocity limits."),
        {{"objective", "fastest"}, {"smoothing_checks", "2000"}});
  }
  if (planner == "pmd-lazy") {
    add(QObject::tr("Thorough"),
        QObject::tr("Chooses the path among more nodes, and shortens it until it converges."),
        {{"batch", "50"}, {"smoothing_checks", "5000"}});
  }
  if (planner == "pmd-rrt-connect") {
    add(QObject::tr("Narrow passages"),
        QObject::tr(
            "Short steps in poses of the tool, from nodes with few attempts. For hands that have "
            "to leave or enter a narrow place. Needs an arm of six or more joints."),
        {{"corridor", "cartesian"}, {"range", "0.1"}, {"expansions", "1"}});
  }
  if (is_of_the_paper(planner)) {
    add(QObject::tr("As in the paper"),
        QObject::tr(
            "The paper's values (Table 3) and exactly its Algorithm 4: ρₐ grows without limit, N "
            "is compared at the end of each pass, and smoothing may go back along the path."),
        settings_of(planner, "print"));
    add(QObject::tr("As the authors' program"),
        QObject::tr("What the authors' program does otherwise than their paper: ρₐ grows by equal "
                    "steps, in poses of the tool, with ten samples at the goal."),
        settings_of(planner, "authors"));
  }
  if (planner == "pmd-prm") {
    add(QObject::tr("Fast"),
        QObject::tr("Starts with larger hypercubes: finds most paths sooner, but farther from the "
                    "straight motion."),
        {{"rho_a", "0.01"}});
  }
  return presets;
}

void apply_preset(const PlannerPreset& preset, planning::Planner& fresh,
                  planning::Planner& planner) {
  for (const geometric::Parameter& parameter : values_of(preset, fresh)) {
    planner.set_parameter(parameter.key, to_text(parameter));
  }
}

bool has_values_of(const PlannerPreset& preset, planning::Planner& fresh,
                   planning::Planner& planner) {
  try {
    return texts_of(values_of(preset, fresh)) == texts_of(planner.parameters());
  } catch (const geometric::InputError&) {
    return false;
  }
}

namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using geometric::YamlElement;

constexpr const char* kVersion = "1";

PlannerPreset read_preset(const YamlElement& item) {
  item.allow_keys({"planner", "name", "parameters"});
  PlannerPreset preset;
  preset.name = QString::fromStdString(item.need("name").text());
  if (const auto parameters = item.find("parameters")) {
    for (const auto& [key, value] : parameters->entries()) {
      preset.settings.emplace_back(key, value.text());
    }
  }
  return preset;
}

void write_preset(YAML::Emitter& out, const std::string& planner, const PlannerPreset& preset) {
  out << YAML::BeginMap << YAML::Key << "planner" << YAML::Value << planner << YAML::Key << "name"
      << YAML::Value << YAML::DoubleQuoted << preset.name.toStdString();
  if (!preset.settings.empty()) {
    out << YAML::Key << "parameters" << YAML::Value << YAML::BeginMap;
    for (const auto& [key, value] : preset.settings) {
      out << YAML::Key << key << YAML::Value << YAML::DoubleQuoted << value;
    }
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
}

// A name for the file that can't be read, unlike all others.
fs::path put_aside(const fs::path& file) {
  for (int i = 1;; ++i) {
    fs::path aside = file;
    aside += i == 1 ? ".unreadable" : fmt::format(".unreadable-{}", i);
    if (!fs::exists(aside)) {
      fs::rename(file, aside);
      return aside;
    }
  }
}

}  // namespace

PresetStore::PresetStore(QObject* parent) : QObject(parent) { read(); }

fs::path PresetStore::file() {
  return fs::path(QFileInfo(QSettings().fileName()).absolutePath().toStdString()) / "presets.yaml";
}

PresetStore::Entries PresetStore::read_entries() {
  Entries entries;
  std::error_code missing;
  if (!fs::exists(file(), missing)) {
    return entries;
  }
  const YamlElement top = YamlElement::read(file(), "a file of presets");
  top.allow_keys({"handway_presets", "presets"});
  const YamlElement version = top.need("handway_presets");
  if (version.text() != kVersion) {
    version.refuse(version.found(), kVersion, "It is of another version of the program");
  }
  if (const auto list = top.find("presets")) {
    for (const YamlElement& item : list->items()) {
      const std::string planner = item.need("planner").text();
      entries.push_back(
          {std::string(planning::PlannerRegistry::current_name(planner)), read_preset(item)});
    }
  }
  return entries;
}

void PresetStore::read() {
  fault_.clear();
  try {
    entries_ = read_entries();
  } catch (const InputError& error) {
    fault_ = QString::fromUtf8(error.what());
  }
}

std::vector<PlannerPreset> PresetStore::of(const std::string& planner) const {
  std::vector<PlannerPreset> presets = built_in_presets(planner);
  const auto own = static_cast<std::ptrdiff_t>(presets.size());
  for (const Entry& entry : entries_) {
    if (entry.planner == planner) {
      presets.push_back(entry.preset);
    }
  }
  std::sort(presets.begin() + own, presets.end(), [](const auto& a, const auto& b) {
    return QString::localeAwareCompare(a.name, b.name) < 0;
  });
  return presets;
}

void PresetStore::refuse_name(const std::string& planner, const QString& name) {
  const auto presets = built_in_presets(planner);
  if (name.trimmed().isEmpty() || std::ranges::count(presets, name, &PlannerPreset::name) > 0) {
    throw InputError({"preset", "name", "\"" + name.toStdString() + "\"",
                      "a name that is not one of the program's own presets",
                      "Choose another name"});
  }
}

void PresetStore::change(const std::function<void(Entries&)>& edit) {
  Entries entries = entries_;
  try {
    entries = read_entries();
  } catch (const InputError&) {
    try {
      put_aside(file());
    } catch (const fs::filesystem_error& error) {
      throw InputError({file().string(), "", "a file that can't be put aside", "one that can",
                        error.code().message()});
    }
  }
  edit(entries);
  YAML::Emitter out;
  out << YAML::BeginMap << YAML::Key << "handway_presets" << YAML::Value << kVersion << YAML::Key
      << "presets" << YAML::Value << YAML::BeginSeq;
  for (const Entry& entry : entries) {
    write_preset(out, entry.planner, entry.preset);
  }
  out << YAML::EndSeq << YAML::EndMap;
  std::error_code warned_when_writing;
  fs::create_directories(file().parent_path(), warned_when_writing);
  geometric::replace_file(file(), std::string(out.c_str()) + '\n');
  entries_ = std::move(entries);
  fault_.clear();
  emit changed();
}

void PresetStore::save(const std::string& planner, const PlannerPreset& preset) {
  refuse_name(planner, preset.name);
  change([&](Entries& entries) {
    std::erase_if(entries, [&](const Entry& entry) {
      return entry.planner == planner && entry.preset.name == preset.name;
    });
    entries.push_back({planner, preset});
  });
}

void PresetStore::rename(const std::string& planner, const QString& name, const QString& new_name) {
  refuse_name(planner, new_name);
  change([&](Entries& entries) {
    const auto find = [&](const QString& wanted) {
      return std::ranges::find_if(entries, [&](const Entry& entry) {
        return entry.planner == planner && entry.preset.name == wanted;
      });
    };
    if (find(new_name) != entries.end() && new_name != name) {
      throw InputError({"preset", "name", "\"" + new_name.toStdString() + "\"",
                        "a name that no other preset has", "Choose another name"});
    }
    if (const auto found = find(name); found != entries.end()) {
      found->preset.name = new_name;
    }
  });
}

void PresetStore::remove(const std::string& planner, const QString& name) {
  change([&](Entries& entries) {
    std::erase_if(entries, [&](const Entry& entry) {
      return entry.planner == planner && entry.preset.name == name;
    });
  });
}

}  // namespace handway::gui
