#include "val3_files.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <initializer_list>
#include <sstream>
#include <utility>

namespace handway::export_val3 {
namespace {

using Attributes = std::initializer_list<std::pair<const char*, std::string>>;

constexpr const char* kNamespace = "http://www.staubli.com/robotics/VAL3/";
constexpr const char* kInstance = "http://www.w3.org/2001/XMLSchema-instance";

pugi::xml_node add(pugi::xml_node parent, const char* name, const Attributes& attributes = {}) {
  pugi::xml_node node = parent.append_child(name);
  for (const auto& [key, value] : attributes) {
    node.append_attribute(key).set_value(value.c_str());
  }
  return node;
}

std::string text_of(pugi::xml_document& document) {
  pugi::xml_node declaration = document.prepend_child(pugi::node_declaration);
  declaration.append_attribute("version").set_value("1.0");
  declaration.append_attribute("encoding").set_value("utf-8");
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

/// Without an exponent, as VAL3's literals are.
std::string number(double value) { return fmt::format("{:.6f}", value); }

pugi::xml_node add_data(pugi::xml_node all, const char* name, const char* type, std::size_t size) {
  return add(all, "Data",
             {{"name", name},
              {"access", "public"},
              {"xsi:type", "array"},
              {"type", type},
              {"size", std::to_string(size)}});
}

void add_number(pugi::xml_node all, const char* name, double value) {
  add(add_data(all, name, "num", 1), "Value", {{"key", "0"}, {"value", fmt::format("{}", value)}});
}

struct Local {
  const char* name;
  const char* type;
};

std::string program(const char* name, std::initializer_list<Local> locals, const char* code) {
  pugi::xml_document document;
  pugi::xml_node node =
      add(add(document.root(), "Programs",
              {{"xmlns:xsi", kInstance}, {"xmlns", std::string(kNamespace) + "Program/2"}}),
          "Program", {{"name", name}, {"access", "public"}});
  if (locals.size() > 0) {
    pugi::xml_node list = add(node, "Locals");
    for (const Local& local : locals) {
      add(list, "Local",
          {{"name", local.name}, {"type", local.type}, {"xsi:type", "array"}, {"size", "1"}});
    }
  }
  add(node, "Code").append_child(pugi::node_cdata).set_value(code);
  return text_of(document);
}

}  // namespace

std::string project_file(const std::string& name) {
  pugi::xml_document document;
  pugi::xml_node project =
      add(document.root(), "Project", {{"xmlns", std::string(kNamespace) + "Project/3"}});
  add(project, "Parameters",
      {{"version", "s7.11"}, {"stackSize", "5000"}, {"millimeterUnit", "true"}});
  pugi::xml_node programs = add(project, "Programs");
  for (const char* file : {"runPath.pgx", "start.pgx", "stop.pgx"}) {
    add(programs, "Program", {{"file", file}});
  }
  add(add(project, "Database"), "Data", {{"file", name + ".dtx"}});
  add(project, "Libraries");
  return text_of(document);
}

std::string data_file(const std::vector<ArmMove>& moves) {
  pugi::xml_document document;
  pugi::xml_node all =
      add(add(document.root(), "Database",
              {{"xmlns:xsi", kInstance}, {"xmlns", std::string(kNamespace) + "Data/2"}}),
          "Datas");
  pugi::xml_node points = add_data(all, "jPath", "jointRx", moves.size());
  pugi::xml_node descriptors = add_data(all, "mMove", "mdesc", moves.size());
  pugi::xml_node pauses = add_data(all, "nPause", "num", moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const ArmMove& move = moves[i];
    const std::string key = std::to_string(i);
    add(points, "Value",
        {{"key", key},
         {"j1", number(move.point[0])},
         {"j2", number(move.point[1])},
         {"j3", number(move.point[2])},
         {"j4", number(move.point[3])},
         {"j5", number(move.point[4])},
         {"j6", number(move.point[5])}});
    add(descriptors, "Value",
        {{"key", key},
         {"accel", number(move.acceleration)},
         {"vel", number(move.velocity)},
         {"decel", number(move.acceleration)},
         {"tmax", "99999"},
         {"rmax", "99999"},
         {"blend", "off"},
         {"leave", "0"},
         {"reach", "0"}});
    add(pauses, "Value", {{"key", key}, {"value", number(move.pause)}});
  }
  add_number(all, "nPoints", static_cast<double>(moves.size()));
  add_number(all, "nTolerance", kStartTolerance);
  add(add_data(all, "tHand", "tool", 1), "Value",
      {{"key", "0"}, {"fatherId", "flange[0]"}, {"ioLink", "ValveIO\\valve1"}});
  return text_of(document);
}

std::string start_program() {
  return program("start", {}, R"(begin
  if isPowered()==false
    enablePower()
    wait(isPowered())
  endIf
  call runPath()
end)");
}

std::string stop_program() {
  return program("stop", {}, R"(begin
  resetMotion()
end)");
}

std::string run_path_program() {
  return program("runPath", {{"l_i", "num"}, {"l_jHere", "jointRx"}}, R"(begin
  l_jHere=herej()
  if abs(l_jHere.j1-jPath[0].j1)>nTolerance or abs(l_jHere.j2-jPath[0].j2)>nTolerance or abs(l_jHere.j3-jPath[0].j3)>nTolerance or abs(l_jHere.j4-jPath[0].j4)>nTolerance or abs(l_jHere.j5-jPath[0].j5)>nTolerance or abs(l_jHere.j6-jPath[0].j6)>nTolerance
    popUpMsg("the arm does not stand where the path begins")
    return
  endIf
  for l_i=0 to nPoints-1
    if isInRange(jPath[l_i])==false
      popUpMsg("a point of the path is out of range")
      return
    endIf
  endFor
  for l_i=1 to nPoints-1
    if nPause[l_i]>0
      waitEndMove()
      delay(nPause[l_i])
    else
      movej(jPath[l_i],tHand,mMove[l_i])
    endIf
  endFor
  waitEndMove()
end)");
}

}  // namespace handway::export_val3
