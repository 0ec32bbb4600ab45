#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "recordings/array_recording.h"
#include "recordings/matlab_file.h"
#include "recordings/recording_formats.h"
#include "recordings/table_layout.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace handway::device {
namespace {

bool is_of_glove(Eigen::Index columns) { return columns == 18 || columns == kGloveSensors; }

/// The matrices that may come from a glove, by name, with its sensors as columns. If there are
/// several, those with the names of Ninapro's files: "angles", which are calibrated, before
/// "glove".
std::map<std::string, Eigen::MatrixXd> glove_matrices(
    const std::map<std::string, Eigen::MatrixXd>& all) {
  std::map<std::string, Eigen::MatrixXd> fitting;
  for (const auto& [name, matrix] : all) {
    if (matrix.rows() > 1 && is_of_glove(matrix.cols())) {
      fitting[name] = matrix;
    } else if (is_of_glove(matrix.rows()) && matrix.cols() > kGloveSensors) {
      fitting[name] = matrix.transpose();
    }
  }
  for (const char* known : {"angles", "glove"}) {
    for (const auto& [name, matrix] : fitting) {
      if (name == known || name.ends_with(std::string(".") + known)) {
        return {{name, matrix}};
      }
    }
  }
  return fitting;
}

/// Reads the measurements of a glove of 18 or 22 sensors.
Recording read_glove_matrix(const std::filesystem::path& file,
                            const std::map<std::string, Eigen::MatrixXd>& matrices) {
  const std::map<std::string, Eigen::MatrixXd> fitting = glove_matrices(matrices);
  if (fitting.size() != 1) {
    throw geometric::InputError(
        {file.string(), "", names_of(matrices),
         "\"angles\" (degrees) or \"glove\" (counts), or one matrix, of 18 or 22 columns",
         choose_advice(matrices.empty() ? "NAME" : matrices.begin()->first)});
  }
  const auto& [name, matrix] = *fitting.begin();
  const NumberTable table{
      {}, matrix.unaryExpr([](double v) { return std::isfinite(v) ? v : kGap; }), {}, {}};
  TableLayout layout;
  layout.columns = glove_columns(static_cast<int>(matrix.cols()), 0);
  const auto rate = matrices.find("frequency");
  const bool has_rate = rate != matrices.end() && rate->second.size() == 1 && rate->second(0) > 0.0;
  layout.rate = has_rate ? rate->second(0) : kUsualRate;
  if (name == "angles") {
    for (ColumnUse& use : layout.columns) {
      use.gain = geometric::kDegree;
    }
    Recording recording = recording_of(file, table, layout);
    recording.warnings.push_back(
        fmt::format("{}: variable \"angles\" taken for degrees", file.string()));
    return recording;
  }
  return recording_by_numbers(file, table, layout);
}

/// The matrices of a MATLAB file.
class MatlabArrays final : public NamedArrays {
 public:
  explicit MatlabArrays(const std::filesystem::path& file)
      : NamedArrays(file), matrices_(read_matlab_file(file)) {
    for (const auto& [name, matrix] : matrices_) {
      variables_.push_back(
          {name,
           {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())},
           "numbers",
           ""});
    }
  }

  [[nodiscard]] const std::map<std::string, Eigen::MatrixXd>& matrices() const { return matrices_; }

 private:
  [[nodiscard]] Eigen::MatrixXd numbers(const RecordingVariable& variable) const override {
    return matrices_.at(variable.name);
  }

  std::map<std::string, Eigen::MatrixXd> matrices_;
};

class MatlabFiles final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"MATLAB", "Matrices of a MATLAB file, version 5 to 7.3."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    return is_matlab_file(file.path());
  }
  [[nodiscard]] bool has_variables() const override { return true; }
  [[nodiscard]] std::unique_ptr<ArrayFile> open(const RecordingFile& file) const override {
    return std::make_unique<MatlabArrays>(file.path());
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    const MatlabArrays arrays(file.path());
    const bool is_of_other =
        glove_matrices(arrays.matrices()).empty() && !recordable_variables(arrays).empty();
    return is_of_other || !file.variable().empty()
               ? read_array_recording(arrays, file.variable())
               : read_glove_matrix(file.path(), arrays.matrices());
  }
};

}  // namespace

const RecordingFormat& matlab_format() {
  static const MatlabFiles kFormat;
  return kFormat;
}

}  // namespace handway::device
