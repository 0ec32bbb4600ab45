#include "model/planning/plan_settings.h"

#include <algorithm>
#include <limits>
#include <thread>

namespace handway::gui {

PlanSettings::PlanSettings(const planning::PlannerRegistry& registry, QObject* parent)
    : QObject(parent), registry_(registry) {
  request_.seed = 1;
  request_.time_limit_s = 300.0;
  set_threads(0);
  set_usual_planner({});
  if (!usual_planner_.empty()) {
    planner_ = registry_.create(usual_planner_);
  }
}

std::vector<std::shared_ptr<planning::Planner>> PlanSettings::copies(int count) const {
  std::vector<std::shared_ptr<planning::Planner>> copies;
  for (int i = 0; i < count; ++i) {
    std::shared_ptr<planning::Planner> copy = registry_.create(planner_->name());
    for (const planning::Parameter& parameter : planner_->parameters()) {
      copy->set_parameter(parameter.key, planning::to_text(parameter));
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
  const std::vector<planning::Parameter> usual = fresh->parameters();
  for (const planning::Parameter& parameter : planner_->parameters()) {
    std::string value = planning::to_text(parameter);
    if (value != planning::to_text(planning::find_parameter(usual, parameter.key))) {
      choice.settings.emplace_back(parameter.key, std::move(value));
    }
  }
  return choice;
}

void PlanSettings::apply(const geometric::PlannerRequest& choice) {
  if (!planner_) {
    return;
  }
  use_planner(choice.name.empty() ? usual_planner_ : choice.name);
  for (const auto& [key, value] : choice.settings) {
    planner_->set_parameter(key, value);
  }
  emit planner_changed(true);
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

void PlanSettings::set_seed(std::uint64_t seed) { keep(request_.seed, seed); }

void PlanSettings::set_threads(int threads) {
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  keep(request_.threads, threads > 0 ? threads : static_cast<int>(processors));
}

void PlanSettings::set_time_limit(double seconds) {
  keep(request_.time_limit_s, seconds > 0.0 ? seconds : planning::PlanRequest{}.time_limit_s);
}

void PlanSettings::set_margin(double millimetres) { keep(request_.margin_mm, millimetres); }

void PlanSettings::restore(const planning::PlanRequest& request) {
  seeds_ = 1;
  request_.seed = request.seed;
  request_.time_limit_s = request.time_limit_s;
  request_.margin_mm = request.margin_mm;
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
    for (const planning::Parameter& usual : fresh->parameters()) {
      planner_->set_parameter(usual.key, planning::to_text(usual));
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

}  // namespace handway::gui
