#include "model/devices/contact_guard.h"

#include "handway/geometric/collision/continuous/sliding_step.h"
#include "handway/geometric/robot/composed_robot.h"

#include <utility>

namespace handway::gui {
using geometric::CollisionChecker;
using geometric::FreeStep;
using geometric::NamedPosture;

ContactGuard::ContactGuard(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, &ContactGuard::notify);
}

void ContactGuard::set_robot(std::shared_ptr<const geometric::RobotModel> model,
                             std::vector<geometric::JointIndices> groups,
                             std::shared_ptr<const PreparedProblem> problem) {
  model_ = std::move(model);
  q_ = model_ ? model_->neutral() : geometric::Configuration();
  wanted_ = {};
  job_.cancel();
  groups_ = std::move(groups);
  checker_ = problem ? std::make_shared<OwnChecker>(std::move(problem)) : nullptr;
  notify({});
}

void ContactGuard::set_rule(ContactRule rule) {
  rule_ = rule;
  if (rule == ContactRule::kPass) {
    notify({});
  }
}

NamedPosture ContactGuard::wanted() const {
  NamedPosture all;
  for (const NamedPosture& posture : wanted_) {
    all.values.insert(posture.values.begin(), posture.values.end());
  }
  return all;
}

void ContactGuard::propose(Leader leader, const NamedPosture& posture) {
  if (!model_) {
    return;
  }
  wanted_.at(static_cast<std::size_t>(leader)) = posture;
  if (rule_ == ContactRule::kPass || !checker_) {
    emit passed(posture);
    return;
  }
  geometric::Configuration to = q_;
  for (const auto& [joint, value] : wanted().values) {
    if (const auto variable = geometric::find_variable_of_part(*model_, joint)) {
      to[*variable] = value;
    }
  }
  job_.run_next(
      [this, checker = checker_, groups = groups_, from = q_, to,
       slides = rule_ == ContactRule::kSlide](const std::stop_token& stop) -> LatestJob::Answer {
        CollisionChecker* own = checker->wait(stop);
        if (!own) {
          return {};
        }
        const FreeStep free =
            slides ? sliding_step(*own, from, to, groups) : straight_step(*own, from, to);
        if (!free.pair) {
          return [this, to] { take(to, std::nullopt); };
        }
        return [this, q = slides ? free.q : from,
                contact = named_pair(own->world(), *free.pair, 0.0)] { take(q, contact); };
      });
}

void ContactGuard::withdraw(Leader leader) {
  wanted_.at(static_cast<std::size_t>(leader)).values.clear();
  if (wanted().values.empty()) {
    notify({});
  }
}

void ContactGuard::take(const geometric::Configuration& q,
                        const std::optional<geometric::NamedPair>& contact) {
  NamedPosture posture = wanted();
  if (rule_ == ContactRule::kPass || posture.values.empty()) {
    return;
  }
  QString text;
  if (contact) {
    const QString a = QString::fromStdString(contact->a);
    text = contact->b.empty() ? tr("At the limit of constraint %1").arg(a)
                              : tr("%1 touches %2").arg(a, QString::fromStdString(contact->b));
  }
  notify(text);
  for (auto& [joint, value] : posture.values) {
    if (const auto variable = geometric::find_variable_of_part(*model_, joint)) {
      value = q[*variable];
    }
  }
  emit passed(posture);
}

void ContactGuard::notify(const QString& contact) {
  if (holds_ || !contact.isEmpty()) {
    holds_ = !contact.isEmpty();
    emit held(contact);
  }
}

}  // namespace handway::gui
