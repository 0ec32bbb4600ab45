#include "basis_plots.h"

#include "figures_program.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/sampling/postures/pmd_basis_io.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <string>
#include <system_error>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

std::string table_text(const std::vector<std::string>& header, const Eigen::MatrixXd& rows) {
  std::string text = fmt::format("{}\n", fmt::join(header, ","));
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    for (Eigen::Index column = 0; column < rows.cols(); ++column) {
      fmt::format_to(std::back_inserter(text), "{}{}", column > 0 ? "," : "", rows(row, column));
    }
    text += '\n';
  }
  return text;
}

}  // namespace

void write_basis_plots(const fs::path& folder, const sampling::PmdBasis& basis,
                       const Eigen::MatrixXd& postures, const Eigen::VectorXd& shares) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError({folder.string(), "", error.message(), "a folder for figures", ""});
  }
  geometric::replace_file(folder / "postures.csv", table_text(basis.joints, postures));
  geometric::replace_file(folder / "variance.csv", table_text({"share"}, shares));
  sampling::write_pmd_basis(basis, folder / "basis.yaml");
  draw_figures(folder);
}

}  // namespace handway::tools
