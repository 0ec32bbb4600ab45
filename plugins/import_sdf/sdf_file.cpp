#include "sdf_file.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/text_file.h"

#include <string>

namespace handway::import_sdf {

bool is_sdf_file(const std::filesystem::path& file) {
  const bool is_other =
      geometric::has_extension(file, ".world") || geometric::has_extension(file, ".xml");
  if (!is_other) {
    return geometric::has_extension(file, ".sdf");
  }
  return geometric::head_of(file).find("<sdf") != std::string::npos;
}

}  // namespace handway::import_sdf
