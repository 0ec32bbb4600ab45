#include "model/planning/settings_history.h"

#include "model/document/edit.h"

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

// "range", if that is all that differs; else "".
std::string only_key(const PlanChoices& a, const PlanChoices& b) {
  std::vector<std::string> keys;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const auto& setting : one->planner.settings) {
      if (std::ranges::count(other->planner.settings, setting) == 0 &&
          std::ranges::count(keys, setting.first) == 0) {
        keys.push_back(setting.first);
      }
    }
  }
  return keys.size() == 1 ? keys.front() : std::string();
}

// What is different, in a few words; empty: nothing.
QString difference(const PlanChoices& a, const PlanChoices& b) {
  const auto word = [](const std::string& text) { return QString::fromStdString(text); };
  if (a.planner.name != b.planner.name) {
    return QObject::tr("Plan with %1").arg(word(b.planner.name));
  }
  if (a.planner.settings != b.planner.settings) {
    const std::string key = only_key(a, b);
    return key.empty() ? QObject::tr("Set parameters of %1").arg(word(b.planner.name))
                       : QObject::tr("Set %1 of %2").arg(word(key), word(b.planner.name));
  }
  if (a.request.seed != b.request.seed) {
    return QObject::tr("Set seed");
  }
  if (a.seeds != b.seeds) {
    return QObject::tr("Set number of seeds");
  }
  if (a.merit != b.merit) {
    return QObject::tr("Set which path is best");
  }
  if (a.request.time_limit_s != b.request.time_limit_s) {
    return QObject::tr("Set time limit");
  }
  if (a.request.margin_mm != b.request.margin_mm) {
    return QObject::tr("Set margin");
  }
  if (a.request.threads != b.request.threads) {
    return QObject::tr("Set threads");
  }
  return a.optimize_limit != b.optimize_limit ? QObject::tr("Set time to optimise for") : QString();
}

}  // namespace

SettingsHistory::SettingsHistory(PlanSettings& settings, SceneEditor& editor, QObject* parent)
    : QObject(parent), settings_(settings), editor_(editor), before_(settings.choices()) {
  soon_.setSingleShot(true);
  soon_.setInterval(0);
  connect(&soon_, &QTimer::timeout, this, &SettingsHistory::note_change);
  for (const auto signal : {&PlanSettings::parameters_changed, &PlanSettings::request_changed}) {
    connect(&settings_, signal, &soon_, qOverload<>(&QTimer::start));
  }
  connect(&settings_, &PlanSettings::planner_changed, &soon_, qOverload<>(&QTimer::start));
}

void SettingsHistory::begin() {
  soon_.stop();
  before_ = settings_.choices();
}

void SettingsHistory::note_change() {
  const PlanChoices now = settings_.choices();
  const QString text = difference(before_, now);
  if (!text.isEmpty()) {
    editor_.undo_stack().push(new ValueEdit<PlanChoices>(
        text, text.toStdString(), false, before_, now, [this](const PlanChoices& choices) {
          before_ = choices;  // which makes it no change by a person
          settings_.put_back(choices);
        }));
  }
}

}  // namespace handway::gui
