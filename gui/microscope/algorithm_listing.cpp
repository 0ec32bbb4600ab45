#include "microscope/algorithm_listing.h"

#include <array>

namespace handway::gui {
namespace {

using namespace std::string_view_literals;

constexpr std::array kSampleArm{
    "i ← 0"sv,
    "while i < most draws"sv,
    "  cₐ ← point at step of the arm segment + random offset in ±ρₐ"sv,
    "  if the arm at cₐ is free of itself"sv,
    "    return cₐ"sv,
    "  end"sv,
    "  i ← i + 1"sv,
    "end"sv,
    "return nothing"sv,
};

constexpr std::array kSampleHand{
    "i ← 0"sv,
    "while i < most draws"sv,
    "  u ← random point of the unit cube, one axis for each of SCʰ"sv,
    "  cₕ ← posture of the hand at u (Eq. 1)"sv,
    "  c ← (cₐ, cₕ)"sv,
    "  if c is free of itself"sv,
    "    if c is free of the objects"sv,
    "      return c"sv,
    "    end"sv,
    "  end"sv,
    "  i ← i + 1"sv,
    "end"sv,
    "return nothing"sv,
};

constexpr std::array kConnectSample{
    "add s to the roadmap G"sv,
    "neighbours ← the K nodes of G nearest to s"sv,
    "for each neighbour g"sv,
    "  if g and s are not joined yet"sv,
    "    if the straight way from g to s is free"sv,
    "      add the edge (g, s) to G"sv,
    "      update the components of G"sv,
    "    end"sv,
    "  end"sv,
    "end"sv,
    "return G"sv,
};

constexpr std::array kRoadmap{
    "G ← empty"sv,
    "add the start to G"sv,
    "add the goal to G"sv,
    "samples ← 2"sv,
    "k ← 1"sv,
    "repeat"sv,
    "  ρₐ ← k · ρₐ"sv,
    "  k ← k + 1"sv,
    "  n ← number of hypercubes along the arm segment"sv,
    "  range ← [0, 1]"sv,
    "  for i from 1 to n"sv,
    "    step ← i-th point of the Van der Corput sequence of n"sv,
    "    if step is in the range"sv,
    "      for j from 1 to nA"sv,
    "        if cₐ ← SampleArm(step, ρₐ)"sv,
    "          axes of SCʰ ← thumb base and one PMD"sv,
    "          for h from 1 to nH"sv,
    "            if c ← SampleHand(cₐ, axes)"sv,
    "              ConnectSample(c, G)"sv,
    "              if start and goal are joined"sv,
    "                return the path between them"sv,
    "              end"sv,
    "              range ← what lies between the two components"sv,
    "              leave the loop of j"sv,
    "            else"sv,
    "              one PMD more"sv,
    "            end"sv,
    "            samples ← samples + 1"sv,
    "          end"sv,
    "        end"sv,
    "      end"sv,
    "    end"sv,
    "  end"sv,
    "until samples > N"sv,
    "return failure"sv,
};

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
