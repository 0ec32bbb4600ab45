#include "handway/geometric/scene/program.h"

namespace handway::geometric {

void rename_object(std::vector<Program>& programs, const std::string& name,
                   const std::string& new_name) {
  const auto rename = [&](std::string& object) {
    if (object == name) {
      object = new_name;
    }
  };
  for (Program& program : programs) {
    for (ProgramStep& step : program.steps) {
      if (auto* pick = std::get_if<PickStep>(&step)) {
        rename(pick->object);
      } else if (auto* place = std::get_if<PlaceStep>(&step)) {
        rename(place->support);
      }
    }
  }
}

}  // namespace handway::geometric
