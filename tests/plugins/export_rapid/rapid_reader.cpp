#include "rapid_reader.h"

#include <regex>
#include <sstream>

namespace handway::test {
namespace {

const std::string kNumber = R"(-?\d+(?:\.\d+)?)";
const std::string kWord = "[A-Za-z][A-Za-z0-9_]{0,31}";

class Reader {
 public:
  RapidModule read(const std::string& text) {
    std::istringstream lines(text);
    std::string statement;
    for (std::string line; std::getline(lines, line);) {
      ++line_;
      const std::size_t begin = line.find_first_not_of(' ');
      if (begin == std::string::npos) {
        continue;
      }
      line = line.substr(begin);
      for (const char c : line) {
        if (c < ' ' || c > '~') {
          fault("a character that is not ASCII");
        }
      }
      if (line.starts_with("! ")) {
        module_.comments.push_back(line.substr(2));
        continue;
      }
      statement += (statement.empty() ? "" : " ") + line;
      if (statement.ends_with(" OR")) {
        continue;  // goes on in the next line
      }
      take(statement);
      statement.clear();
    }
    if (!open_.empty()) {
      fault(open_.back() + " is not closed");
    }
    return module_;
  }

 private:
  void fault(const std::string& what) {
    module_.faults.push_back("line " + std::to_string(line_) + ": " + what);
  }

  [[nodiscard]] bool matches(const std::string& line, const std::string& pattern) {
    return std::regex_match(line, match_, std::regex(pattern));
  }

  void close(const std::string& word) {
    if (open_.empty() || open_.back() != word) {
      fault("END" + word + " closes nothing");
    } else {
      open_.pop_back();
    }
  }

  void take(const std::string& line) {
    if (matches(line, "MODULE (" + kWord + ")") && open_.empty()) {
      module_.name = match_[1];
      open_.emplace_back("MODULE");
    } else if (matches(line, "PROC (" + kWord + R"()\(\))") && open_.size() == 1) {
      module_.procedure = match_[1];
      open_.emplace_back("PROC");
    } else if (matches(line, "END(MODULE|PROC|IF)")) {
      close(match_[1]);
    } else if (open_.size() == 1) {
      declaration(line);
    } else if (open_.size() > 1) {
      instruction(line);
    } else {
      fault("text outside of the module: " + line);
    }
  }

  void declaration(const std::string& line) {
    const std::string n = "(" + kNumber + ")";
    if (!module_.procedure.empty() ||
        !matches(line, "LOCAL CONST jointtarget (" + kWord + R"():=\[\[)" + n + "," + n + "," + n +
                           "," + n + "," + n + "," + n + R"(\],\[9E9(?:,9E9){5}\]\];)")) {
      fault("no declaration: " + line);
      return;
    }
    std::array<double, 6>& angles = module_.points[match_[1]];
    for (std::size_t j = 0; j < angles.size(); ++j) {
      angles[j] = std::stod(match_[j + 2]);
    }
  }

  void instruction(const std::string& line) {
    if (matches(line,
                "MoveAbsJ (" + kWord + R"()\\NoEOffs,v1000\\T:=()" + kNumber + "),fine,tool0;")) {
      if (!module_.points.contains(match_[1])) {
        fault("an unknown point " + match_[1].str());
        return;
      }
      module_.moves.push_back({module_.points[match_[1]], std::stod(match_[2])});
    } else if (matches(line, "WaitTime (" + kNumber + ");")) {
      module_.waited += std::stod(match_[1]);
    } else if (matches(line, "SetDO (" + kWord + "),([01]);")) {
      module_.outputs.push_back(match_[1].str() + " " + match_[2].str());
    } else if (matches(line, "SetAO (" + kWord + "),(" + kNumber + ");")) {
      module_.outputs.push_back(match_[1].str() + " " + match_[2].str());
    } else if (matches(line, R"re(IF Abs\([^()]*\)>0\.1( OR Abs\([^()]*\)>0\.1){5} THEN)re")) {
      open_.emplace_back("IF");
    } else if (line != "VAR jointtarget here;" && line != "here:=CJointT();" && line != "EXIT;" &&
               !matches(line, R"re(TPWrite "[^"]{0,80}";)re")) {
      fault("no instruction: " + line);
    }
  }

  RapidModule module_;
  std::vector<std::string> open_;
  std::smatch match_;
  int line_ = 0;
};

}  // namespace

RapidModule read_rapid(const std::string& text) { return Reader().read(text); }

}  // namespace handway::test
