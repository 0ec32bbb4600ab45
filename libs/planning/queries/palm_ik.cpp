#include "handway/planning/queries/palm_ik.h"

#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/arm_inverse_kinematics.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace handway::planning {
namespace {

using geometric::Pose;
using geometric::RobotModel;

constexpr std::ptrdiff_t kPoseFreedoms = 6;
constexpr double kBend = 0.05;    // rad
constexpr int kMostPostures = 4;  // of an arm without closed form
constexpr double kBetter = 0.9;   // of the distance that is left, or it is not worth a jump

// Near to where it was, or not at all.
geometric::NumericIkOptions from_the_reference(const RobotModel& model, int palm,
                                               const std::vector<int>& arm) {
  const std::vector<int> chain = geometric::chain_variables(model, palm);
  const auto moving =
      std::ranges::count_if(chain, [&](int v) { return std::ranges::count(arm, v) > 0; });
  geometric::NumericIkOptions options;
  options.position_only = moving < kPoseFreedoms;
  options.position_tolerance = geometric::metres(0.1);
  options.orientation_tolerance = geometric::radians(0.01);
  options.max_restarts = 0;
  options.max_iterations = 60;
  return options;
}

// Several postures, from some other starts.
geometric::NumericIkOptions from_anywhere(geometric::NumericIkOptions options) {
  options.max_restarts = 8;
  return options;
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
      arm_(arm),
      closed_form_(geometric::closed_form_inverse_kinematics(model_, palm, arm)),
      iterative_(geometric::iterative_inverse_kinematics(model_, palm, arm,
                                                         from_the_reference(*model_, palm, arm))),
      searching_(geometric::iterative_inverse_kinematics(model_, palm, arm,
                                                         from_anywhere(iterative_->options()))) {}

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
  if (!closed_form_) {
    return geometric::reach_ball(*model_, palm_, arm_, q).contains(X_BP.translation())
               ? searching_->find_several(X_BP, q, kMostPostures)
               : std::vector<Configuration>();
  }
  std::vector<Configuration> postures;
  for (const geometric::IkSolution& solution : closed_form_->solve(X_BP, q).solutions) {
    postures.push_back(closed_form_->placed(solution, q));
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
