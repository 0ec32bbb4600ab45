#include "handway/planning/paths/anytime_optimizer.h"

#include "handway/sampling/sequences/random_stream.h"
#include "paths/cheaper_path_search.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

constexpr std::array<double, 4> kShares = {1.5, 1.2, 1.05, 0.99};  // of the cost: bounds in turn
constexpr std::uint64_t kFirstSearch = 2000;  // checks of the first searches; …
constexpr std::uint64_t kMostDoublings = 7;   // … they double with each turn, so often
constexpr std::uint64_t kTrial = 2000;        // checks to optimise another route
constexpr double kCloseEnough = 1e-3;         // share of the least cost
constexpr int kMostSteps = 1000;              // of a round: most samples may cost too much

}  // namespace

AnytimeOptimizer::AnytimeOptimizer(PlanningContext& context, const ObjectiveWeights& weights,
                                   const Path& path, std::uint64_t seed)
    : context_(context),
      weights_(weights),
      seed_(seed),
      least_cost_(Objective(context.problem(), weights)
                      .least_cost(path.waypoints.front(), path.waypoints.back())),
      local_(std::make_unique<PathOptimizer>(context, weights, path, seed,
                                             PathOptimizer::kThorough)) {}

AnytimeOptimizer::~AnytimeOptimizer() = default;

Path AnytimeOptimizer::path() const { return local_->path(); }

double AnytimeOptimizer::cost() const { return local_->cost(); }

bool AnytimeOptimizer::converged() const {
  return cost() <= (1.0 + kCloseEnough) * least_cost_ ||
         (local_->converged() && (!searches_other_routes() || fruitless_ >= patience_));
}

// The searches don't project onto constraints.
bool AnytimeOptimizer::searches_other_routes() const {
  return context_.problem().checker->world().constraints().empty() &&
         !context_.problem().planned_joints().empty();
}

void AnytimeOptimizer::advance_round() {
  if (local_->converged()) {
    search_other_routes();
  } else {
    local_->advance(kRound);
  }
}

void AnytimeOptimizer::search_other_routes() {
  if (!search_) {
    begin_search();
  }
  fruitless_ += kRound;
  const std::uint64_t before = search_->spent();
  const std::uint64_t turn = (searches_ - cheapest_at_ - 1) / kShares.size();
  const std::uint64_t most = kFirstSearch << std::min(turn, kMostDoublings);
  std::optional<Path> route;
  for (int step = 0; step < kMostSteps && !route && search_->spent() - before < kRound; ++step) {
    if (context_.interruption()) {
      return;
    }
    route = search_->step();
  }
  const bool is_idle = search_->spent() == before;
  if (route) {
    improve_by(*route);
  }
  if (route || is_idle || search_->spent() >= most) {
    search_.reset();
  }
}

void AnytimeOptimizer::begin_search() {
  const double share = kShares.at((searches_ - cheapest_at_) % kShares.size());
  ++searches_;
  search_ = std::make_unique<CheaperPathSearch>(
      context_, weights_, path(), share, sampling::RandomStream(seed_).fork(searches_).seed());
}

// Takes the route, optimised, if it is then the cheapest path.
void AnytimeOptimizer::improve_by(const Path& route) {
  auto other = std::make_unique<PathOptimizer>(
      context_, weights_, route, sampling::RandomStream(seed_).fork(searches_).fork(1).seed(),
      PathOptimizer::kThorough);
  other->advance(kTrial);
  if (other->cost() < cost()) {
    local_ = std::move(other);
    cheapest_at_ = searches_;
    fruitless_ = 0;
  }
}

}  // namespace handway::planning
