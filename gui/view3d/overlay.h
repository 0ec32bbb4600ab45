#pragma once

namespace handway::gui {

/// What is drawn into the scene without being part of it.
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
};

}  // namespace handway::gui
