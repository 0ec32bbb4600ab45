#include "handway/report/rendering/text.h"

#include "handway/geometric/io/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace handway::report {
namespace {

constexpr const char* kIndent = "  ";

// One line without control characters.
std::string plain(const std::string& text) {
  std::string line = geometric::printable(text);
  std::ranges::replace_if(
      line, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return line;
}

// Code points; each is one character wide on a terminal, except for some of East Asia.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

std::string text_of(const Table& table) {
  std::vector<TextTable::Layout> layout;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::size_t width = 0;
    for (const std::vector<Cell>& row : table.rows) {
      width = std::max(width, i < row.size() ? width_of(plain(row[i].text())) : 0);
    }
    layout.push_back({table.columns[i], width, table.is_numeric(i)});
  }
  const TextTable lines(std::move(layout));
  std::string text = kIndent;
  text += lines.header();
  for (const std::vector<Cell>& row : table.rows) {
    text += kIndent;
    text += lines.row(row);
  }
  return text;
}

struct TextWriter {
  std::string operator()(const Heading& heading) const { return plain(heading.text) + '\n'; }
  std::string operator()(const Paragraph& paragraph) const { return plain(paragraph.text) + '\n'; }
  std::string operator()(const Table& table) const { return text_of(table); }
  std::string operator()(const Figure& figure) const { return named(figure.caption, figure.file); }
  std::string operator()(const Picture& picture) const {
    return named(picture.caption, picture.file);
  }

  static std::string named(const std::string& caption, const std::string& file) {
    return file.empty() ? plain(caption) + '\n'
                        : fmt::format("{}: {}\n", plain(caption), plain(file));
  }
};

}  // namespace

TextTable::TextTable(std::vector<Layout> layout) : layout_(std::move(layout)) {
  for (Layout& column : layout_) {
    column.width = std::max(column.width, width_of(plain(column.column.heading())));
  }
}

std::string TextTable::line(const std::vector<std::string>& texts) const {
  std::string line;
  for (std::size_t i = 0; i < layout_.size(); ++i) {
    const std::string text = i < texts.size() ? plain(texts[i]) : std::string();
    const std::string space(layout_[i].width - std::min(layout_[i].width, width_of(text)), ' ');
    line += i == 0 ? "" : "  ";
    line += layout_[i].is_numeric ? space + text : text + space;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

std::string TextTable::header() const {
  std::vector<std::string> texts;
  texts.reserve(layout_.size());
  for (const Layout& column : layout_) {
    texts.push_back(column.column.heading());
  }
  return line(texts);
}

std::string TextTable::row(const std::vector<Cell>& cells) const {
  std::vector<std::string> texts;
  texts.reserve(cells.size());
  for (const Cell& cell : cells) {
    texts.push_back(cell.text());
  }
  return line(texts);
}

std::string to_text(const Document& document) {
  std::string text;
  for (const Part& part : document) {
    if (std::holds_alternative<Heading>(part) && !text.empty()) {
      text += '\n';
    }
    text += std::visit(TextWriter(), part);
  }
  return text;
}

}  // namespace handway::report
