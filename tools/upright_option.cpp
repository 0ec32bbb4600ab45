#include "upright_option.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/nearest_name.h"
#include "handway/geometric/math/units.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace handway::tools {
namespace {

struct Upright {
  std::string body;  // names may hold colons
  double degrees;
};

std::optional<Upright> upright_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  double degrees = 0.0;
  const bool good = colon != std::string::npos && colon > 0 &&
                    CLI::detail::lexical_cast(text.substr(colon + 1), degrees) && degrees > 0.0 &&
                    degrees <= 180.0;
  return good ? std::optional(Upright{text.substr(0, colon), degrees}) : std::nullopt;
}

std::string unused_name(const geometric::Scene& scene, const std::string& name) {
  std::string unused = name;
  for (int number = 2;
       std::ranges::count(scene.constraints, unused, &geometric::PathConstraint::name) > 0;
       ++number) {
    unused = name + " " + std::to_string(number);
  }
  return unused;
}

}  // namespace

void add_upright_option(CLI::App& command, std::vector<std::string>& uprights) {
  command
      .add_option("--upright", uprights,
                  "Keep the z axis of a carried object or a link within DEGREES of the world's, "
                  "all along the path")
      ->type_name("OBJECT:DEGREES")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check([](const std::string& text) {
        return upright_of(text) ? std::string()
                                : "\"" + text +
                                      "\" is not OBJECT:DEGREES with an angle above 0 "
                                      "and up to 180 degrees";
      });
}

void add_uprights(const std::vector<std::string>& uprights, planning::LoadedScene& loaded) {
  if (uprights.empty()) {
    return;
  }
  geometric::Scene scene = *loaded.scene;
  const std::vector<std::string> bodies = constrainable_bodies(scene);
  for (const std::string& text : uprights) {
    const Upright upright = upright_of(text).value();
    if (std::ranges::count(bodies, upright.body) == 0) {
      throw geometric::InputError(
          {scene.file.string(), "--upright " + text,
           upright.body + (find_object(scene, upright.body) ? ", which is not attached to a link"
                                                            : ", which is not in the scene"),
           "an object on a link of " + scene.robots.front().name + ", or one of its links",
           geometric::advise_name(upright.body, bodies)});
    }
    geometric::OrientationConstraint what;
    what.angle = geometric::radians(upright.degrees);
    scene.constraints.push_back(
        {unused_name(scene, upright.body + " upright"), upright.body, what});
  }
  loaded.scene = std::make_shared<const geometric::Scene>(std::move(scene));
}

}  // namespace handway::tools
