#pragma once

namespace handway::gui {

/// Drawings that are added to the scene without being part of it.
enum class Overlay {
  kPath,
  kRoadmap,
  kRegion,
  kExecuted,
  kOptimized,
  kContacts,
  kClearance,
  kTrails,
  kSteps,
  kHypercubes,
  kConstraints,
  kMeasure,
  kFrames,
  kGoalPoses,
  kReach,
  kGrasp,
};

}  // namespace handway::gui
