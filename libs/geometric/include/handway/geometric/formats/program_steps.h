#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/scene/program.h"
#include "handway/geometric/scene/scene.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// Range of the lengths of straight motions in programs, m: from 0 to this.
inline constexpr double kLongestStraightMotion = 10.0;

/// Reads a list of steps, maps with one key each. Lengths are in m, angles in degrees.
///
///     - pick: {object: can, approach: 0.1, lift: 0.1}
///     - place: {on: shelf, lower: 0.1, retreat: 0.1}    # or {pose: {xyz: …, rpy_deg: …}}
///     - move: start                                     # or a posture of the scene
///     - move: {link: palm, in: shelf, xyz: [0, 0, 0.2]} # or as in `goal_pose`
///     - line: {xyz: [0, 0, 0.1], in: palm}              # along the axes of the palm
///     - wait: 2.5                                       # s
///     - output: {name: do3, value: true}                # or false, or a number
///     - first_of: [[place: shelf], [place: table]]      # the first list that is possible
///
/// `pick: can` and `place: shelf` are short for maps with default lengths. A step with a second
/// key, `disabled: true`, is kept, but not planned.
/// @param scene whose objects the steps name.
/// @param warnings receives the names of objects that the scene does not have; nullptr: they are
/// errors.
/// @throws InputError naming file, line and element of the error.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<ProgramStep> program_steps_of(
    const YamlElement& list, const Scene& scene, std::vector<std::string>* warnings = nullptr);

}  // namespace handway::geometric
