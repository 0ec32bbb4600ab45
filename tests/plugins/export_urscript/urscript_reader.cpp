#include "urscript_reader.h"

#include <regex>
#include <sstream>

namespace handway::test {
namespace {

const std::string kNumber = R"(-?\d+(?:\.\d+)?)";
const std::string kList = R"(\[)" + kNumber + "(?:, " + kNumber + R"(){5}\])";
const std::string kWord = "[A-Za-z_][A-Za-z0-9_]*";
const std::string kValue = kWord + R"((?:\[)" + kWord + R"(\])?)";

std::array<double, 6> six(const std::string& list) {
  std::array<double, 6> values{};
  std::istringstream in(list.substr(1));
  for (double& value : values) {
    in >> value;
    in.ignore(1);
  }
  return values;
}

class Reader {
 public:
  UrProgram read(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      ++line_;
      for (const char c : line) {
        if (c < ' ' || c > '~') {
          fault("a character that is not ASCII");
        }
      }
      statement(line.substr(std::min(line.find_first_not_of(' '), line.size())));
    }
    if (depth_ != 0) {
      fault("blocks that are not closed");
    }
    return program_;
  }

 private:
  void fault(const std::string& what) {
    program_.faults.push_back("line " + std::to_string(line_) + ": " + what);
  }

  [[nodiscard]] bool matches(const std::string& line, const std::string& pattern) {
    return std::regex_match(line, match_, std::regex(pattern));
  }

  void statement(const std::string& line) {
    if (line.starts_with("# ")) {
      program_.comments.push_back(line.substr(2));
    } else if (matches(line, "def (" + kWord + R"()\(\):)")) {
      program_.name = match_[1];
      ++depth_;
    } else if (line == "end") {
      --depth_;
    } else if (depth_ == 0) {
      fault("a statement outside of the function: " + line);
    } else if (matches(line, "while i < 6:") ||
               matches(line,
                       R"(if norm\()" + kValue + " - " + kValue + R"(\) > )" + kNumber + ":")) {
      ++depth_;
    } else if (!is_call(line) && !is_assignment(line)) {
      fault("no statement: " + line);
    }
  }

  bool is_assignment(const std::string& line) {
    return matches(line, kWord + " = (" + kList + "|" + kNumber + "|i \\+ 1|" +
                             R"(get_actual_joint_positions\(\)))");
  }

  bool is_call(const std::string& line) {
    const std::string number = "(" + kNumber + ")";
    if (matches(line, R"(movej\(()" + kList + "), a=" + number + ", v=" + number + ", t=" + number +
                          R"(\))")) {
      program_.moves.push_back(
          {six(match_[1]), std::stod(match_[2]), std::stod(match_[3]), std::stod(match_[4])});
      return true;
    }
    if (matches(line, R"(servoj\(()" + kList + "), 0, 0, t=" + number +
                          ", lookahead_time=" + number + R"(, gain=(\d+)\))")) {
      // The manual's ranges: lookahead_time from 0.03 to 0.2, gain from 100 to 2000.
      const double lookahead = std::stod(match_[3]);
      const int gain = std::stoi(match_[4]);
      if (lookahead < 0.03 || lookahead > 0.2 || gain < 100 || gain > 2000) {
        fault("a parameter of servoj out of range");
      }
      program_.moves.push_back({six(match_[1]), 0.0, 0.0, std::stod(match_[2])});
      return true;
    }
    if (matches(line, R"(sleep\()" + number + R"(\))")) {
      program_.slept += std::stod(match_[1]);
      return true;
    }
    if (matches(line, R"(set_standard_digital_out\(([0-7]), (True|False)\))")) {
      program_.outputs.push_back(match_[1].str() + " " + match_[2].str());
      return true;
    }
    if (matches(line, R"(set_(tool|configurable)_digital_out\(([0-7]), (True|False)\))")) {
      program_.outputs.push_back(match_[1].str() + " " + match_[2].str() + " " + match_[3].str());
      return true;
    }
    if (matches(line, R"(set_standard_analog_out\(([01]), )" + number + R"(\))")) {
      program_.outputs.push_back("analog " + match_[1].str() + " " + match_[2].str());
      return true;
    }
    return line == "halt" || matches(line, R"(stopj\()" + number + R"(\))") ||
           matches(line, R"re(popup\("[^"]*", title="[^"]*", error=True, blocking=True\))re");
  }

  UrProgram program_;
  std::smatch match_;
  int line_ = 0;
  int depth_ = 0;
};

}  // namespace

UrProgram read_urscript(const std::string& text) { return Reader().read(text); }

}  // namespace handway::test
