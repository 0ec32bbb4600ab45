#include "recordings/matlab_file.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <matio.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string_view>

namespace handway::device {
namespace {

constexpr std::size_t kMostEntries = std::size_t{1} << 27;  // 1 GB of numbers

using File = std::unique_ptr<mat_t, int (*)(mat_t*)>;
using Variable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

bool is_matrix(const matvar_t& variable) {
  return variable.rank == 2 && variable.isComplex == 0 && variable.class_type >= MAT_C_DOUBLE &&
         variable.class_type <= MAT_C_UINT64 && variable.dims[0] > 0 && variable.dims[1] > 0 &&
         variable.dims[1] <= kMostEntries / variable.dims[0];
}

template <typename Number>
Eigen::MatrixXd numbers(const matvar_t& variable) {
  using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  return Eigen::Map<const Matrix>(static_cast<const Number*>(variable.data),
                                  static_cast<Eigen::Index>(variable.dims[0]),
                                  static_cast<Eigen::Index>(variable.dims[1]))
      .template cast<double>();
}

// Numbers have their class, however few bytes they took in the file.
Eigen::MatrixXd matrix(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_SINGLE:
      return numbers<float>(variable);
    case MAT_C_INT8:
      return numbers<std::int8_t>(variable);
    case MAT_C_UINT8:
      return numbers<std::uint8_t>(variable);
    case MAT_C_INT16:
      return numbers<std::int16_t>(variable);
    case MAT_C_UINT16:
      return numbers<std::uint16_t>(variable);
    case MAT_C_INT32:
      return numbers<std::int32_t>(variable);
    case MAT_C_UINT32:
      return numbers<std::uint32_t>(variable);
    case MAT_C_INT64:
      return numbers<std::int64_t>(variable);
    case MAT_C_UINT64:
      return numbers<std::uint64_t>(variable);
    default:
      return numbers<double>(variable);
  }
}

void add_matrices(const std::filesystem::path& file, mat_t& opened, const std::string& name,
                  matvar_t& variable, std::map<std::string, Eigen::MatrixXd>& matrices);

// Adds the matrices in the cells of an array of cells, as "name{row,column}".
void add_cells(const std::filesystem::path& file, mat_t& opened, const std::string& name,
               matvar_t& variable, std::map<std::string, Eigen::MatrixXd>& matrices) {
  constexpr std::size_t kMostCells = 100000;
  if (variable.rank != 2 || variable.dims[0] > kMostCells || variable.dims[1] > kMostCells ||
      variable.dims[0] * variable.dims[1] > kMostCells || variable.data == nullptr) {
    return;
  }
  for (std::size_t i = 0; i < variable.dims[0] * variable.dims[1]; ++i) {
    matvar_t* cell = Mat_VarGetCell(&variable, static_cast<int>(i));
    if (cell != nullptr && cell->class_type != MAT_C_CELL && cell->class_type != MAT_C_STRUCT) {
      add_matrices(
          file, opened,
          fmt::format("{}{{{},{}}}", name, i % variable.dims[0] + 1, i / variable.dims[0] + 1),
          *cell, matrices);
    }
  }
}

void add_matrices(const std::filesystem::path& file, mat_t& opened, const std::string& name,
                  matvar_t& variable, std::map<std::string, Eigen::MatrixXd>& matrices) {
  if (variable.class_type == MAT_C_CELL) {
    add_cells(file, opened, name, variable, matrices);
  }
  if (variable.class_type == MAT_C_STRUCT && variable.rank == 2 && variable.dims[0] == 1 &&
      variable.dims[1] == 1) {
    char* const* fields = Mat_VarGetStructFieldnames(&variable);
    for (unsigned i = 0; fields != nullptr && i < Mat_VarGetNumberOfFields(&variable); ++i) {
      matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
      if (field != nullptr && field->class_type != MAT_C_STRUCT) {
        add_matrices(file, opened, name + '.' + fields[i], *field, matrices);
      }
    }
  }
  if (!is_matrix(variable)) {
    return;
  }
  if (Mat_VarReadDataAll(&opened, &variable) != 0 || variable.data == nullptr) {
    throw geometric::InputError({file.string(), "variable " + name,
                                 "one that is cut off or damaged", "a matrix",
                                 "Copy the file again."});
  }
  matrices[name] = matrix(variable);
}

}  // namespace

bool is_matlab_file(const std::filesystem::path& file) {
  std::string begin(std::string_view("MATLAB 5.0 MAT-file").size(), ' ');
  std::ifstream(file, std::ios::binary)
      .read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == "MATLAB 5.0 MAT-file" || begin == "MATLAB 7.3 MAT-file";
}

std::map<std::string, Eigen::MatrixXd> read_matlab_file(const std::filesystem::path& file) {
  const File opened(Mat_Open(file.c_str(), MAT_ACC_RDONLY), Mat_Close);
  if (!opened) {
    throw geometric::InputError({file.string(), "", "a file that can't be opened",
                                 "a MATLAB file of version 5 or 7.3",
                                 "Save it again, by save('FILE.mat', '-v7')."});
  }
  std::map<std::string, Eigen::MatrixXd> matrices;
  while (const auto variable = Variable(Mat_VarReadNextInfo(opened.get()), Mat_VarFree)) {
    if (variable->name != nullptr) {
      add_matrices(file, *opened, variable->name, *variable, matrices);
    }
  }
  return matrices;
}

std::string names_of(const std::map<std::string, Eigen::MatrixXd>& matrices) {
  std::string text;
  for (const auto& [name, matrix] : matrices) {
    text +=
        fmt::format("{}{} ({} x {})", text.empty() ? "" : ", ", name, matrix.rows(), matrix.cols());
  }
  return text.empty() ? "no matrix" : text;
}

}  // namespace handway::device
