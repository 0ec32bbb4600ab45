#include "readers.h"

#include <matio.h>

#include <cstdint>
#include <functional>
#include <memory>

namespace handway::array_reader {
namespace {

using File = std::unique_ptr<mat_t, int (*)(mat_t*)>;
using Variable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;
/// Takes a matrix with its name; returns false to end the search.
using Take = std::function<bool(const std::string& name, matvar_t& matrix)>;

bool is_matrix(const matvar_t& variable) {
  return variable.rank == 2 && variable.isComplex == 0 && variable.class_type >= MAT_C_DOUBLE &&
         variable.class_type <= MAT_C_UINT64 && variable.dims[0] > 0 && variable.dims[1] > 0 &&
         variable.dims[1] <= kMostNumbers / variable.dims[0];
}

bool is_one_structure(const matvar_t& variable) {
  return variable.class_type == MAT_C_STRUCT && variable.rank == 2 && variable.dims[0] == 1 &&
         variable.dims[1] == 1;
}

bool are_cells(const matvar_t& variable) {
  constexpr std::size_t kMostCells = 100000;
  return variable.class_type == MAT_C_CELL && variable.rank == 2 && variable.data != nullptr &&
         variable.dims[0] > 0 && variable.dims[0] <= kMostCells &&
         variable.dims[1] <= kMostCells / variable.dims[0];
}

/// Passes the matrices of a variable: of a structure's fields as "name.field", of cells as
/// "name{row,column}". Further nesting is ignored.
bool visit(const std::string& name, matvar_t& variable, bool nested, const Take& take) {
  if (is_matrix(variable)) {
    return take(name, variable);
  }
  if (is_one_structure(variable) && !nested) {
    char* const* fields = Mat_VarGetStructFieldnames(&variable);
    for (unsigned i = 0; fields != nullptr && i < Mat_VarGetNumberOfFields(&variable); ++i) {
      matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
      if (field != nullptr && field->class_type != MAT_C_STRUCT &&
          !visit(name + '.' + fields[i], *field, true, take)) {
        return false;
      }
    }
  }
  if (are_cells(variable)) {
    for (std::size_t i = 0; i < variable.dims[0] * variable.dims[1]; ++i) {
      matvar_t* cell = Mat_VarGetCell(&variable, static_cast<int>(i));
      const std::string place = '{' + std::to_string(i % variable.dims[0] + 1) + ',' +
                                std::to_string(i / variable.dims[0] + 1) + '}';
      if (cell != nullptr && is_matrix(*cell) && !take(name + place, *cell)) {
        return false;
      }
    }
  }
  return true;
}

void visit_file(mat_t& file, const Take& take) {
  while (const auto variable = Variable(Mat_VarReadNextInfo(&file), Mat_VarFree)) {
    if (variable->name != nullptr && !visit(variable->name, *variable, false, take)) {
      return;
    }
  }
}

File open_file(const std::string& path) {
  File file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), Mat_Close);
  if (!file) {
    throw Refusal("a file that can't be opened", "a MATLAB file of version 5 or 7.3",
                  "Save it again, by save('FILE.mat', '-v7').");
  }
  return file;
}

const char* type_name(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_SINGLE:
      return "float32";
    case MAT_C_INT8:
      return "int8";
    case MAT_C_UINT8:
      return "uint8";
    case MAT_C_INT16:
      return "int16";
    case MAT_C_UINT16:
      return "uint16";
    case MAT_C_INT32:
      return "int32";
    case MAT_C_UINT32:
      return "uint32";
    case MAT_C_INT64:
      return "int64";
    case MAT_C_UINT64:
      return "uint64";
    default:
      return "float64";
  }
}

template <typename Number>
std::vector<double> converted(const matvar_t& matrix) {
  const auto* first = static_cast<const Number*>(matrix.data);
  return {first, first + matrix.dims[0] * matrix.dims[1]};
}

// Numbers have their class, however few bytes they took in the file.
std::vector<double> numbers(const matvar_t& matrix) {
  switch (matrix.class_type) {
    case MAT_C_SINGLE:
      return converted<float>(matrix);
    case MAT_C_INT8:
      return converted<std::int8_t>(matrix);
    case MAT_C_UINT8:
      return converted<std::uint8_t>(matrix);
    case MAT_C_INT16:
      return converted<std::int16_t>(matrix);
    case MAT_C_UINT16:
      return converted<std::uint16_t>(matrix);
    case MAT_C_INT32:
      return converted<std::int32_t>(matrix);
    case MAT_C_UINT32:
      return converted<std::uint32_t>(matrix);
    case MAT_C_INT64:
      return converted<std::int64_t>(matrix);
    case MAT_C_UINT64:
      return converted<std::uint64_t>(matrix);
    default:
      return converted<double>(matrix);
  }
}

std::vector<ArrayInfo> list_matlab(const std::string& path) {
  const File file = open_file(path);
  std::vector<ArrayInfo> arrays;
  visit_file(*file, [&](const std::string& name, matvar_t& matrix) {
    arrays.push_back({name, {matrix.dims[0], matrix.dims[1]}, type_name(matrix), ""});
    return true;
  });
  return arrays;
}

Elements read_matlab(const std::string& path, const ArrayInfo& info) {
  const File file = open_file(path);
  Elements elements;
  visit_file(*file, [&](const std::string& name, matvar_t& matrix) {
    if (name != info.name) {
      return true;
    }
    if (Mat_VarReadDataAll(file.get(), &matrix) != 0 || matrix.data == nullptr) {
      throw Refusal("one that is cut off or damaged", "a matrix", "Copy the file again.");
    }
    elements.rows = matrix.dims[0];
    elements.columns = matrix.dims[1];
    elements.by_column = true;
    elements.numbers = numbers(matrix);
    return false;
  });
  return elements;
}

}  // namespace

const Reader& matlab_reader() {
  static const Reader kReader{list_matlab, read_matlab};
  return kReader;
}

}  // namespace handway::array_reader
