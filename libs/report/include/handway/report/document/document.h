#pragma once

#include "handway/report/document/figure.h"
#include "handway/report/document/table.h"

#include <string>
#include <variant>
#include <vector>

namespace handway::report {

/// Heading of a document.
struct Heading {
  int level = 2;  ///< 1: the title.
  std::string text;
};

/// Plain text.
struct Paragraph {
  std::string text;
};

using Part = std::variant<Heading, Paragraph, Table, Figure, Picture>;  ///< Part of a document.

/// A report as data: `rendering/` writes it as plain text, Markdown and HTML.
using Document = std::vector<Part>;

}  // namespace handway::report
