#pragma once

#include "handway/planning/extensions/exporter.h"

namespace handway::export_csv {

/// One CSV of the whole robot, NAME.csv: `time` (s), every moving joint (rad or m), coupled ones
/// included, then JOINT.velocity and JOINT.acceleration of the independent joints, and `stage` if
/// the motion has stages. It is a path file too: see read_path().
class CsvExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "csv"; }
  [[nodiscard]] std::string description() const override {
    return "one timed CSV of hand and arm: positions, velocities, accelerations";
  }

 private:
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

/// A CSV for each controller, NAME_arm.csv and NAME_hand.csv, with the same times: `time` (s), the
/// independent joints (rad or m), then JOINT.velocity, and `stage` if the motion has stages. The
/// SAH's file has its 13 independent joints: the motor of a medial joint drives the distal one.
class SplitExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "split"; }
  [[nodiscard]] std::string description() const override {
    return "a timed CSV for the arm and one for the hand";
  }

 private:
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

}  // namespace handway::export_csv
