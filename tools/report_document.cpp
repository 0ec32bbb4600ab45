#include "report_document.h"

#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/printable.h"

#include <fmt/format.h>

#include <cctype>
#include <cstddef>
#include <string_view>

namespace handway::tools {
namespace {

constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "table{border-collapse:collapse;margin:1rem 0;font-variant-numeric:tabular-nums}"
    "th,td{border-bottom:1px solid #ccc;padding:.25rem .7rem;text-align:right}"
    "th:first-child,td:first-child{text-align:left}"
    "th{border-bottom:2px solid #666}figure{margin:1rem 0}figcaption{color:#555}"
    "svg,img{max-width:100%;height:auto}";
constexpr const char* kDrawingStyle = "svg text{font:12px sans-serif;fill:#222}";

// Escapes text from files: neither HTML nor marks of Markdown.
std::string escaped(const std::string& text) {
  const std::string plain = geometric::printable(text);
  std::string result;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const char c = plain[i];
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      const bool ends_link = c == ']' && plain.substr(i + 1, 1) == "(";
      const bool is_mark = std::string_view("|*`\\").find(c) != std::string_view::npos;
      result += ends_link || is_mark ? "\\" : "";
      result += c == '\n' ? ' ' : c;
    }
  }
  return result;
}

// A file beside the report as the target of a link.
std::string link_target(const std::string& file) {
  std::string result;
  for (const char c : file) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                          std::string_view("-_./").find(c) != std::string_view::npos;
    result += is_plain
                  ? std::string(1, c)
                  : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return result;
}

std::string table_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    line += fmt::format(" {} |", escaped(cell));
  }
  return line + "\n";
}

struct MarkdownWriter {
  std::string operator()(const ReportHeading& heading) const {
    return fmt::format("{} {}\n\n", std::string(static_cast<std::size_t>(heading.level), '#'),
                       escaped(heading.text));
  }
  std::string operator()(const ReportText& text) const { return escaped(text.text) + "\n\n"; }
  std::string operator()(const ReportTable& table) const {
    std::string lines = table_row(table.columns) + "|";
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      lines += i == 0 ? " --- |" : " ---: |";
    }
    lines += "\n";
    for (const std::vector<std::string>& row : table.rows) {
      lines += table_row(row);
    }
    return lines + "\n";
  }
  std::string operator()(const ReportFigure& figure) const {
    const std::string caption = escaped(figure.caption);
    return fmt::format("![{}]({})\n\n{}: [{}]({})\n\n", caption, link_target(figure.file), caption,
                       escaped(figure.data_file), link_target(figure.data_file));
  }
  std::string operator()(const ReportPicture& picture) const {
    return fmt::format("![{}]({})\n\n", escaped(picture.caption), link_target(picture.file));
  }
};

std::string html_row(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) {
    row += fmt::format("<{}>{}</{}>", tag, html_escaped(cell), tag);
  }
  return row + "</tr>\n";
}

struct HtmlWriter {
  std::string operator()(const ReportHeading& heading) const {
    return fmt::format("<h{0}>{1}</h{0}>\n", heading.level, html_escaped(heading.text));
  }
  std::string operator()(const ReportText& text) const {
    return fmt::format("<p>{}</p>\n", html_escaped(text.text));
  }
  std::string operator()(const ReportTable& table) const {
    std::string html = "<table>\n" + html_row(table.columns, "th");
    for (const std::vector<std::string>& row : table.rows) {
      html += html_row(row, "td");
    }
    return html + "</table>\n";
  }
  std::string operator()(const ReportFigure& figure) const {
    return fmt::format("<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>\n", figure.svg,
                       html_escaped(figure.caption));
  }
  std::string operator()(const ReportPicture& picture) const {
    return fmt::format(
        "<figure>\n<img src=\"{}\" alt=\"{}\">\n<figcaption>{}</figcaption>\n</figure>\n",
        html_escaped(picture.file), html_escaped(picture.caption), html_escaped(picture.caption));
  }
};

std::string title_of(const ReportDocument& document) {
  const auto* heading = document.empty() ? nullptr : std::get_if<ReportHeading>(&document.front());
  return heading == nullptr ? "Report" : heading->text;
}

std::string csv_row(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    line += csv_field(cell) + ",";
  }
  if (!line.empty()) {
    line.back() = '\n';
  }
  return line;
}

}  // namespace

std::string to_markdown(const ReportDocument& document) {
  std::string text;
  for (const ReportPart& part : document) {
    text += std::visit(MarkdownWriter(), part);
  }
  text.resize(text.find_last_not_of('\n') + 1);
  return text + "\n";
}

std::string to_html(const ReportDocument& document) {
  std::string body;
  for (const ReportPart& part : document) {
    body += std::visit(HtmlWriter(), part);
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{}</title>\n"
      "<style>{}{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      html_escaped(title_of(document)), kStyle, kDrawingStyle, body);
}

std::string to_svg(const ReportFigure& figure) {
  const std::size_t content = figure.svg.find('>') + 1;
  return fmt::format("{}<style>{}</style><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>{}",
                     figure.svg.substr(0, content), kDrawingStyle, figure.svg.substr(content));
}

std::string html_escaped(const std::string& text) {
  std::string result;
  for (const char c : geometric::printable(text)) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result.push_back(c);
    }
  }
  return result;
}

namespace {

/// Returns whether a spreadsheet would take the text for a formula. A number may have a unit.
bool is_formula(const std::string& text) {
  if (text.size() < 2 || geometric::parse_number(text)) {
    return false;
  }
  const bool has_sign = text.front() == '+' || text.front() == '-';
  const bool is_operation = text.find_first_of("+*=|!@(\"'", 1) != std::string::npos;
  return text.front() == '=' || text.front() == '@' || text.front() == '\t' ||
         (has_sign && (is_operation || std::isalpha(static_cast<unsigned char>(text[1])) != 0));
}

}  // namespace

std::string csv_field(const std::string& written) {
  const std::string text = (is_formula(written) ? "'" : "") + geometric::printable(written);
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    return text;
  }
  std::string field = "\"";
  for (const char c : text) {
    field.append(c == '"' ? 2 : 1, c);
  }
  return field + "\"";
}

std::string to_csv(const ReportTable& table) {
  std::string csv = csv_row(table.columns);
  for (const std::vector<std::string>& row : table.rows) {
    csv += csv_row(row);
  }
  return csv;
}

}  // namespace handway::tools
