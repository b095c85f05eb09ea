// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of fields: every key that a kind of file may have, with its kind, unit, range, words, default and meaning. Reading,
/// checking, suggestions, JSON Schema and manual all use the table. Each module defines the tables of its own files.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop::input {

enum class FieldKind {
  object,
  object_or_word,
  flag_or_object,  ///< true, false, one of `words`, or an object
  list,            ///< a list of objects
  text,            ///< any string
  name,            ///< [a-z0-9][a-z0-9-]{0,63}
  word,            ///< one of `words`
  flag,            ///< true or false
  number,
  number_or_vector3,  ///< one number, or three of them
  vector2,            ///< two numbers
  vector3,            ///< three numbers
  matrix3,            ///< three rows of three numbers
  numbers,            ///< one to four numbers
  series,             ///< at least one number, and a thousand at most
  points,             ///< rows of three numbers, as many
  changes,            ///< "/json/pointer=value", any number of them
  anything,           ///< any JSON, which the decoder checks
};

/// The most numbers of a series, and rows of points.
inline constexpr std::size_t kLongestSeries = 1000;

struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_excluded = false;
  bool contains(double x) const { return (least_excluded ? x > least : x >= least) && x <= most; }
};

struct Field {
  std::string_view pointer;  ///< `*` stands for any index of a list
  FieldKind kind;
  std::string_view unit;      ///< unit of the numbers; empty if there is none
  Range range;                ///< range of a number, or of every number of a vector or matrix
  std::string_view words;     ///< allowed words, separated by '|'
  std::string_view fallback;  ///< default as JSON; empty if there is none or it is computed
  std::string_view doc;
  bool required = false;         ///< required wherever its parent is given; the decoder checks rules with several keys
  std::string_view reason = "";  ///< reason for the range's limits, shown if a value is outside
  /// Beginning of the message for a key that this object does not have.
  std::string_view unknown = "unknown key";
  bool describes_only = false;  ///< whether no result depends on it or on its members

  std::string_view key() const { return pointer.substr(pointer.rfind('/') + 1); }
  std::string_view parent() const { return pointer.substr(0, pointer.rfind('/')); }
};

/// A wish that a kind of file does not meet: the answer to an unknown key that has one of the words.
struct Wish {
  std::string_view words;     ///< separated by '|'; one of several parts, "time_offset", must be in the key as a whole
  std::string_view sentence;  ///< what there is not, and what to use instead
};

/// The fields of one kind of file.
struct FieldTable {
  std::string_view name;  ///< name of the format: "study" in earthtop-study-1.json
  std::string_view noun;  ///< what a message calls such a file: "mapping file"
  std::span<const Field> fields;
  std::span<const Wish> wishes = {};

  /// Returns the field with this pointer pattern; null if there is none.
  const Field* find(std::string_view pattern) const;
  /// Returns the keys of an object, in the table's order. @param pattern  pattern of the object, empty for the whole file
  std::vector<std::string_view> keys_below(std::string_view pattern) const;
  /// Returns the wish that a key in lower case expresses: the word, or its plural, is one of the key's. Null if there is none.
  const Wish* wish(std::string_view lower_case_key) const;
};

std::vector<std::string_view> split_words(std::string_view words);
/// Returns whether `word` is one of `words`, which are separated by '|'.
bool lists(std::string_view words, std::string_view word);

/// Returns the values that a field allows in words: "a number from -90 to 90 (deg)", "\"none\" or ...", "true or false".
std::string allowed_values(const Field& field);

/// Returns a range in words: "from -90 to 90", "above 0 and at most 1e6", "of at least 0"; empty if it has all finite numbers.
std::string range_text(const Range& range);

}  // namespace earthtop::input
