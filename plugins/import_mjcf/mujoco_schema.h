#pragma once

#include <string>

namespace handway::import_mjcf {

/// Whether MuJoCo 2.2 knows an attribute of an element; of one that it does not know, too.
[[nodiscard]] bool knows_attribute(const std::string& element, const std::string& attribute);

}  // namespace handway::import_mjcf
