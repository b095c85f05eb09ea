// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/properties.hpp"

#include <sys/time.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>

#include "earthtop/report/report.hpp"
#include "earthtop/results/results.hpp"
#include "fuzz/door.hpp"
#include "input/reader.hpp"
#include "text/utf8.hpp"

namespace earthtop::fuzz {
namespace {

constexpr std::size_t kLongestMessage = 2048;  // bytes
constexpr std::size_t kShown = 4000;           // bytes of what breaks a property

const std::filesystem::path& directory() {
  static const testing::TemporaryDirectory directory;
  return directory.path();
}

bool is_not_finite(std::string_view cell) {
  if (cell.starts_with('-') || cell.starts_with('+')) cell.remove_prefix(1);
  return cell == "nan" || cell == "inf" || cell == "NaN" || cell == "Infinity";
}

/// Asks work to stop when it has taken a second of processor time: a page looks at its motion again, and a long one is no fault.
class Patience {
 public:
  Patience() {
    is_over_ = false;
    std::signal(SIGVTALRM, [](int) { is_over_ = true; });
    set(1);
  }
  ~Patience() { set(0); }
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;
  static Watch watch() { return &is_over_; }

 private:
  static void set(int seconds) {
    const itimerval timer = {{0, 0}, {seconds, 0}};
    ::setitimer(ITIMER_VIRTUAL, &timer, nullptr);
  }
  static inline std::atomic<bool> is_over_ = false;
};

}  // namespace

void demand(bool holds, std::string_view what, std::string_view shown) {
  if (!holds) throw Broken("not so: " + std::string(what) + "\n" + printable(shown.substr(0, kShown)));
}

void check_message(std::string_view message) {
  demand(!message.empty(), "a message says something", message);
  demand(message.size() < kLongestMessage, "a message is shorter than 2 KiB", message);
  demand(message == printable(message), "a terminal can show a message", message);
}

void check_refusal(const ScenarioError& error) {
  demand(!error.diagnostics().empty() && error.diagnostics().size() <= 21, "1 to 21 diagnostics", error.what());
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    demand(!diagnostic.message.empty(), "a diagnostic has a message", error.what());
    demand(diagnostic.line >= 0 && diagnostic.column >= 0, "a place is not negative", error.what());
    check_message(format_diagnostic(error.file(), diagnostic));
  }
}

void check_json(std::string_view text) {
  // A NUL in a word of a hostile file is written as JSON demands, though the program's own reader refuses it.
  std::string without_nul(text);
  for (std::size_t at = 0; (at = without_nul.find("\\u0000", at)) != std::string::npos;) without_nul[at + 5] = '1';
  input::Node root;
  input::Findings findings;
  const input::ReadOutcome outcome = input::read_json(without_nul, "", false, root, findings);
  demand(outcome == input::ReadOutcome::complete && findings.empty(), "an output is strict JSON",
         findings.empty() ? text : findings.errors(without_nul).front().message + "\n" + std::string(text));
}

std::size_t check_csv(std::string_view text, bool has_any_words) {
  std::size_t rows = 0, cells = 0, width = 0;
  const std::string_view whole = text;
  while (!text.empty()) {
    std::string_view cell;
    if (text.front() == '"') {
      std::size_t end = 1;
      while (end < text.size() && (text[end] != '"' || (end + 1 < text.size() && text[end + 1] == '"')))
        end += text[end] == '"' ? 2 : 1;
      demand(end < text.size(), "a quoted cell ends", whole);
      cell = text.substr(1, end - 1);
      text.remove_prefix(end + 1);
    } else {
      cell = text.substr(0, std::min(text.find_first_of(",\n"), text.size()));
      demand(cell.find('"') == cell.npos, "no quote within a bare cell", whole);
      demand(has_any_words || !is_not_finite(cell), "no number that is not finite", whole);
      text.remove_prefix(cell.size());
    }
    ++cells;
    demand(!text.empty() && (text.front() == ',' || text.front() == '\n'), "a cell ends with a comma or its line", whole);
    const bool ends_line = text.front() == '\n';
    text.remove_prefix(1);
    if (!ends_line) continue;
    if (width == 0) width = cells;
    demand(cells == width, "every line has the header's number of cells", whole);
    cells = 0;
    ++rows;
  }
  demand(cells == 0 && rows > 0, "the last line has an end", whole);
  return rows - 1;
}

void check_report(const std::filesystem::path& what) {
  accepts([&] {
    try {
      const Patience patience;
      const Report report = make_report(what, Patience::watch());
      check_markup(report.html);
      for (const auto& [name, picture] : report.pictures) check_markup(picture);
    } catch (const Interrupted&) {  // by our impatience
    }
  });
}

std::vector<std::string> parts_of(std::string_view input) {
  std::vector<std::string> parts;
  for (;;) {
    const auto end = input.find(kBetweenParts);
    parts.emplace_back(input.substr(0, end));
    if (end == std::string_view::npos) return parts;
    input.remove_prefix(end + 1);
  }
}

std::string joined(const std::vector<std::string>& parts) {
  std::string input;
  for (std::size_t i = 0; i < parts.size(); ++i) input += (i > 0 ? std::string(1, kBetweenParts) : "") + parts[i];
  return input;
}

const std::filesystem::path& Scratch::empty() {
  for (const auto& entry : std::filesystem::directory_iterator(directory())) std::filesystem::remove_all(entry.path());
  return directory();
}

std::filesystem::path Scratch::write(const std::filesystem::path& name, std::string_view content) {
  const std::filesystem::path file = directory() / name;
  if (!std::filesystem::exists(file.parent_path())) std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace earthtop::fuzz
