#include "recordings/parquet_writer.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {
namespace {

std::string bytes_of(const std::vector<int>& values) {
  std::string bytes;
  for (const int value : values) {
    bytes += static_cast<char>(value);
  }
  return bytes;
}

// All bytes, by parquet.thrift and the compact protocol, computed by hand.
TEST(WrittenParquet, IsAsTheSpecificationSays) {
  ParquetWriter writer({{"a", ParquetType::kInt64}});
  writer.add_rows({Eigen::MatrixXd(Eigen::Vector2d(1, 2))});
  const std::string header = bytes_of({0x15, 0x00, 0x15, 0x2C, 0x15, 0x2C, 0x2C, 0x15, 0x04,  //
                                       0x15, 0x00, 0x15, 0x06, 0x15, 0x06, 0x00, 0x00});
  const std::string levels = bytes_of({2, 0, 0, 0, 0x04, 0x01});
  const std::string values = bytes_of({1, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0});
  const std::string schema = bytes_of({0x19, 0x2C, 0x48, 6}) + "schema" +
                             bytes_of({0x15, 0x02, 0x00,  //
                                       0x15, 0x04, 0x25, 0x02, 0x18, 1, 'a', 0x00});
  const std::string chunk =
      bytes_of({0x26, 0x00, 0x1C,                                           // ColumnChunk
                0x15, 0x04, 0x19, 0x25, 0x00, 0x06, 0x19, 0x18, 1,    'a',  // ColumnMetaData
                0x15, 0x00, 0x16, 0x04, 0x16, 0x4E, 0x16, 0x4E, 0x26, 0x08, 0x00, 0x00});
  const std::string footer = bytes_of({0x15, 0x02}) + schema +
                             bytes_of({0x16, 0x04, 0x19, 0x1C, 0x19, 0x1C}) + chunk +
                             bytes_of({0x16, 0x4E, 0x16, 0x04, 0x00, 0x00});
  ASSERT_EQ(footer.size(), 60U);
  EXPECT_EQ(writer.file(),
            "PAR1" + header + levels + values + footer + bytes_of({60, 0, 0, 0}) + "PAR1");
}

TEST(WrittenParquet, ListsHaveLevelsOfBothKinds) {
  ParquetWriter writer({{"q", ParquetType::kFloat, true}});
  writer.add_rows({Eigen::MatrixXd{{0.5, 1.0, -2.0}, {0.0, 0.25, 4.0}}});
  // Six values: repetitions 0 1 1 0 1 1 from the lowest bit, and six times the definition 3.
  const std::string levels = bytes_of({2, 0, 0, 0, 0x03, 0b00110110, 2, 0, 0, 0, 0x0C, 0x03});
  const std::string first = bytes_of({0, 0, 0, 0x3F});  // 0.5 in single precision
  EXPECT_NE(writer.file().find(levels + first), std::string::npos);
  EXPECT_EQ(writer.rows(), 2);
}

TEST(WrittenParquet, TextsHaveTheirSizes) {
  ParquetWriter writer({{"task", ParquetType::kByteArray}});
  writer.add_rows({std::vector<std::string>{"pick", ""}});
  const std::string file = writer.file({{"pandas", "{}"}});
  EXPECT_NE(file.find(bytes_of({4, 0, 0, 0}) + "pick" + bytes_of({0, 0, 0, 0})), std::string::npos);
  EXPECT_NE(file.find(bytes_of({0x19, 0x1C, 0x18, 6}) + "pandas" + bytes_of({0x18, 2}) + "{}"),
            std::string::npos);
}

TEST(WrittenParquet, RefusesValuesThatDoNotFit) {
  ParquetWriter writer({{"a", ParquetType::kInt64}, {"b", ParquetType::kDouble, true}});
  const Eigen::MatrixXd column = Eigen::MatrixXd::Zero(2, 1);
  EXPECT_THROW(writer.add_rows({column}), std::invalid_argument);
  EXPECT_THROW(writer.add_rows({column, Eigen::MatrixXd(3, 1)}), std::invalid_argument);
  EXPECT_THROW(writer.add_rows({column, Eigen::MatrixXd(2, 0)}), std::invalid_argument);
  EXPECT_THROW(writer.add_rows({Eigen::MatrixXd::Zero(2, 2), column}), std::invalid_argument);
  EXPECT_THROW(writer.add_rows({std::vector<std::string>{"x", "y"}, column}),
               std::invalid_argument);
  EXPECT_EQ(writer.rows(), 0);
}

}  // namespace
}  // namespace handway::device
