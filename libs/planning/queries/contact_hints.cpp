#include "handway/planning/queries/contact_hints.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/collision_world.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace handway::planning {
namespace {

using geometric::Contact;
using geometric::Scene;
using geometric::SceneObject;

const SceneObject* object_of(const Scene& scene, const std::string& body) {
  return geometric::find_object(scene, body);
}

// Objects of which the robot is inside: nothing touches them any more if they are hollow.
std::vector<std::string> objects_around(const PlanningProblem& problem, const Configuration& q,
                                        const std::vector<Contact>& contacts) {
  auto hollow = std::make_shared<Scene>(*problem.scene);
  std::set<std::string> names;
  for (const Contact& contact : contacts) {
    for (const std::string& body : {contact.a, contact.b}) {
      const SceneObject* object = object_of(*problem.scene, body);
      if (object != nullptr && object->solid && !object->attachment) {
        names.insert(body);
      }
    }
  }
  for (SceneObject& object : hollow->objects) {
    object.solid = object.solid && !names.contains(object.name);
  }
  if (names.empty()) {
    return {};
  }
  const auto checker =
      geometric::make_collision_checker(std::make_shared<const geometric::CollisionWorld>(*hollow));
  for (const Contact& contact : geometric::find_contacts(*checker, q)) {
    names.erase(contact.a);
    names.erase(contact.b);
  }
  return {names.begin(), names.end()};
}

void add_hollow_hint(const std::vector<std::string>& around, std::vector<std::string>& hints) {
  if (!around.empty()) {
    const bool one = around.size() == 1;
    hints.push_back(fmt::format(
        "The robot is inside of {0}, which {1} taken for solid. If {2} hollow, as a cell or a room "
        "{1}, write `solid: false` at the object, or give --hollow {3}",
        fmt::join(around, ", "), one ? "is" : "are", one ? "it is" : "they are", around.front()));
  }
}

// By the carried object: the links of its own robot that it touches.
std::map<std::string, std::set<std::string>> touched_links(const PlanningProblem& problem,
                                                           const std::vector<Contact>& contacts) {
  std::map<std::string, std::set<std::string>> touched;
  for (const Contact& contact : contacts) {
    for (const auto& [body, other] :
         {std::pair(contact.a, contact.b), std::pair(contact.b, contact.a)}) {
      const SceneObject* object = object_of(*problem.scene, body);
      if (object != nullptr && object->attachment && problem.model().find_link(other)) {
        touched[body].insert(other);
      }
    }
  }
  return touched;
}

}  // namespace

std::vector<std::string> contact_hints(const PlanningProblem& problem, const Configuration& q,
                                       const std::vector<Contact>& contacts) {
  std::vector<std::string> hints;
  add_hollow_hint(objects_around(problem, q, contacts), hints);
  for (const auto& [object, links] : touched_links(problem, contacts)) {
    hints.push_back(fmt::format(
        "{} is carried by {}. If {} may touch it, as what holds it, add {} to its `touch_links` "
        "(MoveIt) or `touching` (a scene of Handway)",
        object, object_of(*problem.scene, object)->attachment->link, fmt::join(links, ", "),
        links.size() == 1 ? "the link" : "the links"));
  }
  return hints;
}

}  // namespace handway::planning
