#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/math/units.h"
#include "recordings/array_process.h"
#include "recordings/array_recording.h"
#include "recordings/recording_formats.h"
#include "recordings/series_table.h"
#include "recordings/table_layout.h"
#include "recordings/table_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {
namespace {

bool is_of_glove(std::size_t columns) { return columns == 18 || columns == kGloveSensors; }

/// A matrix of a glove's measurements.
struct GloveMatrix {
  std::string name;
  bool transposed = false;  ///< Sensors are rows.
};

/// Finds the matrix of a glove: the only one, or that with a name of Ninapro's files: "angles",
/// which are calibrated, before "glove". Nothing if none fits, or several do.
std::optional<GloveMatrix> glove_matrix(const ArrayFile& arrays) {
  std::vector<GloveMatrix> fitting;
  for (const RecordingVariable& variable : arrays.variables()) {
    const std::size_t rows = variable.shape.front();
    const std::size_t columns = variable.shape.back();
    if (rows > 1 && is_of_glove(columns)) {
      fitting.push_back({variable.name, false});
    } else if (is_of_glove(rows) && columns > kGloveSensors) {
      fitting.push_back({variable.name, true});
    }
  }
  for (const std::string_view known : {"angles", "glove"}) {
    for (const GloveMatrix& matrix : fitting) {
      if (matrix.name == known || matrix.name.ends_with(fmt::format(".{}", known))) {
        return matrix;
      }
    }
  }
  return fitting.size() == 1 ? std::optional(fitting.front()) : std::nullopt;
}

/// The rate in the variable "frequency", Hz.
double rate_of(const ArrayFile& arrays) {
  const auto rate = std::ranges::find(arrays.variables(), "frequency", &RecordingVariable::name);
  if (rate == arrays.variables().end() || rate->shape.front() * columns_of(*rate) != 1) {
    return kUsualRate;
  }
  const double value = arrays.series(rate->name).values(0, 0);
  return value > 0.0 ? value : kUsualRate;
}

/// Reads the measurements of a glove of 18 or 22 sensors.
Recording read_glove_matrix(const ArrayFile& arrays, const GloveMatrix& matrix) {
  const std::filesystem::path& file = arrays.path();
  Series series = arrays.series(matrix.name);
  series.times.clear();
  series.names.clear();
  if (matrix.transposed) {
    series.values = series.values.transpose().eval();
  }
  TableLayout layout;
  layout.columns = glove_columns(static_cast<int>(series.values.cols()), 0);
  layout.rate = rate_of(arrays);
  if (matrix.name == "angles") {
    for (ColumnUse& use : layout.columns) {
      use.gain = geometric::kDegree;
    }
    Recording recording = recording_of(file, table_of(series), layout);
    recording.warnings.push_back(
        fmt::format("{}: variable \"angles\" taken for degrees", file.string()));
    return recording;
  }
  return recording_by_numbers(file, table_of(series), layout);
}

class MatlabFiles final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"MATLAB", "Matrices of a MATLAB file, version 5 to 7.3."};
  }
  [[nodiscard]] bool has_variables() const override { return true; }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    return file.head().starts_with("MATLAB 5.0 MAT-file") ||
           file.head().starts_with("MATLAB 7.3 MAT-file");
  }
  [[nodiscard]] std::unique_ptr<ArrayFile> open(const RecordingFile& file) const override {
    return std::make_unique<ProcessArrays>(file.path(), "matlab");
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    const std::unique_ptr<ArrayFile> arrays = open(file);
    const std::optional<GloveMatrix> matrix =
        file.variable().empty() ? glove_matrix(*arrays) : std::nullopt;
    return matrix ? read_glove_matrix(*arrays, *matrix)
                  : read_array_recording(*arrays, file.variable());
  }
};

}  // namespace

const RecordingFormat& matlab_format() {
  static const MatlabFiles kFormat;
  return kFormat;
}

}  // namespace handway::device
