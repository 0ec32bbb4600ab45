#include "arrays.h"
#include "bindings.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "scene_model.h"

#include <pybind11/stl.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using sampling::FreeJoint;
using sampling::PmdBasis;
using sampling::PrincipalDirection;

Eigen::Index joint_count(const PmdBasis& basis) {
  return static_cast<Eigen::Index>(basis.joints.size());
}

py::array_t<double> directions(const PmdBasis& basis) {
  std::vector<Eigen::VectorXd> rows;
  for (const PrincipalDirection& direction : basis.directions) {
    rows.push_back(direction.vector);
  }
  return to_array(rows, joint_count(basis));
}

py::array_t<double> of_directions(const PmdBasis& basis, double PrincipalDirection::*member) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(basis.directions.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] = basis.directions[static_cast<std::size_t>(i)].*member;
  }
  return to_array(values);
}

py::list direction_names(const PmdBasis& basis) {
  py::list names;
  for (const PrincipalDirection& direction : basis.directions) {
    names.append(direction.name);
  }
  return names;
}

py::object for_each_row(const Array& array, Eigen::Index width, const char* argument,
                        Eigen::Index answer_width,
                        const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function) {
  Batch batch = batch_from(array, width, argument);
  for (Eigen::VectorXd& row : batch.rows) {
    row = function(row);
  }
  return to_answer(batch, batch.rows, answer_width);
}

py::object posture(const PmdBasis& basis, const Array& u) {
  return for_each_row(u, basis.dimension(), "u", joint_count(basis),
                      [&](const Eigen::VectorXd& row) { return map_to_posture(basis, row); });
}

py::object coordinates(const PmdBasis& basis, const Array& postures) {
  return for_each_row(postures, joint_count(basis), "posture", basis.dimension(),
                      [&](const Eigen::VectorXd& row) { return project(basis, row); });
}

py::object distance(const PmdBasis& basis, const Array& postures) {
  const Batch batch = batch_from(postures, joint_count(basis), "posture");
  std::vector<double> distances;
  for (const Eigen::VectorXd& row : batch.rows) {
    distances.push_back(distance_to_subspace(basis, row));
  }
  return to_answer(batch, distances);
}

}  // namespace

void bind_basis(py::module_& module) {
  py::class_<FreeJoint>(module, "FreeJoint",
                        "A hand joint that is sampled on its own, beside the directions.")
      .def_readonly("joint", &FreeJoint::joint, "Index into Basis.joints.")
      .def_readonly(
          "centre", &FreeJoint::centre,
          "Centre of the box along its axis, normalised: 0 to 1 between the joint's limits.")
      .def_readonly("half_side", &FreeJoint::half_side,
                    "Half side of the box along its axis, normalised.");

  py::class_<PmdBasis, std::shared_ptr<PmdBasis>>(
      module, "Basis",
      "Principal motion directions of a hand around its mean posture, and the box that is\n"
      "sampled. Postures are normalised: every joint is 0 to 1 between its limits.")
      .def_readonly("hand", &PmdBasis::hand, "Name of the robot that the joints belong to.")
      .def_readonly("source", &PmdBasis::source, "Source of the numbers, as text.")
      .def_readonly("joints", &PmdBasis::joints,
                    "Names of the joints, in the order of the vectors' entries.")
      .def_readonly("free_joints", &PmdBasis::free_joints,
                    "Joints that are the first axes of the box.")
      .def_property_readonly("dimension", &PmdBasis::dimension,
                             "Number of axes of the box: free joints and directions.")
      .def_property_readonly(
          "mean", [](const PmdBasis& basis) { return to_array(basis.mean); },
          "Mean posture, [joints], normalised.")
      .def_property_readonly(
          "directions", &directions,
          "Unit vectors of the directions, one per row, [directions, joints], in normalised\n"
          "joints.")
      .def_property_readonly("names", &direction_names, "Names of the directions.")
      .def_property_readonly(
          "half_sides",
          [](const PmdBasis& basis) {
            return of_directions(basis, &PrincipalDirection::half_side);
          },
          "Half sides of the box along the directions, [directions], normalised.")
      .def_property_readonly(
          "variances",
          [](const PmdBasis& basis) { return of_directions(basis, &PrincipalDirection::variance); },
          "Variances along the directions, [directions], normalised; 0 if unknown.")
      .def("posture", &posture, py::arg("u"),
           "Returns the posture at a point of the box, clamped to the joints' limits.\n\n"
           "u: 0 to 1 along every axis, [dimension] or [n, dimension].\n"
           "Returns normalised joints, [joints] or [n, joints].")
      .def(
          "coordinates", &coordinates, py::arg("posture"),
          "Returns the coordinates on the axes of the closest posture of the reduced space.\n\n"
          "posture: normalised, [joints] or [n, joints].\n"
          "Returns [dimension] or [n, dimension]; 0 is the mean, and a coordinate beyond the half\n"
          "side of its axis is outside of the box.")
      .def("distance", &distance, py::arg("posture"),
           "Returns the distance of a posture from the reduced space, in normalised joints.\n\n"
           "posture: normalised, [joints] or [n, joints]. Returns a number or [n].")
      .def("__repr__", [](const PmdBasis& basis) {
        return "<handway.Basis of " + basis.hand + ", " + std::to_string(basis.dimension()) +
               " axes>";
      });

  module.def(
      "read_basis",
      [](const py::object& file) {
        return std::const_pointer_cast<PmdBasis>(find_basis(py::str(file)));
      },
      py::arg("file"),
      "Reads a hand basis: a file (YAML) or a name in the library, such as \"sah_auro\".\n\n"
      "Raises InputError naming file, line and key of what is wrong.");
}

}  // namespace handway::python
