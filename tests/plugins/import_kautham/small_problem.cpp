#include "small_problem.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace handway::test {
namespace {

constexpr const char* kCube = R"(#Inventor V2.1 ascii
Separator {
  Material { diffuseColor 1 0.5 0.25 }
  Cube { width 20 height 20 depth 20 }
}
)";

constexpr const char* kRobot = R"(<?xml version="1.0"?>
<Robot name="Small" DHType="Modified" robType="Tree">
  <Joints size="8">
    <Joint name="Base" ivFile="cube.iv">
      <DHPars alpha="0" a="0" theta="0" d="10"/>
      <Description rotational="false" movable="false"/>
      <Limits Hi="0" Low="0"/>
      <Parent name=""/>
    </Joint>
    <Joint name="Turn" ivFile="cube.iv">
      <DHPars alpha="0" a="0" theta="30" d="100"/>
      <Description rotational="true" movable="true"/>
      <Limits Hi="90" Low="-90"/>
      <Parent name="Base"/>
    </Joint>
    <Joint name="Lift" ivFile="cube.iv">
      <DHPars alpha="-90" a="50" theta="0" d="0"/>
      <Description rotational="false" movable="true"/>
      <Limits Hi="300" Low="100"/>
      <Parent name="Turn"/>
    </Joint>
    <Joint name="Palm" ivFile="cube.iv">
      <DHPars alpha="90" a="100" theta="0" d="0"/>
      <Description rotational="true" movable="true"/>
      <Limits Hi="20" Low="20"/>
      <Parent name="Lift"/>
    </Joint>
    <Joint name="Thumb" ivFile="cube.iv">
      <DHPars alpha="0" a="0" theta="0" d="0"/>
      <PreTrans X="0" Y="80" Z="0" WX="0" WY="3" WZ="0" TH="45"/>
      <Description rotational="true" movable="true"/>
      <Limits Hi="0" Low="-90"/>
      <Parent name="Palm"/>
    </Joint>
    <Joint name="Spread" ivFile="cube.iv">
      <DHPars alpha="0" a="100" theta="0" d="0"/>
      <Description rotational="true" movable="true"/>
      <Limits Hi="20" Low="-20"/>
      <Parent name="Palm"/>
    </Joint>
    <Joint name="Med" ivFile="cube.iv">
      <DHPars alpha="-90" a="50" theta="0" d="0"/>
      <Description rotational="true" movable="true"/>
      <Limits Hi="75" Low="0"/>
      <Parent name="Spread"/>
    </Joint>
    <Joint name="Dist" ivFile="cube.iv">
      <DHPars alpha="0" a="50" theta="0" d="0"/>
      <Description rotational="true" movable="true"/>
      <Limits Hi="75" Low="0"/>
      <Parent name="Med"/>
    </Joint>
  </Joints>
  <ControlSet size="5" nTrunk="2">
    <Offset>
      <DOF name="Turn" value="0.5"/> <DOF name="Lift" value="0.5"/>
      <DOF name="Thumb" value="0.4"/> <DOF name="Spread" value="0.5"/>
      <DOF name="Med" value="0.3"/> <DOF name="Dist" value="0.3	"/>
    </Offset>
    <Control name="Turn" eigValue="1"><DOF name="Turn" value="1"/></Control>
    <Control name="Lift" eigValue="1"><DOF name="Lift" value="1"/></Control>
    <Control name="Thumb" eigValue="0.8"><DOF name="Thumb" value="1"/></Control>
    <Control name="Spread" eigValue="0.2">
      <DOF name="Spread" value="0.8"/><DOF name="Med" value="-0.6"/><DOF name="Dist" value="-0.6"/>
    </Control>
    <Control name="Close" eigValue="0.9">
      <DOF name="Spread" value="0.6"/><DOF name="Med" value=" 0.8"/><DOF name="Dist" value="0.8"/>
    </Control>
  </ControlSet>
</Robot>
)";

constexpr const char* kProblem = R"(<?xml version="1.0"?>
<Problem name="Small.xml">
  <Robot robot="robots/small.rob" scale="1.0">
    <Home TH="180" WX="0" WY="0" WZ="2" X="100" Y="0" Z="0"/>
  </Robot>
  <Scene scene="robots/cube.iv" scale="5">
    <Location TH="0" WX="0" WY="0" WZ="1" X="2000" Y="0" Z="0"/>
  </Scene>
  <Scene scene="robots/cube.iv" scale="5">
    <Location TH="90" WX="1" WY="0" WZ="0" X="0" Y="2000" Z="500"/>
  </Scene>
  <Planner>
    <Parameters>
      <Name>PRMAURO HandArm</Name>
      <Parameter name="Cloud Size">10</Parameter>
    </Parameters>
    <Queries>
      <Query>
        <Init dim="5">0.5 0.5 0.5 0.5 0.5</Init>
        <Goal dim="5">1 0.25 0 1 0.5</Goal>
      </Query>
    </Queries>
  </Planner>
</Problem>
)";

}  // namespace

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
}

SmallProblem::SmallProblem() {
  std::filesystem::create_directories(folder() / "robots");
  write_text(cube(), kCube);
  write_text(robot(), kRobot);
  write_text(problem(), kProblem);
}

void SmallProblem::edit(const std::filesystem::path& file, const std::string& from,
                        const std::string& to) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  const auto at = text.find(from);
  if (at == std::string::npos) {
    throw std::logic_error("\"" + from + "\" is not in " + file.string());
  }
  write_text(file, text.replace(at, from.size(), to));
}

}  // namespace handway::test
