#pragma once

#include "methods.h"

namespace handway::planner_ompl {

/// The parameters of OMPL's that are offered, each for all planners that take it.

inline const MethodSetting kRange = {
    "range",
    "Step length",
    "Longest step of a tree, in joints normalised to [0, 1]. 0: a fifth of the space's diagonal.",
    0.0,
    0.0,
    10.0};
inline const MethodSetting kGoalBias = {
    "goal_bias", "Share of the goal", "Share of samples that are the goal itself.", 0.05, 0.0, 1.0};
inline const MethodSetting kNeighbours = {"max_nearest_neighbors",
                                          "Neighbours",
                                          "Nearest milestones that a new one is connected to.",
                                          10,
                                          1.0,
                                          1000.0};
inline const MethodSetting kBorderFraction = {
    "border_fraction",
    "Share of the border",
    "Share of expansions from cells at the border of what is explored.",
    0.9,
    0.001,
    1.0};
inline const MethodSetting kFailureFactor = {
    "failed_expansion_score_factor",
    "Factor of failure",
    "A cell's score is multiplied by this when an expansion from it fails.",
    0.5,
    0.001,
    1.0};
inline const MethodSetting kLeastPart = {
    "min_valid_path_fraction",
    "Least part of a step",
    "A step that is not free is kept up to where it is, if that is more than this share.",
    0.2,
    0.001,
    1.0};
inline const MethodSetting kRewireFactor = {
    "rewire_factor",
    "Rewiring factor",
    "Neighbours are looked for this much farther than theory asks for.",
    1.1,
    1.01,
    2.0};
inline const MethodSetting kNumSamples = {
    "num_samples",
    "Samples at once",
    "Valid samples drawn before the tree grows; more are drawn if they don't do.",
    1000,
    10.0,
    100000.0};
inline const MethodSetting kBatch = {"samples_per_batch",
                                     "Samples per batch",
                                     "Valid samples drawn before edges are looked at again.",
                                     100,
                                     1.0,
                                     10000.0};

}  // namespace handway::planner_ompl
