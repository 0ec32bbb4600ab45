#include "val3_grammar.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace handway::test {
namespace {

/// Words that open a block, and those that close it.
const std::map<std::string, std::string, std::less<>> kBlocks = {
    {"begin", "end"}, {"if", "endIf"}, {"for", "endFor"}, {"while", "endWhile"}};

const std::set<std::string, std::less<>> kLanguage = {
    "else", "elseIf", "to", "step", "do", "until", "call", "return", "and", "or", "true", "false"};

/// Words of the library that six-axis applications use (VAL3 reference manual, chapters 3 to 8).
const std::set<std::string, std::less<>> kLibrary = {
    "abs",         "aioSet",   "close",     "delay",     "open",        "disablePower",
    "enablePower", "herej",    "isInRange", "isPowered", "movej",       "popUpMsg",
    "resetMotion", "stopMove", "wait",      "isSettled", "waitEndMove", "runPath"};

bool is_fields_name(const std::string& word) {
  return word.size() == 2 && word[0] == 'j' && word[1] >= '1' && word[1] <= '6';
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class Scan {
 public:
  Scan(const std::string& code, const std::set<std::string>& known) : known_(known) {
    std::istringstream lines(code);
    for (std::string line; std::getline(lines, line); ++line_) {
      scan(line);
    }
    for (const std::string& open : open_) {
      fault(open + " is not closed");
    }
  }

  std::vector<std::string> faults;

 private:
  void fault(const std::string& what) {
    faults.push_back("line " + std::to_string(line_) + ": " + what);
  }

  void scan(const std::string& line) {
    int round = 0;
    int square = 0;
    const std::size_t end_of_code = std::min(line.find("//"), line.size());
    for (std::size_t i = 0; i < end_of_code;) {
      const char c = line[i];
      if (c == '"') {
        const std::size_t end = line.find('"', i + 1);
        if (end == std::string::npos) {
          fault("a text without an end");
          return;
        }
        i = end + 1;
      } else if (is_word(c)) {
        const auto end = std::find_if_not(line.begin() + static_cast<long>(i), line.end(), is_word);
        const std::string word(line.begin() + static_cast<long>(i), end);
        take(word, i > 0 && line[i - 1] == '.');
        i += word.size();
      } else {
        round += c == '(' ? 1 : c == ')' ? -1 : 0;
        square += c == '[' ? 1 : c == ']' ? -1 : 0;
        if (std::string(" ()[]=<>!+-*/,.").find(c) == std::string::npos) {
          fault(std::string("unexpected ") + c);
        }
        ++i;
      }
    }
    if (round != 0 || square != 0) {
      fault("brackets that don't match");
    }
  }

  void take(const std::string& word, bool after_dot) {
    const auto closes = std::ranges::find(kBlocks, word, [](const auto& b) { return b.second; });
    if (kBlocks.contains(word)) {
      open_.push_back(word);
    } else if (closes != kBlocks.end()) {
      if (open_.empty() || open_.back() != closes->first) {
        fault(word + " closes nothing");
      } else {
        open_.pop_back();
      }
    } else if (std::isdigit(static_cast<unsigned char>(word[0])) == 0 &&
               !kLanguage.contains(word) && !kLibrary.contains(word) && !known_.contains(word) &&
               !(after_dot && is_fields_name(word))) {
      fault("unknown word " + word);
    }
  }

  const std::set<std::string>& known_;
  std::vector<std::string> open_;
  int line_ = 1;
};

}  // namespace

std::vector<std::string> val3_faults(const std::string& code, const std::set<std::string>& known) {
  return Scan(code, known).faults;
}

}  // namespace handway::test
