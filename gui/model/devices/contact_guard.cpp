#include "model/devices/contact_guard.h"

#include <utility>

namespace handway::gui {

using geometric::NamedPosture;

ContactGuard::ContactGuard(QObject* parent) : QObject(parent) {
  connect(&checker_, &StepChecker::checked, this, &ContactGuard::take);
  connect(&checker_, &StepChecker::failed, this, &ContactGuard::tell);
}

void ContactGuard::set_robot(std::shared_ptr<const geometric::RobotModel> model,
                             std::vector<std::vector<int>> groups,
                             std::shared_ptr<const PreparedProblem> problem) {
  model_ = std::move(model);
  q_ = model_ ? model_->neutral() : geometric::Configuration();
  wanted_ = {};
  has_problem_ = problem != nullptr;
  checker_.set_problem(std::move(problem), std::move(groups));
  tell({});
}

void ContactGuard::set_rule(ContactRule rule) {
  rule_ = rule;
  if (rule == ContactRule::kPass) {
    tell({});
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
  if (rule_ == ContactRule::kPass || !has_problem_) {
    emit passed(posture);
    return;
  }
  geometric::Configuration to = q_;
  for (const auto& [joint, value] : wanted().values) {
    if (const auto variable = model_->find_variable(joint)) {
      to[*variable] = value;
    }
  }
  checker_.check({q_, to, rule_});
}

void ContactGuard::withdraw(Leader leader) {
  wanted_.at(static_cast<std::size_t>(leader)).values.clear();
  if (wanted().values.empty()) {
    tell({});
  }
}

void ContactGuard::take(const StepReport& report) {
  NamedPosture posture = wanted();
  if (rule_ == ContactRule::kPass || posture.values.empty()) {
    return;
  }
  const auto text = [](const geometric::NamedPair& contact) {
    const QString a = QString::fromStdString(contact.a);
    return contact.b.empty() ? tr("At the limit of constraint %1").arg(a)
                             : tr("%1 touches %2").arg(a, QString::fromStdString(contact.b));
  };
  tell(report.contact ? text(*report.contact) : QString());
  for (auto& [joint, value] : posture.values) {
    if (const auto variable = model_->find_variable(joint)) {
      value = report.q[*variable];
    }
  }
  emit passed(posture);
}

void ContactGuard::tell(const QString& contact) {
  if (holds_ || !contact.isEmpty()) {
    holds_ = !contact.isEmpty();
    emit held(contact);
  }
}

}  // namespace handway::gui
