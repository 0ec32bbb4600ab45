/// Campaigns (YAML).
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/planners/planner.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("campaign.yaml");
  static const planning::PlannerRegistry planners;
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(planning::read_campaign(file.hold(data, size), planners)); });
}
