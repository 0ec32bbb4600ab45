#pragma once

#include "handway/planning/core/importer.h"

#include <string>
#include <vector>

namespace handway::tools {

/// Takes `basis=FILE` out of the settings, and puts that basis in the place of the scene's. FILE is
/// a path or the name of a basis that ships.
/// @throws InputError if it can't be read or is for another hand than the scene's basis.
void choose_basis(std::vector<std::string>& settings, planning::LoadedScene& scene);

}  // namespace handway::tools
