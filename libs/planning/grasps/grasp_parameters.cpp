#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/grasps/pregrasp_search.h"

namespace handway::planning {

std::vector<geometric::BoundParameter> parameters_of(PregraspOptions& options) {
  return {
      {"count", "Grasps", "", "Largest number of grasps", &options.most, 1, 1000},
      {"friction", "Friction", "", "Coefficient of friction between hand and object",
       &options.contact.friction, 0.01, 10.0},
      geometric::in_thousandths(
          {"patch_radius_mm", "Contact patch", "mm",
           "Radius of the disc that a soft finger touches with; 0: a hard finger",
           &options.contact.patch_radius, 0.0, 50.0}),
      {"payload", "Payload", "kg", "Mass of the object", &options.payload, 0.0, 1e4},
      {"samples", "Samples", "", "Largest number of palm poses to try", &options.samples, 1, 1e7}};
}

std::vector<geometric::BoundParameter> parameters_of(HoldConditions& conditions) {
  return {
      {"force", "Force", "N", "Disturbing force of the simulation", &conditions.force, 0.0, 1e4},
      {"torque", "Torque", "N·m", "Largest torque of a finger's joint", &conditions.torque, 1e-3,
       1e3},
      {"stiffness", "Stiffness", "N·m/rad", "Stiffness of a finger's joint", &conditions.stiffness,
       1e-3, 1e5}};
}

}  // namespace handway::planning
