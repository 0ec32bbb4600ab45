#pragma once

#include <cstdint>

namespace handway::planning {

/// Counts the edits of what results are made from. Two revisions of one document are equal if and
/// only if nothing was edited between them; 0 in all is before the first.
struct Revision {
  std::uint64_t scene = 0;   ///< Objects, attachments, start and goal.
  std::uint64_t robot = 0;   ///< Models, and where the robots are mounted.
  std::uint64_t basis = 0;   ///< The hand's postures.
  std::uint64_t limits = 0;  ///< Joint ranges, velocities, accelerations.

  friend bool operator==(const Revision&, const Revision&) = default;
};

/// A result, and the revision that it was made from: out of date once that is not the document's.
template <typename T>
struct Derived {
  T value;
  Revision made_from;
};

}  // namespace handway::planning
