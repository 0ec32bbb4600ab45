#include "handway/planning/queries/palm_ik.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway/geometric/robot/spherical_wrist_inverse_kinematics.h"

#include <algorithm>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

using geometric::NumericInverseKinematics;
using geometric::Pose;
using geometric::RobotModel;

constexpr std::size_t kPoseFreedoms = 6;
constexpr double kBend = 0.05;   // rad
constexpr double kBetter = 0.9;  // of the distance that is left, or it is not worth a jump

std::unique_ptr<geometric::InverseKinematics> closed_form(
    const std::shared_ptr<const RobotModel>& model, int palm, const std::vector<int>& arm) {
  try {
    auto ik = geometric::make_spherical_wrist_inverse_kinematics(model, model->link(palm).name);
    std::vector<int> sorted = arm;
    std::ranges::sort(sorted);
    return ik->variables() == sorted ? std::move(ik) : nullptr;
  } catch (const geometric::InputError&) {  // another kind of arm
    return nullptr;
  }
}

std::unique_ptr<NumericInverseKinematics> iterative(const std::shared_ptr<const RobotModel>& model,
                                                    int palm, const std::vector<int>& arm) {
  std::vector<std::string> joints;
  for (const int v : geometric::chain_variables(*model, palm)) {
    if (std::ranges::count(arm, v) > 0) {
      joints.push_back(model->variable(v).name);
    }
  }
  if (joints.empty()) {
    throw geometric::InputError({"inverse kinematics of " + model->name(),
                                 "link " + model->link(palm).name, "no arm joint that moves it",
                                 "at least one", ""});
  }
  geometric::NumericIkOptions options;
  options.position_only = joints.size() < kPoseFreedoms;
  options.position_tolerance = geometric::metres(0.1);
  options.orientation_tolerance = geometric::radians(0.01);
  options.max_restarts = 0;  // near to where it was, or not at all
  options.max_iterations = 60;
  return std::make_unique<NumericInverseKinematics>(model, model->link(palm).name, joints, options);
}

std::vector<int> ancestors(const RobotModel& model, int link) {
  std::vector<int> chain;
  for (link = model.parent(link); link >= 0; link = model.parent(link)) {
    chain.push_back(link);
  }
  return chain;
}

}  // namespace

PalmIk::PalmIk(std::shared_ptr<const RobotModel> model, int palm, const std::vector<int>& arm)
    : model_(std::move(model)),
      palm_(palm),
      closed_form_(closed_form(model_, palm, arm)),
      iterative_(iterative(model_, palm, arm)) {}

PalmIk::~PalmIk() = default;
PalmIk::PalmIk(PalmIk&&) noexcept = default;

Pose PalmIk::pose(const Configuration& q) const {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model_->link_count()));
  model_->forward_kinematics(q, X_BL);
  return X_BL[static_cast<std::size_t>(palm_)];
}

PalmMove PalmIk::moved(const Configuration& q, const Pose& X_BP) const {
  if (closed_form_) {
    const geometric::IkResult found = closed_form_->solve(X_BP, q);
    if (!found.solutions.empty()) {
      return {closed_form_->placed(found.solutions.front(), q), true};
    }
  }
  geometric::NumericIkResult found = iterative_->find(X_BP, q);
  for (const double bend : {kBend, -kBend}) {  // a stretched arm does not fold by itself
    if (found.converged) {
      break;
    }
    Configuration bent = q;
    for (const int v : iterative_->variables()) {
      bent[v] += bend;
    }
    bent = model_->clamped(std::move(bent));
    geometric::NumericIkResult other = iterative_->find(X_BP, bent);
    if (other.converged || other.position_residual < kBetter * found.position_residual) {
      found = std::move(other);
    }
  }
  return {found.q, found.converged};
}

std::vector<Configuration> PalmIk::all(const Configuration& q, const Pose& X_BP) const {
  const geometric::InverseKinematics& ik =
      closed_form_ ? *closed_form_ : static_cast<const geometric::InverseKinematics&>(*iterative_);
  std::vector<Configuration> postures;
  for (const geometric::IkSolution& solution : ik.solve(X_BP, q).solutions) {
    postures.push_back(ik.placed(solution, q));
  }
  return postures;
}

int palm_link(const RobotModel& model, const std::vector<int>& arm, const std::vector<int>& hand) {
  if (!hand.empty()) {
    std::vector<int> common = ancestors(model, model.variable_link(hand.front()));
    for (const int variable : hand) {
      const std::vector<int> chain = ancestors(model, model.variable_link(variable));
      std::erase_if(common, [&](int link) { return std::ranges::count(chain, link) == 0; });
    }
    if (!common.empty()) {
      return common.front();
    }
  }
  return arm.empty() ? model.link_count() - 1 : model.variable_link(arm.back());
}

}  // namespace handway::planning
