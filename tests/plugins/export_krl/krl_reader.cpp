#include "krl_reader.h"

#include <regex>
#include <sstream>

namespace handway::test {
namespace {

const std::string kNumber = R"(-?\d+(?:\.\d+)?)";
const std::string kWord = "[A-Za-z$_][A-Za-z0-9$_]{0,23}";

class Reader {
 public:
  KrlProgram read(const std::string& source, const std::string& data) {
    lines_of(data, [this](const std::string& line) { take_data(line); });
    lines_of(source, [this](const std::string& line) { take_source(line); });
    return program_;
  }

 private:
  template <typename Take>
  void lines_of(const std::string& text, const Take& take) {
    std::istringstream lines(text);
    line_ = 0;
    for (std::string line; std::getline(lines, line);) {
      ++line_;
      for (const char c : line) {
        if (c < ' ' || c > '~') {
          fault("a character that is not ASCII");
        }
      }
      const std::size_t begin = line.find_first_not_of(' ');
      if (begin != std::string::npos && !line.starts_with('&')) {
        take(line.substr(begin));
      }
    }
    if (!open_.empty()) {
      fault(open_.back() + " is not closed");
    }
  }

  void fault(const std::string& what) {
    program_.faults.push_back("line " + std::to_string(line_) + ": " + what);
  }

  [[nodiscard]] bool matches(const std::string& line, const std::string& pattern) {
    return std::regex_match(line, match_, std::regex(pattern));
  }

  void close(const std::string& word) {
    if (open_.empty() || open_.back() != word) {
      fault(word + " closes nothing");
    } else {
      open_.pop_back();
    }
  }

  void take_data(const std::string& line) {
    const std::string n = " (" + kNumber + ")";
    if (matches(line, "DEFDAT (" + kWord + ")")) {
      program_.name = match_[1];
      open_.emplace_back("ENDDAT");
    } else if (line == "ENDDAT") {
      close(line);
    } else if (matches(line, "DECL AXIS (" + kWord + R"()=\{A1)" + n + ",A2" + n + ",A3" + n +
                                 ",A4" + n + ",A5" + n + ",A6" + n + R"(\})")) {
      std::array<double, 6>& angles = program_.points[match_[1]];
      for (std::size_t j = 0; j < angles.size(); ++j) {
        angles[j] = std::stod(match_[j + 2]);
      }
    } else if (line != "EXT BAS(BAS_COMMAND:IN,REAL:IN)") {
      fault("no declaration: " + line);
    }
  }

  void take_source(const std::string& line) {
    if (line.starts_with("; ")) {
      program_.comments.push_back(line.substr(2));
    } else if (matches(line, "DEF (" + kWord + R"()\((?:\w+:IN(?:,\w+:IN)*)?\))") &&
               open_.empty()) {
      if (++programs_ == 1 && match_[1] != program_.name) {
        fault("another name than in the data list");
      }
      open_.emplace_back("END");
    } else if (matches(line, "END|ENDIF|ENDFOR")) {
      close(line);
    } else if (open_.empty()) {
      fault("text outside of a program: " + line);
    } else if (matches(line, "IF (.*) THEN")) {
      condition(match_[1]);
      open_.emplace_back("ENDIF");
    } else if (matches(line, "FOR " + kWord + "=1 TO 6")) {
      open_.emplace_back("ENDFOR");
    } else if (!is_instruction(line)) {
      fault("no instruction: " + line);
    }
  }

  void condition(const std::string& text) {
    const std::regex part(R"(\(ABS\(\$AXIS_ACT\.A([1-6])-XP0\.A\1\)>0\.1\))");
    const std::string rest = std::regex_replace(text, part, "x");
    if (rest != "x OR x OR x OR x OR x OR x") {
      fault("no condition: " + text);
    }
  }

  bool is_instruction(const std::string& line) {
    if (matches(line, R"(HW_RATES\((\d+),(\d+)\))")) {
      velocity_ = std::stoi(match_[1]);
      acceleration_ = std::stoi(match_[2]);
      if (velocity_ < 1 || velocity_ > 100 || acceleration_ < 1 || acceleration_ > 100) {
        fault("a rate that is not from 1 to 100 %");
      }
      return true;
    }
    if (matches(line, "PTP (" + kWord + ")")) {
      if (!program_.points.contains(match_[1])) {
        fault("an unknown point " + match_[1].str());
      }
      program_.moves.push_back({program_.points[match_[1]], velocity_, acceleration_, 0.0});
      return true;
    }
    if (matches(line, "WAIT SEC (" + kNumber + ")") && !program_.moves.empty()) {
      program_.moves.back().pause += std::stod(match_[1]);
      return true;
    }
    if (matches(line, R"(\$OUT\[(\d+)\]=(TRUE|FALSE))")) {
      program_.outputs.push_back(match_[1].str() + " " + match_[2].str());
      return true;
    }
    if (matches(line, R"(\$ANOUT\[(\d+)\]=)" + ("(" + kNumber + ")"))) {
      program_.outputs.push_back("analog " + match_[1].str() + " " + match_[2].str());
      return true;
    }
    return line == "HALT" || line == "RETURN" || line == "BAS(#INITMOV,0)" ||
           line == "DECL INT V,A,I" || line == "$VEL_AXIS[I]=V" || line == "$ACC_AXIS[I]=A";
  }

  KrlProgram program_;
  std::vector<std::string> open_;
  std::smatch match_;
  int line_ = 0;
  int programs_ = 0;
  int velocity_ = 100;
  int acceleration_ = 100;
};

}  // namespace

KrlProgram read_krl(const std::string& source, const std::string& data) {
  return Reader().read(source, data);
}

}  // namespace handway::test
