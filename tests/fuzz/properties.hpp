// SPDX-License-Identifier: GPL-3.0-or-later
/// The properties that must hold at every door: how inputs are refused, and what outputs look like.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/error.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::fuzz {

/// A property that does not hold.
class Broken : public std::logic_error {
  using std::logic_error::logic_error;
};
/// @throws Broken with these words, and what shows it, unless `holds`
void demand(bool holds, std::string_view what, std::string_view shown);

/// A message is shorter than 2 KiB, and a terminal can show it.
void check_message(std::string_view message);
/// A refusal has 1 to 21 diagnostics, each of them a message.
void check_refusal(const ScenarioError& error);
/// A strict JSON document without NaN, Infinity or duplicate keys.
void check_json(std::string_view text);
/// Lines of as many cells as the header has (RFC 4180), none of which is NaN or Infinity.
/// @param has_any_words  whether its words come from a hostile file: one of them may be "nan"
/// @returns the number of rows
std::size_t check_csv(std::string_view text, bool has_any_words = false);
/// A page, or a picture in XML: elements and attributes that the program writes and no others, each closed in order; `<`, `&` and
/// `"` only where they mean markup; nothing that runs but the page's own script; its data are JSON.
void check_markup(std::string_view text);
/// The page of results, of a store or of a document, if there is one, and its pictures are such markup.
void check_report(const std::filesystem::path& what);

/// Lets work happen that may refuse its input. @returns whether it did not   @throws whatever is no documented refusal
template <class Work>
bool accepts(const Work& work) {
  try {
    work();
    return true;
  } catch (const ScenarioError& error) {
    check_refusal(error);
  } catch (const ReadError& error) {
    check_message(error.what());
  }
  return false;
}

/// The parts of an input, which kBetweenParts separates.
std::vector<std::string> parts_of(std::string_view input);
std::string joined(const std::vector<std::string>& parts);

/// The directory of this process's files, emptied for every input.
class Scratch {
 public:
  /// @returns the directory, empty
  static const std::filesystem::path& empty();
  static std::filesystem::path write(const std::filesystem::path& name, std::string_view content);
};
std::string content_of(const std::filesystem::path& file);

}  // namespace earthtop::fuzz
