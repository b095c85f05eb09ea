// SPDX-License-Identifier: GPL-3.0-or-later
/// The texts of JSONTestSuite's kinds, rewritten: tests/hostile/refused.txt, accepted.txt and either.txt.
#pragma once

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop::hostile_test {

struct Kind {
  std::string name;
  std::string outcome;  ///< for either.txt only
  std::string text;
};

/// Decodes an escaped text: %XX is a byte, @N{...} repeats what stands in the braces N times.
inline std::string unescaped(std::string_view written) {
  std::string text;
  while (!written.empty()) {
    const std::size_t open = written.find('{');
    if (written[0] == '%') {
      text += static_cast<char>(std::strtol(std::string(written.substr(1, 2)).c_str(), nullptr, 16));
      written.remove_prefix(3);
    } else if (written[0] == '@' && open != std::string_view::npos && written.size() > 1 && written[1] >= '0' &&
               written[1] <= '9') {
      const std::size_t close = written.find('}', open);
      for (long n = std::strtol(std::string(written.substr(1)).c_str(), nullptr, 10); n > 0; --n)
        text += written.substr(open + 1, close - open - 1);
      written.remove_prefix(close + 1);
    } else {
      text += written[0];
      written.remove_prefix(1);
    }
  }
  return text;
}

inline std::vector<Kind> read_kinds(const std::string& file, bool with_outcome) {
  std::ifstream lines(std::string(EARTHTOP_HOSTILE) + "/" + file, std::ios::binary);
  if (!lines) throw std::runtime_error("not found: " + file);
  std::vector<Kind> kinds;
  const auto cut = [](std::string& rest) {
    const std::size_t blank = std::min(rest.find(' '), rest.size());
    std::string word = rest.substr(0, blank);
    rest.erase(0, blank + 1);
    return word;
  };
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    Kind kind;
    kind.name = cut(line);
    if (with_outcome) kind.outcome = cut(line);
    kind.text = unescaped(line);
    kinds.push_back(std::move(kind));
  }
  return kinds;
}

inline std::vector<Kind> refused_kinds() { return read_kinds("refused.txt", false); }
inline std::vector<Kind> accepted_kinds() { return read_kinds("accepted.txt", false); }
inline std::vector<Kind> either_kinds() { return read_kinds("either.txt", true); }

/// A valid scenario with the text as the value of a comment.
inline std::string as_member(const std::string& text) {
  return "{\"_text\": " + text + R"(, "name": "hostile", "site": {"latitude_deg": 45},
 "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia": {"principal_kg_m2": [2e-4, 2e-4, 4e-5]}},
 "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 1}}
)";
}

/// The same with the text last, so that only the scenario's closing bracket follows.
inline std::string as_last_member(const std::string& text) {
  std::string scenario = as_member("0");
  scenario.resize(scenario.find_last_of('}'));
  return scenario + ", \"_last\": " + text + "}\n";
}

}  // namespace earthtop::hostile_test
