#include "model/planning/plan_settings.h"

#include "model/document/edit.h"

#include <algorithm>
#include <limits>
#include <thread>
#include <utility>

namespace handway::gui {
namespace {

constexpr std::uint64_t kFirstSeed = 1;

bool is_set_alike(planning::Planner& a, planning::Planner& b) {
  const auto text = [](const geometric::Parameter& parameter) {
    return geometric::to_text(parameter);
  };
  return a.name() == b.name() && std::ranges::equal(a.parameters(), b.parameters(), {}, text, text);
}

}  // namespace

PlanSettings::PlanSettings(const planning::PlannerRegistry& registry, QObject* parent)
    : QObject(parent), registry_(registry) {
  request_.seed = kFirstSeed;
  set_usual_threads(usual_threads_);
  set_usual_time_limit(usual_time_limit_);
  set_usual_planner({});
  if (!usual_planner_.empty()) {
    planner_ = registry_.create(usual_planner_);
  }
}

std::vector<std::shared_ptr<planning::Planner>> PlanSettings::copies(int count) const {
  std::vector<std::shared_ptr<planning::Planner>> copies;
  for (int i = 0; i < count; ++i) {
    std::shared_ptr<planning::Planner> copy = registry_.create(planner_->name());
    for (const geometric::Parameter& parameter : planner_->parameters()) {
      copy->set_parameter(parameter.key, geometric::to_text(parameter));
    }
    copies.push_back(std::move(copy));
  }
  return copies;
}

geometric::PlannerRequest PlanSettings::choice() const {
  geometric::PlannerRequest choice;
  if (!planner_) {
    return choice;
  }
  choice.name = planner_->name();
  const std::unique_ptr<planning::Planner> fresh = registry_.create(choice.name);
  const std::vector<geometric::Parameter> usual = fresh->parameters();
  for (const geometric::Parameter& parameter : planner_->parameters()) {
    std::string value = geometric::to_text(parameter);
    if (value != geometric::to_text(geometric::find_parameter(usual, parameter.key))) {
      choice.settings.emplace_back(parameter.key, std::move(value));
    }
  }
  return choice;
}

void PlanSettings::apply(const geometric::PlannerRequest& choice) {
  if (!planner_) {
    return;
  }
  std::shared_ptr<planning::Planner> chosen =
      registry_.create(choice.name.empty() ? usual_planner_ : choice.name);
  for (const auto& [key, value] : choice.settings) {
    chosen->set_parameter(key, value);
  }
  if (!is_set_alike(*planner_, *chosen)) {
    planner_ = std::move(chosen);
    emit planner_changed(true);
  }
}

void PlanSettings::use_planner(const std::string& name) {
  planner_ = registry_.create(name);
  emit planner_changed(true);
}

void PlanSettings::choose_planner(const std::string& name) {
  if (!planner_ || planner_->name() != planning::PlannerRegistry::current_name(name)) {
    use_planner(name);
  }
}

void PlanSettings::set_parameter(const std::string& key, const std::string& value) {
  if (planner_) {
    planner_->set_parameter(key, value);
    emit planner_changed(false);
  }
}

void PlanSettings::set_usual_planner(const std::string& name) {
  const std::vector<std::string> names = registry_.names();
  const std::string current(planning::PlannerRegistry::current_name(name));
  const bool known = std::ranges::find(names, current) != names.end();
  usual_planner_ = known ? current : names.empty() ? std::string() : names.front();
}

void PlanSettings::set_usual_threads(int threads) {
  usual_threads_ = threads;
  set_threads(threads);
}

void PlanSettings::set_usual_time_limit(double seconds) {
  usual_time_limit_ = seconds;
  set_time_limit(seconds);
}

void PlanSettings::begin_scene() {
  request_.seed = kFirstSeed;
  request_.margin = planning::PlanRequest{}.margin;
  seeds_ = 1;
  merit_ = kPathMerits.front();
  optimize_limit_ = kUsualOptimizeLimit;
  set_usual_threads(usual_threads_);
  set_usual_time_limit(usual_time_limit_);
  emit request_changed();
}

void PlanSettings::set_seed(std::uint64_t seed) { keep(request_.seed, seed); }

void PlanSettings::set_threads(int threads) {
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  keep(request_.threads, threads > 0 ? threads : static_cast<int>(processors));
}

void PlanSettings::set_time_limit(double seconds) {
  keep(request_.time_limit_s, seconds > 0.0 ? seconds : planning::PlanRequest{}.time_limit_s);
}

void PlanSettings::set_margin(double metres) { keep(request_.margin, metres); }

void PlanSettings::restore(const planning::PlanRequest& request) {
  seeds_ = 1;
  request_.seed = request.seed;
  request_.time_limit_s = request.time_limit_s;
  request_.margin = request.margin;
  emit request_changed();
}

void PlanSettings::set_seeds(int seeds) { keep(seeds_, seeds); }

void PlanSettings::set_merit(PathMerit merit) { keep(merit_, merit); }

void PlanSettings::set_optimize_limit(double seconds) {
  keep(optimize_limit_, seconds > 0.0 ? seconds : std::numeric_limits<double>::infinity());
}

PlanChoices PlanSettings::choices() const {
  return {choice(), request_, seeds_, merit_, optimize_limit_};
}

void PlanSettings::put_back(const PlanChoices& choices) {
  const geometric::PlannerRequest now = choice();
  if (choices.planner.name != now.name) {
    apply(choices.planner);
  } else if (choices.planner.settings != now.settings) {
    const std::unique_ptr<planning::Planner> fresh = registry_.create(now.name);
    for (const geometric::Parameter& usual : fresh->parameters()) {
      planner_->set_parameter(usual.key, geometric::to_text(usual));
    }
    for (const auto& [key, value] : choices.planner.settings) {
      planner_->set_parameter(key, value);
    }
    emit planner_changed(false);
  }
  request_ = choices.request;
  seeds_ = choices.seeds;
  merit_ = choices.merit;
  optimize_limit_ = choices.optimize_limit;
  emit request_changed();
}

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

// Returns the difference in a few words; empty if there is none.
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
  if (a.request.margin != b.request.margin) {
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
