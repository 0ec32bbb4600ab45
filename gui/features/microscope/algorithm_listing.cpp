#include "features/microscope/algorithm_listing.h"

#include <array>
#include <cstddef>

namespace handway::gui {
namespace {

constexpr auto kSampleArm = std::to_array<std::string_view>({
    "i ← 0",
    "while i < most samples",
    "  cₐ ← point at step of the arm segment + random offset in ±ρₐ",
    "  if the arm at cₐ is free of itself",
    "    return cₐ",
    "  end",
    "  i ← i + 1",
    "end",
    "return nothing",
});

constexpr auto kSampleHand = std::to_array<std::string_view>({
    "i ← 0",
    "while i < most samples",
    "  u ← random point of the unit cube, one axis for each of SCʰ",
    "  cₕ ← posture of the hand at u (Eq. 1)",
    "  c ← (cₐ, cₕ)",
    "  if c is free of itself",
    "    if c is free of the objects",
    "      return c",
    "    end",
    "  end",
    "  i ← i + 1",
    "end",
    "return nothing",
});

constexpr auto kConnectSample = std::to_array<std::string_view>({
    "add s to the roadmap G",
    "neighbours ← the K nodes of G nearest to s",
    "for each neighbour g",
    "  if g and s are not joined yet",
    "    if the straight motion from g to s is free",
    "      add the edge (g, s) to G",
    "      update the components of G",
    "    end",
    "  end",
    "end",
    "return G",
});

constexpr auto kRoadmap = std::to_array<std::string_view>({
    "G ← empty",
    "add the start to G",
    "add the goal to G",
    "samples ← 2",
    "k ← 1",
    "repeat",
    "  ρₐ ← k · ρₐ",
    "  k ← k + 1",
    "  n ← number of hypercubes along the arm segment",
    "  range ← [0, 1]",
    "  for i from 1 to n",
    "    step ← i-th point of the Van der Corput sequence of n",
    "    if step is in the range",
    "      for j from 1 to nA",
    "        if cₐ ← SampleArm(step, ρₐ)",
    "          axes of SCʰ ← thumb base and one PMD",
    "          for h from 1 to nH",
    "            if c ← SampleHand(cₐ, axes)",
    "              ConnectSample(c, G)",
    "              if start and goal are joined",
    "                return the path between them",
    "              end",
    "              range ← what lies between the two components",
    "              leave the loop of j",
    "            else",
    "              one PMD more",
    "            end",
    "            samples ← samples + 1",
    "          end",
    "        end",
    "      end",
    "    end",
    "  end",
    "until samples > N",
    "return failure",
});

constexpr std::array<AlgorithmListing, 4> kListings{{
    {1, "SampleArm(step, ρₐ)", kSampleArm},
    {2, "SampleHand(cₐ, axes)", kSampleHand},
    {3, "ConnectSample(s, G)", kConnectSample},
    {4, "Roadmap(start, goal)", kRoadmap},
}};

}  // namespace

const AlgorithmListing& algorithm_listing(int algorithm) {
  return kListings[static_cast<std::size_t>(algorithm - 1)];
}

}  // namespace handway::gui
