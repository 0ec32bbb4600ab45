#include "handway/report/rendering/report_files.h"

#include "handway/geometric/io/replace_file.h"
#include "handway/report/rendering/html.h"
#include "handway/report/rendering/markdown.h"
#include "handway/report/rendering/svg.h"

#include <system_error>

namespace handway::report {

void write_report(const Document& document, const std::filesystem::path& folder) {
  for (const Part& part : document) {
    const auto* figure = std::get_if<Figure>(&part);
    if (figure != nullptr && !figure->file.empty()) {
      std::error_code ignored;  // the file can't be written then
      std::filesystem::create_directories((folder / figure->file).parent_path(), ignored);
      write_svg(*figure, folder / figure->file);
    }
  }
  geometric::replace_file(folder / "report.md", to_markdown(document));
  geometric::replace_file(folder / "report.html", to_html(document, folder));
}

void write_svg(const Figure& figure, const std::filesystem::path& file) {
  geometric::replace_file(file, to_svg(figure));
}

}  // namespace handway::report
