// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/suggest.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "input/foreign_units.hpp"

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

using Words = std::vector<std::string_view>;

Words words_of(std::string_view name) {
  Words words;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find('_'), name.size());
    if (end > 0) words.push_back(name.substr(0, end));
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return words;
}

/// A name in lower case, and its words without those of its unit.
struct Spelling {
  explicit Spelling(std::string_view name) : whole(lower_case(name)), words(words_of(without_unit(whole))) {}
  Spelling(const Spelling&) = delete;
  Spelling& operator=(const Spelling&) = delete;

  std::string whole;
  Words words;  // parts of `whole`
};

std::string joined(std::string_view name) {
  std::string letters(name);
  std::erase(letters, '_');
  return letters;
}
std::string joined(const Words& words) {
  std::string letters;
  for (const std::string_view word : words) letters += word;
  return letters;
}

/// The most errors in a word of this size: a short one with two is another word.
std::size_t most_errors(std::size_t size) { return size < 3 ? 0 : size < 6 ? 1 : 2; }

/// The number of errors if one word is a misspelling of the other; empty if it is another word, as "top" is another one than "tip".
std::optional<std::size_t> misspelling(std::string_view given, std::string_view word) {
  const std::size_t most = most_errors(std::min(given.size(), word.size()));
  if (std::max(given.size(), word.size()) > std::min(given.size(), word.size()) + most) return std::nullopt;
  constexpr std::size_t kAllMatter = 4;  // a replaced letter makes another word of fewer letters
  if (given.size() == word.size() && given.size() < kAllMatter &&
      !std::is_permutation(given.begin(), given.end(), word.begin()))
    return std::nullopt;
  const std::size_t errors = edit_distance(given, word);
  return errors <= most ? std::optional(errors) : std::nullopt;
}

/// The errors in all words, if each is a misspelling of its counterpart.
std::optional<std::size_t> misspelling(const Words& given, const Words& words) {
  if (given.size() != words.size()) return std::nullopt;
  std::size_t errors = 0;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto errors_here = misspelling(given[i], words[i]);
    if (!errors_here) return std::nullopt;
    errors += *errors_here;
  }
  return errors;
}

/// Whether names that are divided into words in another way have the same letters but for one: "spinrpm", "tilt_azimuthdeg".
bool is_divided_otherwise(const std::string& given, const std::string& word) {
  constexpr std::size_t kShort = 5;  // a name of fewer letters with an error is another one
  if (given == word) return true;
  if (std::max(given.size(), word.size()) > std::min(given.size(), word.size()) + 1) return false;
  return std::min(given.size(), word.size()) >= kShort && edit_distance(given, word) <= 1;
}

/// Whether the name is that of the candidate with a short unknown word in the place of its unit: "spin_foo" for "spin_rad_s".
bool has_unknown_unit(const Spelling& given, const Spelling& candidate) {
  constexpr std::size_t kLongestUnit = 3;
  const std::size_t size = candidate.words.size();
  return given.words.size() == size + 1 && given.words.back().size() <= kLongestUnit &&
         given.whole.ends_with(given.words.back()) && candidate.whole.size() > joined(candidate.words).size() + size - 1 &&
         std::equal(candidate.words.begin(), candidate.words.end(), given.words.begin());
}

/// Whether the given words are among the candidate's, in their order.
bool is_part(const Words& given, const Words& words) {
  std::size_t found = 0;
  for (const std::string_view word : words)
    if (found < given.size() && misspelling(given[found], word)) ++found;
  return !given.empty() && found == given.size();
}

/// How near a candidate is; empty if it means something else. The smaller pair is the nearer one.
using Rank = std::pair<Nearness, std::size_t>;
std::optional<Rank> rank_of(const Spelling& given, const Spelling& candidate) {
  if (given.words.empty() || candidate.words.empty()) return std::nullopt;
  const auto ranked = [&](Nearness nearness) { return Rank{nearness, edit_distance(given.whole, candidate.whole)}; };
  if (given.words == candidate.words) return ranked(Nearness::same);
  if (misspelling(given.words, candidate.words)) return ranked(Nearness::misspelt);
  if (has_unknown_unit(given, candidate)) return ranked(Nearness::misspelt);
  if (given.words.size() != candidate.words.size() || given.words.size() == 1)
    if (is_divided_otherwise(joined(given.whole), joined(candidate.whole)) ||
        is_divided_otherwise(joined(given.words), joined(candidate.words)))
      return ranked(Nearness::misspelt);
  if (!is_part(given.words, candidate.words)) return std::nullopt;
  const bool begins = misspelling(given.words, {candidate.words.begin(),
                                                candidate.words.begin() + static_cast<std::ptrdiff_t>(given.words.size())})
                          .has_value();
  return Rank{Nearness::incomplete, begins ? 0 : 1};
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c :
       lower) {  // not by the C library, which takes as long for a letter as the rest of a check: a key may have 16 MB
    if (c == '-') c = '_';
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

bool is_one_letter_off(std::string_view given, std::string_view word) {
  if (given.size() > kLongestWord || word.size() > kLongestWord) return false;
  return edit_distance(lower_case(given), lower_case(word)) <= 1;
}

std::optional<Suggestion> nearest(std::string_view given, const std::vector<std::string_view>& candidates) {
  if (given.empty() || given.size() > kLongestWord) return std::nullopt;
  const Spelling spelling(given);
  std::optional<Suggestion> best;
  std::optional<Rank> least;
  bool alone = true;  // whether no other candidate is as near
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongestWord) continue;
    const auto rank = rank_of(spelling, Spelling(candidate));
    if (!rank || (least && *rank > *least)) continue;
    alone = !least || *rank < *least;
    if (alone) least = rank, best = {candidate, rank->first};
  }
  if (best && best->nearness == Nearness::incomplete && !alone) return std::nullopt;
  return best;
}

std::optional<std::string_view> suggest(std::string_view given, const std::vector<std::string_view>& candidates) {
  const auto found = nearest(given, candidates);
  return found ? std::optional(found->word) : std::nullopt;
}

}  // namespace earthtop::input
