#include "handway/planning/queries/collision_remedy.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/collision_world.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace handway::planning {
namespace {

using geometric::Contact;
using geometric::Scene;
using geometric::SceneObject;

using Kind = CollisionRemedy::Kind;

// Calls `visit(object, other)` for each object of a contact, with the other body's name.
template <typename Visit>
void for_each_object(const Scene& scene, const std::vector<Contact>& contacts, const Visit& visit) {
  for (const Contact& contact : contacts) {
    for (const auto& [body, other] :
         {std::pair(contact.a, contact.b), std::pair(contact.b, contact.a)}) {
      if (const SceneObject* object = geometric::find_object(scene, body)) {
        visit(*object, other);
      }
    }
  }
}

// The objects of which the robot is inside: nothing touches them any more if they are hollow.
std::vector<std::string> objects_around(const PlanningProblem& problem, const Configuration& q,
                                        const std::vector<Contact>& contacts) {
  std::set<std::string> names;
  for_each_object(*problem.scene, contacts, [&](const SceneObject& object, const std::string&) {
    if (object.solid && !object.attachment) {
      names.insert(object.name);
    }
  });
  if (names.empty()) {
    return {};
  }
  const Scene hollow = remedied(*problem.scene, {Kind::kHollow, {names.begin(), names.end()}, {}});
  const auto checker =
      geometric::make_collision_checker(std::make_shared<const geometric::CollisionWorld>(hollow));
  for (const Contact& contact : geometric::find_contacts(*checker, q)) {
    names.erase(contact.a);
    names.erase(contact.b);
  }
  return {names.begin(), names.end()};
}

// The links of its own robot that each attached object touches.
std::map<std::string, std::set<std::string>> touched_links(const PlanningProblem& problem,
                                                           const std::vector<Contact>& contacts) {
  std::map<std::string, std::set<std::string>> touched;
  for_each_object(*problem.scene, contacts,
                  [&](const SceneObject& object, const std::string& other) {
                    if (object.attachment && problem.model().find_link(other)) {
                      touched[object.name].insert(other);
                    }
                  });
  return touched;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

std::vector<CollisionRemedy> find_remedies(const PlanningProblem& problem, const Configuration& q,
                                           const std::vector<Contact>& contacts) {
  std::vector<CollisionRemedy> remedies;
  if (auto around = objects_around(problem, q, contacts); !around.empty()) {
    remedies.push_back({Kind::kHollow, std::move(around), {}});
  }
  for (const auto& [object, links] : touched_links(problem, contacts)) {
    remedies.push_back({Kind::kTouchLinks, {object}, {links.begin(), links.end()}});
  }
  return remedies;
}

Scene remedied(const Scene& scene, const CollisionRemedy& remedy) {
  Scene mended = scene;
  for (SceneObject& object : mended.objects) {
    if (!has(remedy.objects, object.name)) {
      continue;
    }
    if (remedy.kind == Kind::kHollow) {
      object.solid = false;
    } else if (object.attachment) {
      std::vector<std::string>& touching = object.attachment->touching;
      std::ranges::copy_if(remedy.links, std::back_inserter(touching),
                           [&](const std::string& link) { return !has(touching, link); });
    }
  }
  return mended;
}

std::string describe_remedy(const Scene& scene, const CollisionRemedy& remedy) {
  if (remedy.kind == Kind::kHollow) {
    const bool one = remedy.objects.size() == 1;
    return fmt::format(
        "The robot is inside of {0}, which {1} solid. If {2} hollow, such as a cell or a room, "
        "write `solid: false` at the object, or use --hollow {3}",
        fmt::join(remedy.objects, ", "), one ? "is" : "are", one ? "it is" : "they are",
        remedy.objects.front());
  }
  const std::string& object = remedy.objects.front();
  return fmt::format(
      "{} is attached to {}. If {} may touch it, add {} to its `touch_links` (MoveIt) or "
      "`touching` (Handway scene)",
      object, geometric::find_object(scene, object)->attachment->link,
      fmt::join(remedy.links, ", "), remedy.links.size() == 1 ? "the link" : "the links");
}

}  // namespace handway::planning
