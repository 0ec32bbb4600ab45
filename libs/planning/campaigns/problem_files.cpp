#include "campaigns/problem_files.h"

#include "handway/geometric/io/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;
using geometric::YamlElement;

// What a problem's name stands for, or why there is no such file.
struct Found {
  fs::path file;
  std::string fault;
  std::string advice;
};

Found with_environment(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find("${", at);
    result += text.substr(at, begin - at);
    if (begin == std::string::npos) {
      break;
    }
    const std::size_t end = text.find('}', begin);
    if (end == std::string::npos) {
      return {{}, fmt::format("\"{}\", a \"${{\" without \"}}\"", text), ""};
    }
    const std::string name = text.substr(begin + 2, end - begin - 2);
    const char* value = std::getenv(name.c_str());
    if (value == nullptr) {
      return {{}, fmt::format("${{{}}}, which is not set", name), "Set the variable " + name};
    }
    result += value;
    at = end + 1;
  }
  return {result, "", ""};
}

Found find_problem(const std::string& text, const fs::path& folder) {
  Found named = with_environment(text);
  if (!named.fault.empty()) {
    return named;
  }
  const fs::path scenes = geometric::resource_dir().parent_path() / "scenes";
  std::error_code error;
  for (const fs::path& file :
       {folder / named.file, scenes / named.file, scenes / (named.file.string() + ".yaml")}) {
    if (fs::is_regular_file(file, error)) {
      return {fs::absolute(file).lexically_normal(), "", ""};
    }
  }
  return {{},
          fmt::format("\"{}\", which is no file", named.file.string()),
          fmt::format("Looked in {} and {}", folder.string(), scenes.string())};
}

bool is_optional(const YamlElement& problem) {
  const std::optional<YamlElement> flag = problem.find("optional");
  return flag && flag->flag();
}

}  // namespace

std::vector<CampaignProblem> campaign_problems(const YamlElement& list, const fs::path& folder) {
  std::vector<CampaignProblem> problems;
  for (const YamlElement& item : list.items()) {
    const bool is_map = item.is_map();
    if (is_map) {
      item.allow_keys({"name", "file", "optional"});
    }
    const YamlElement file = is_map ? item.need("file") : item;
    const Found found = find_problem(file.text(), folder);
    if (!found.fault.empty()) {
      if (is_map && is_optional(item)) {
        continue;
      }
      file.refuse(found.fault, "a scene or problem file", found.advice);
    }
    const std::optional<YamlElement> own_name = is_map ? item.find("name") : std::nullopt;
    const std::string name = own_name ? own_name->text() : found.file.stem().string();
    if (std::ranges::count(problems, name, &CampaignProblem::name) != 0) {
      item.refuse(fmt::format("a second problem called \"{}\"", name), "names that differ",
                  "Give it a \"name\" of its own");
    }
    problems.push_back({name, found.file});
  }
  if (problems.empty()) {
    list.refuse("no problem that is there", "at least one");
  }
  return problems;
}

}  // namespace handway::planning
