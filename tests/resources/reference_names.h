#pragma once

#include <string>

namespace handway::test {

/// Our joint's name for a joint of the reference `.rob` files ("Index-Med" is
/// "index_medial", "Shoulder" is "joint_1").
/// @throws std::out_of_range for any other name.
[[nodiscard]] std::string joint_name_of(const std::string& reference_name);

}  // namespace handway::test
