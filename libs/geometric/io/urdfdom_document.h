#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <string>
#include <vector>

namespace handway::geometric {

/// What urdfdom made of a text, and what it said about it.
struct UrdfdomResult {
  urdf::ModelInterfaceSharedPtr model;  ///< Null if it refused the text.
  std::vector<std::string> messages;    ///< Errors and warnings, in order.
};

/// Runs urdfdom with its messages caught instead of printed. Any thread.
[[nodiscard]] UrdfdomResult parse_by_urdfdom(const std::string& text);

}  // namespace handway::geometric
