#include "recordings/parquet_metadata.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/printable.h"
#include "recordings/thrift_reader.h"

#include <fmt/format.h>

#include <limits>
#include <optional>

namespace handway::device {
namespace {

using geometric::InputError;
using Type = ThriftReader::Type;

constexpr unsigned kDeepestSchema = 32;
constexpr std::size_t kMostElements = 1'000'000;  // columns, groups of rows, and their chunks

[[noreturn]] void refuse_metadata(const std::string& source, const std::string& found) {
  throw InputError(
      {source, "metadata", found, "the metadata of a Parquet file", "Copy the file again."});
}

/// An integer that is not negative. @throws InputError
std::uint64_t natural(ThriftReader& reader, Type type, const std::string& source) {
  const std::int64_t number = reader.integer(type);
  if (number < 0) {
    refuse_metadata(source, fmt::format("the size or number {}", number));
  }
  return static_cast<std::uint64_t>(number);
}

/// An element of the schema; they are in depth-first order.
struct SchemaElement {
  std::optional<std::int64_t> type;
  std::int64_t repetition = 0;
  std::string name;
  std::uint64_t children = 0;
  std::int64_t converted_type = -1;
};

SchemaElement read_schema_element(ThriftReader& reader, const std::string& source) {
  SchemaElement element;
  reader.structure([&](std::int64_t number, Type type) {
    switch (number) {
      case 1:
        element.type = reader.integer(type);
        return true;
      case 3:
        element.repetition = reader.integer(type);
        return true;
      case 4:
        element.name = geometric::printable(reader.binary(type));
        return true;
      case 5:
        element.children = natural(reader, type, source);
        return true;
      case 6:
        element.converted_type = reader.integer(type);
        return true;
      default:
        return false;
    }
  });
  return element;
}

/// Makes columns of the elements of a schema.
class SchemaTree {
 public:
  SchemaTree(const std::vector<SchemaElement>& elements, const std::string& source)
      : elements_(elements), source_(source) {}

  std::vector<ParquetColumn> columns() {
    std::vector<ParquetColumn> columns;
    const std::uint64_t fields = next().children;
    for (std::uint64_t i = 0; i < fields; ++i) {
      ParquetColumn& column = columns.emplace_back();
      column.leaf = leaves_;
      add(column, 0);
      if (leaves_ != column.leaf + 1) {
        column.type = ParquetType::kByteArray;
        column.problem = "structures";
      }
    }
    if (at_ != elements_.size()) {
      refuse_metadata(source_, "a schema with elements that belong to no column");
    }
    return columns;
  }
  [[nodiscard]] std::size_t leaves() const { return leaves_; }

 private:
  const SchemaElement& next() {
    if (at_ == elements_.size()) {
      refuse_metadata(source_, "a schema with too few elements");
    }
    return elements_[at_++];
  }

  // Levels count the elements above that may be missing or repeated.
  void add(ParquetColumn& column, unsigned depth) {
    constexpr std::int64_t kOptional = 1;
    constexpr std::int64_t kRepeated = 2;
    const SchemaElement& element = next();
    if (depth == kDeepestSchema || element.repetition < 0 || element.repetition > kRepeated) {
      refuse_metadata(source_, "a schema with an element of unknown kind");
    }
    column.name = depth == 0 ? element.name : column.name;
    column.most_definition += element.repetition >= kOptional ? 1 : 0;
    if (element.repetition == kRepeated) {
      ++column.most_repetition;
      column.element_definition = column.most_definition;
    }
    if (element.type) {
      set_type(column, element);
      ++leaves_;
      return;
    }
    for (std::uint64_t i = 0; i < element.children; ++i) {
      ParquetColumn path = column;
      add(path, depth + 1);
      if (i == 0) {
        column = path;
      }
    }
  }

  void set_type(ParquetColumn& column, const SchemaElement& element) const {
    constexpr std::int64_t kDecimal = 5;
    constexpr std::int64_t kUnsigned32 = 13;
    constexpr std::int64_t kUnsigned64 = 14;
    if (*element.type < 0 || *element.type > 7) {
      refuse_metadata(source_, fmt::format("values of type {}", *element.type));
    }
    column.type = static_cast<ParquetType>(*element.type);
    column.is_unsigned =
        element.converted_type == kUnsigned32 || element.converted_type == kUnsigned64;
    if (column.type == ParquetType::kByteArray ||
        column.type == ParquetType::kFixedLengthByteArray) {
      column.problem = "texts or bytes";
    } else if (column.type == ParquetType::kInt96) {
      column.problem = "integers of 96 bits";
    } else if (element.converted_type == kDecimal) {
      column.problem = "decimal numbers";
    }
  }

  const std::vector<SchemaElement>& elements_;
  const std::string& source_;
  std::size_t at_ = 0;
  std::size_t leaves_ = 0;
};

/// Reads ColumnMetaData.
void read_chunk_metadata(ThriftReader& reader, ParquetChunk& chunk, const std::string& source) {
  std::uint64_t dictionary = 0;
  reader.structure([&](std::int64_t number, Type type) {
    switch (number) {
      case 4:
        chunk.codec = reader.integer(type);
        return true;
      case 5:
        chunk.values = natural(reader, type, source);
        return true;
      case 7:
        chunk.size = natural(reader, type, source);
        return true;
      case 9:
        chunk.offset = natural(reader, type, source);
        return true;
      case 11:
        dictionary = natural(reader, type, source);
        return true;
      default:
        return false;
    }
  });
  if (dictionary > 0 && dictionary < chunk.offset) {
    chunk.offset = dictionary;
  }
}

/// Reads ColumnChunk.
ParquetChunk read_chunk(ThriftReader& reader, const std::string& source) {
  ParquetChunk chunk;
  bool has_metadata = false;
  reader.structure([&](std::int64_t number, Type type) {
    if (number == 3 && type == Type::kStruct) {
      read_chunk_metadata(reader, chunk, source);
      has_metadata = true;
      return true;
    }
    if (number == 1) {
      chunk.problem = "values in another file";
    } else if (number == 8 || number == 9) {
      chunk.problem = "encrypted values";
    }
    return false;
  });
  if (!has_metadata && chunk.problem.empty()) {
    chunk.problem = "no metadata of its pages";
  }
  return chunk;
}

/// Counts an element. @throws InputError if there are too many.
void count_element(std::size_t& count, const std::string& source) {
  if (++count > kMostElements) {
    refuse_metadata(source, fmt::format("more than {} columns and groups of rows", kMostElements));
  }
}

/// Reads RowGroup. @param count of all elements so far.
ParquetRowGroup read_row_group(ThriftReader& reader, std::size_t& count,
                               const std::string& source) {
  ParquetRowGroup group;
  reader.structure([&](std::int64_t number, Type type) {
    if (number == 1) {
      reader.list(type, [&](Type /*element*/) {
        count_element(count, source);
        group.chunks.push_back(read_chunk(reader, source));
      });
      return true;
    }
    if (number == 3) {
      group.rows = natural(reader, type, source);
      return true;
    }
    return false;
  });
  return group;
}

/// Reads DataPageHeader, DictionaryPageHeader or DataPageHeaderV2, which begin alike.
void read_kind_of_page(ThriftReader& reader, ParquetPageHeader& page, const std::string& source) {
  const bool is_second = page.kind == ParquetPageKind::kData2;
  reader.structure([&](std::int64_t number, Type type) {
    if (number == 1) {
      page.values = natural(reader, type, source);
    } else if (number == (is_second ? 4 : 2)) {
      page.encoding = reader.integer(type);
    } else if (page.kind == ParquetPageKind::kData && number == 3) {
      page.definition_encoding = reader.integer(type);
    } else if (page.kind == ParquetPageKind::kData && number == 4) {
      page.repetition_encoding = reader.integer(type);
    } else if (is_second && number == 5) {
      page.definition_size = natural(reader, type, source);
    } else if (is_second && number == 6) {
      page.repetition_size = natural(reader, type, source);
    } else if (is_second && number == 7) {
      page.is_compressed = reader.integer(type) != 0;
    } else {
      return false;
    }
    return true;
  });
}

/// The number of the field of a page's header that describes pages of a kind.
std::int64_t field_of_kind(ParquetPageKind kind) { return 5 + static_cast<std::int64_t>(kind); }

}  // namespace

std::string ParquetColumn::type_name() const {
  switch (type) {
    case ParquetType::kBoolean:
      return "bool";
    case ParquetType::kInt32:
      return is_unsigned ? "uint32" : "int32";
    case ParquetType::kInt64:
      return is_unsigned ? "uint64" : "int64";
    case ParquetType::kInt96:
      return "int96";
    case ParquetType::kFloat:
      return "float32";
    case ParquetType::kDouble:
      return "float64";
    default:
      return problem == "structures" ? "structure" : "bytes";
  }
}

ParquetMetadata parse_parquet_metadata(std::string_view bytes, const std::string& source) {
  ThriftReader reader(bytes, source);
  ParquetMetadata metadata;
  std::vector<SchemaElement> elements;
  std::size_t count = 0;
  std::uint64_t rows = 0;
  reader.structure([&](std::int64_t number, Type type) {
    switch (number) {
      case 2:
        reader.list(type, [&](Type /*element*/) {
          count_element(count, source);
          elements.push_back(read_schema_element(reader, source));
        });
        return true;
      case 3:
        rows = natural(reader, type, source);
        return true;
      case 4:
        reader.list(type, [&](Type /*element*/) {
          count_element(count, source);
          metadata.groups.push_back(read_row_group(reader, count, source));
        });
        return true;
      default:
        return false;
    }
  });
  SchemaTree tree(elements, source);
  metadata.columns = tree.columns();
  for (const ParquetRowGroup& group : metadata.groups) {
    if (group.chunks.size() != tree.leaves()) {
      refuse_metadata(source, fmt::format("a group of rows with {} of {} columns",
                                          group.chunks.size(), tree.leaves()));
    }
    // The sum may not wrap around.
    if (group.rows > rows - metadata.rows) {
      refuse_metadata(source, fmt::format("groups with more than {} rows", rows));
    }
    metadata.rows += group.rows;
  }
  if (metadata.rows != rows) {
    refuse_metadata(source, fmt::format("groups with {} of {} rows", metadata.rows, rows));
  }
  return metadata;
}

ParquetPageHeader parse_parquet_page(std::string_view bytes, const std::string& source) {
  ThriftReader reader(bytes, source);
  ParquetPageHeader page;
  bool is_described = false;
  reader.structure([&](std::int64_t number, Type type) {
    if (number == 1) {
      const std::uint64_t kind = natural(reader, type, source);
      if (kind > static_cast<std::uint64_t>(ParquetPageKind::kData2)) {
        refuse_metadata(source, fmt::format("a page of kind {}", kind));
      }
      page.kind = static_cast<ParquetPageKind>(kind);
    } else if (number == 2) {
      page.size = natural(reader, type, source);
    } else if (number == 3) {
      page.compressed_size = natural(reader, type, source);
    } else if (number == field_of_kind(page.kind) && type == Type::kStruct) {
      read_kind_of_page(reader, page, source);
      is_described = true;
    } else {
      return false;
    }
    return true;
  });
  if (!is_described) {
    refuse_metadata(source, "a page without a header of its kind");
  }
  page.header_size = reader.position();
  return page;
}

}  // namespace handway::device
