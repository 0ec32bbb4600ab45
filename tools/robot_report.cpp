#include "robot_report.h"

#include "printing.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace handway::tools {

RobotReport robot_report(std::shared_ptr<const geometric::RobotModel> model,
                         geometric::GroupProposal groups, int samples, std::uint64_t seed) {
  RobotReport report{std::move(model), std::move(groups), {}, {}};
  report.sampled = sample_self_collisions(*report.model, samples, seed);
  report.findings = examine_robot(*report.model, report.sampled, report.groups);
  return report;
}

void print_findings(const RobotReport& report) {
  print_out("random postures that collide: {:.3g} % of {}\n",
            100.0 * report.sampled.colliding / report.sampled.samples, report.sampled.samples);
  for (const geometric::RobotFinding& finding : report.findings) {
    print_out("suspicious: {}\n  {}\n", finding.found, finding.mend);
  }
}

nlohmann::ordered_json findings_json(const RobotReport& report) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const geometric::RobotFinding& finding : report.findings) {
    list.push_back({{"found", finding.found}, {"mend", finding.mend}});
  }
  return list;
}

}  // namespace handway::tools
