#include "handway/report/rendering/html.h"

#include "handway/report/document/escaping.h"
#include "handway/report/rendering/svg.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>

namespace handway::report {
namespace {

constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem;color:#222;"
    "background:#fff}"
    "table{border-collapse:collapse;margin:1rem 0;font-variant-numeric:tabular-nums}"
    "th,td{border-bottom:1px solid #ccc;padding:.25rem .7rem;text-align:right}"
    ".text{text-align:left;overflow-wrap:anywhere}"
    "th{border-bottom:2px solid #666}figure{margin:1rem 0}figcaption{color:#555}"
    "svg,img{max-width:100%;height:auto}";

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18U - 6U * k) & 63U];
    }
  }
  return text;
}

std::string heading_html(const Heading& heading) {
  return fmt::format("<h{0}>{1}</h{0}>\n", heading.level, html_escaped(heading.text));
}

std::string paragraph_html(const Paragraph& paragraph) {
  return fmt::format("<p>{}</p>\n", html_escaped(paragraph.text));
}

std::string cell_html(const Cell& cell) { return html_escaped(cell.text()); }

// For narrow tables: short intervals.
std::string narrow_cell_html(const Cell& cell) {
  std::string html = cell_html(cell);
  if (!cell.is_number()) {
    return html;
  }
  if (const std::size_t to = html.find(" to "); to != std::string::npos) {
    html.replace(to, 4, "–");
  }
  return html;
}

/// Attributes of cells, and their content.
struct TableStyle {
  const char* text;
  const char* number;
  const char* number_heading;
  std::string (*content)(const Cell& cell);
};

std::string rows_html(const Table& table, const TableStyle& style) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    html += fmt::format("<th{}>{}</th>", table.is_numeric(i) ? style.number_heading : style.text,
                        html_escaped(table.columns[i].heading()));
  }
  html += "</tr>\n";
  for (const std::vector<Cell>& row : table.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const Cell cell = i < row.size() ? row[i] : Cell();
      const bool is_number = cell.is_number() || table.is_numeric(i);
      html +=
          fmt::format("<td{}>{}</td>", is_number ? style.number : style.text, style.content(cell));
    }
    html += "</tr>\n";
  }
  return html;
}

constexpr TableStyle kPageTables = {" class=\"text\"", "", "", cell_html};
constexpr TableStyle kNarrowTables = {" align=\"left\"",
                                      " align=\"right\" style=\"white-space:nowrap\"",
                                      " align=\"right\"", narrow_cell_html};

class HtmlWriter {
 public:
  explicit HtmlWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::string operator()(const Heading& heading) const { return heading_html(heading); }
  std::string operator()(const Paragraph& paragraph) const { return paragraph_html(paragraph); }
  std::string operator()(const Table& table) const {
    return "<table>\n" + rows_html(table, kPageTables) + "</table>\n";
  }
  std::string operator()(const Figure& figure) const {
    return fmt::format("<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>\n", to_svg(figure),
                       html_escaped(figure.caption));
  }
  std::string operator()(const Picture& picture) const {
    const std::string caption = html_escaped(picture.caption);
    return fmt::format(
        "<figure>\n<img src=\"{}\" alt=\"{}\">\n<figcaption>{}</figcaption>\n</figure>\n",
        source(picture.file), caption, caption);
  }

 private:
  [[nodiscard]] std::string source(const std::string& file) const {
    if (!folder_.empty()) {
      std::ifstream in(folder_ / file, std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      if (!bytes.empty()) {
        return "data:image/png;base64," + base64(bytes);
      }
    }
    return link_target(file);
  }

  std::filesystem::path folder_;
};

struct RichTextWriter {
  std::string operator()(const Heading& heading) const {
    return fmt::format("<p><b>{}</b></p>\n", html_escaped(heading.text));
  }
  std::string operator()(const Paragraph& paragraph) const { return paragraph_html(paragraph); }
  std::string operator()(const Table& table) const {
    return "<table cellspacing=\"0\" cellpadding=\"2\">\n" + rows_html(table, kNarrowTables) +
           "</table>\n";
  }
  std::string operator()(const Figure& figure) const { return paragraph_html({figure.caption}); }
  std::string operator()(const Picture& picture) const { return paragraph_html({picture.caption}); }
};

std::string title_of(const Document& document) {
  const auto* heading = document.empty() ? nullptr : std::get_if<Heading>(&document.front());
  return heading == nullptr ? "Report" : heading->text;
}

}  // namespace

std::string to_html(const Document& document, const std::filesystem::path& folder) {
  std::string body;
  for (const Part& part : document) {
    body += std::visit(HtmlWriter(folder), part);
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      html_escaped(title_of(document)), kStyle, body);
}

std::string to_rich_text(const Document& document) {
  std::string text;
  for (const Part& part : document) {
    text += std::visit(RichTextWriter(), part);
  }
  return text;
}

}  // namespace handway::report
