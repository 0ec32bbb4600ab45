#pragma once

#include "grasps/hand_closing.h"
#include "grasps/object_chords.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/sampling/sequences/random_stream.h"

/// Places of a hand around an object, drawn at random.

namespace handway::planning {

/// A place of the hand around an object, before its fingers close.
struct GraspPlace {
  HandClosing::Preshape preshape;
  geometric::Pose X_OP;  ///< Pose of the palm.
  geometric::Aabb core;  ///< Part of the object that the fingers close around, in its frame.
};

/// Draws a pose of the palm, in the object's frame, that has a chord of the object between the
/// thumb and the fingers, anywhere from their tips to the palm.
[[nodiscard]] geometric::Pose palm_at(const HandClosing::Preshape& preshape, const Chord& chord,
                                      sampling::RandomStream& random);

/// Draws a place that is moved by at most 15 mm along each axis and turned by at most 15° about
/// each axis of its grip.
[[nodiscard]] GraspPlace beside(const GraspPlace& place, sampling::RandomStream& random);

}  // namespace handway::planning
