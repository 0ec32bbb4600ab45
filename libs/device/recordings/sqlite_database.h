#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace handway::device {

/// A database of SQLite for reading, which may be damaged. Nothing is written beside it.
class SqliteDatabase {
 public:
  /// @throws InputError if it can't be opened.
  explicit SqliteDatabase(std::filesystem::path file);

  /// Returns whether a table (no view) with this name exists. @throws InputError
  [[nodiscard]] bool has_table(const std::string& name) const;

  [[noreturn]] void fail() const;

  /// Rows of a query, one after the other. @pre the database outlives it.
  class Rows {
   public:
    Rows(const SqliteDatabase& database, const std::string& query);

    void bind(int parameter, std::int64_t value);
    void bind(int parameter, const std::string& value);
    /// Steps to the next row; false at the end. @throws InputError if the database is damaged.
    [[nodiscard]] bool next();
    [[nodiscard]] std::int64_t whole(int column) const;
    /// Bytes of a text or a blob, valid until next().
    [[nodiscard]] std::string_view bytes(int column) const;

   private:
    const SqliteDatabase& database_;
    std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_;
  };

 private:
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> opened_;
};

}  // namespace handway::device
