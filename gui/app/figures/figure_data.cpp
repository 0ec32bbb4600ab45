#include "app/figures/figure_data.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/robot_loader.h"
#include "handway/geometric/io/text_file.h"
#include "handway/sampling/postures/pmd_basis_io.h"

#include <charconv>
#include <cmath>
#include <sstream>

namespace handway::gui {
namespace {

using geometric::InputError;

constexpr std::size_t kLargestFile = std::size_t{1} << 30;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, ',');) {
    parts.push_back(part);
  }
  return parts;
}

double number(const std::string& cell, const std::string& where) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
    throw InputError({where, "", "\"" + cell + "\"", "a finite number", ""});
  }
  return value;
}

// The rows of a CSV file whose header is `names`.
Eigen::MatrixXd read_table(const std::filesystem::path& file,
                           const std::vector<std::string>& names) {
  std::istringstream in(geometric::read_text_file(file, "a table of numbers", kLargestFile));
  std::string line;
  std::getline(in, line);
  if (cells(line) != names) {
    throw InputError({file.string() + ":1", "", "another header", "the joints of the basis", ""});
  }
  std::vector<double> values;
  Eigen::Index rows = 0;
  for (; std::getline(in, line); ++rows) {
    const std::string where = file.string() + ':' + std::to_string(rows + 2);
    const std::vector<std::string> row = cells(line);
    if (row.size() != names.size()) {
      throw InputError({where, "", std::to_string(row.size()) + " values",
                        std::to_string(names.size()) + " as in the header", ""});
    }
    for (const std::string& cell : row) {
      values.push_back(number(cell, where));
    }
  }
  if (rows == 0) {
    throw InputError({file.string(), "", "no rows", "at least one", ""});
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), rows, static_cast<Eigen::Index>(names.size()));
}

}  // namespace

geometric::Configuration FigureData::configuration(const Eigen::VectorXd& posture) const {
  geometric::Configuration q = hand->neutral();
  for (std::size_t j = 0; j < basis.joints.size(); ++j) {
    const int variable = hand->find_variable(basis.joints[j]).value();
    q[variable] = std::lerp(hand->lower()[variable], hand->upper()[variable],
                            posture[static_cast<Eigen::Index>(j)]);
  }
  return q;
}

FigureData read_figure_data(const std::filesystem::path& folder) {
  FigureData data;
  const std::filesystem::path basis = folder / "basis.yaml";
  data.basis = sampling::read_pmd_basis(basis);
  data.hand = geometric::load_robot(geometric::find_resource(
      geometric::ResourceKind::kRobot, data.basis.hand, folder, basis.string()));
  for (const std::string& joint : data.basis.joints) {
    if (!data.hand->find_variable(joint)) {
      throw InputError({basis.string(), "joints", "joint \"" + joint + '"',
                        "joints of " + data.hand->name(), ""});
    }
  }
  data.postures = read_table(folder / "postures.csv", data.basis.joints);
  data.shares = read_table(folder / "variance.csv", {"share"}).col(0);
  return data;
}

}  // namespace handway::gui
