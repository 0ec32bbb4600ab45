#include "handway/report/rendering/markdown.h"

#include "handway/report/document/escaping.h"

#include <fmt/format.h>

#include <cstddef>

namespace handway::report {
namespace {

struct MarkdownWriter {
  std::string operator()(const Heading& heading) const {
    return fmt::format("{} {}\n\n", std::string(static_cast<std::size_t>(heading.level), '#'),
                       markdown_escaped(heading.text));
  }
  std::string operator()(const Paragraph& paragraph) const {
    return markdown_escaped(paragraph.text) + "\n\n";
  }
  std::string operator()(const Table& table) const {
    std::string head = "|";
    std::string alignment = "|";
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      head += fmt::format(" {} |", markdown_escaped(table.columns[i].heading()));
      alignment += table.is_numeric(i) ? " ---: |" : " --- |";
    }
    std::string lines = head + '\n' + alignment + '\n';
    for (const std::vector<Cell>& row : table.rows) {
      lines += '|';
      for (std::size_t i = 0; i < table.columns.size(); ++i) {
        lines += fmt::format(" {} |", i < row.size() ? markdown_escaped(row[i].text()) : "");
      }
      lines += '\n';
    }
    return lines + '\n';
  }
  std::string operator()(const Figure& figure) const {
    const std::string caption = markdown_escaped(figure.caption);
    std::string text = figure.file.empty() ? caption + "\n\n" : picture(caption, figure.file);
    if (!figure.data_file.empty()) {
      text += fmt::format("{}: [{}]({})\n\n", caption, markdown_escaped(figure.data_file),
                          link_target(figure.data_file));
    }
    return text;
  }
  std::string operator()(const Picture& shown) const {
    return picture(markdown_escaped(shown.caption), shown.file);
  }

  static std::string picture(const std::string& caption, const std::string& file) {
    return fmt::format("![{}]({})\n\n", caption, link_target(file));
  }
};

}  // namespace

std::string to_markdown(const Document& document) {
  std::string text;
  for (const Part& part : document) {
    text += std::visit(MarkdownWriter(), part);
  }
  text.resize(text.find_last_not_of('\n') + 1);
  return text + '\n';
}

}  // namespace handway::report
