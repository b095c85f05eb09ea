// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/suggest.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace earthtop::input {
namespace {

constexpr std::size_t kLongestWord = 48;  // a longer word is not a misspelling, and a hostile one would cost time

/// Returns the least number of insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string
/// alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::array<std::array<std::size_t, kLongestWord + 1>, kLongestWord + 1> d;
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// Returns the candidate whose beginning, up to a '_', is nearest to the word: for a misspelled quantity without its unit.
std::optional<std::string_view> with_misspelled_prefix(const std::string& word,
                                                       const std::vector<std::string_view>& candidates) {
  std::optional<std::string_view> best;
  std::size_t least = 1 + word.size() / 4;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongestWord) continue;
    for (auto end = candidate.find('_'); end != std::string_view::npos; end = candidate.find('_', end + 1)) {
      const std::size_t distance = edit_distance(word, lower_case(candidate.substr(0, end)));
      if (distance < least || (best && distance == least && candidate.size() < best->size()))
        least = distance, best = candidate;
    }
  }
  return best;
}

/// Returns the shortest candidate that begins with the prefix.
std::optional<std::string_view> with_prefix(const std::string& prefix, const std::vector<std::string_view>& candidates) {
  std::optional<std::string_view> best;
  for (const std::string_view candidate : candidates)
    if (lower_case(candidate).starts_with(prefix) && (!best || candidate.size() < best->size())) best = candidate;
  return best;
}

/// Returns the shortest candidate with the word between underscores or at its end: "tolerance" in "relative_tolerance".
std::optional<std::string_view> with_part(const std::string& word, const std::vector<std::string_view>& candidates) {
  std::optional<std::string_view> best;
  for (const std::string_view candidate : candidates)
    if ((lower_case(candidate) + "_").find("_" + word + "_") != std::string::npos && (!best || candidate.size() < best->size()))
      best = candidate;
  return best;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return lower;
}

bool is_one_letter_off(std::string_view given, std::string_view word) {
  if (given.size() > kLongestWord || word.size() > kLongestWord) return false;
  return edit_distance(lower_case(given), lower_case(word)) <= 1;
}

std::optional<std::string_view> suggest(std::string_view given, const std::vector<std::string_view>& candidates) {
  if (given.empty() || given.size() > kLongestWord) return std::nullopt;
  const std::string word = lower_case(given);
  std::optional<std::string_view> nearest;
  std::size_t least = 2 + word.size() / 4;  // limit of the errors: one letter in short words, a quarter of long ones
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongestWord) continue;
    const std::size_t distance = edit_distance(word, lower_case(candidate));
    if (distance < least) least = distance, nearest = candidate;
  }
  if (nearest && least <= 1) return nearest;
  if (const auto match = with_prefix(word + "_", candidates)) return match;
  if (nearest && least <= 2) return nearest;
  if (const auto unit = word.rfind('_'); unit != std::string::npos && unit > 1)
    if (const auto match = with_prefix(word.substr(0, unit + 1), candidates)) return match;
  if (nearest) return nearest;
  if (const auto match = with_misspelled_prefix(word, candidates)) return match;
  return with_part(word, candidates);
}

}  // namespace earthtop::input
