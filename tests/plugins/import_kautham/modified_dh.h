#pragma once

#include <Eigen/Geometry>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// A second, independent reading of `.rob` files, in their own units: forward
/// kinematics and controls by the formulas, without the library's help.
namespace handway::test {

class ModifiedDhRobot {
 public:
  explicit ModifiedDhRobot(const std::filesystem::path& file);

  struct Row {
    std::string name;
    std::string parent;
    double alpha, a, theta, d;  // degrees, mm
    double low, high;           // degrees
    Eigen::Isometry3d before;   // PreTrans, mm
  };
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

  /// Pose of each link in the base, mm. @param q rad by joint name; absent: 0.
  [[nodiscard]] std::map<std::string, Eigen::Isometry3d> poses(
      const std::map<std::string, double>& q) const;

  /// rad by joint name, for controls in [0, 1].
  [[nodiscard]] std::map<std::string, double> values(const std::vector<double>& controls) const;

 private:
  std::vector<Row> rows_;
  std::map<std::string, double> offset_;
  std::vector<std::map<std::string, double>> controls_;  // eigValue * value
};

}  // namespace handway::test
