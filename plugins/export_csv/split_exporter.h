#pragma once

#include "handway/planning/core/exporter.h"

namespace handway::export_csv {

/// A CSV for each controller, NAME_arm.csv and NAME_hand.csv, with the same times: `time`
/// (s), the joints that move on their own (rad or m), then JOINT.velocity. The SAH's file
/// has its 13 independent joints: what drives a medial joint drives the distal one.
class SplitExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "split"; }
  [[nodiscard]] std::string description() const override {
    return "a timed CSV for the arm and one for the hand";
  }

 private:
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion) const override;
};

}  // namespace handway::export_csv
