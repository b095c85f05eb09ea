// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of what a run prints, which the short and the long text have in common.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contact_text.hpp"
#include "earthtop/results/headline.hpp"
#include "earthtop/run.hpp"
#include "screen.hpp"
#include "summary_text.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {

/// A text in lines that grows from above to below.
class TextPage {
 public:
  explicit TextPage(const Screen& screen) : screen_(screen) {}

  void heading(std::string_view text) { line("{}", strong(text)); }
  void entry(std::string_view label, std::string_view text, std::size_t indent = 12) {
    text_ += wrapped_entry(label, text, screen_.width, indent);
  }
  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    constexpr std::size_t kIndent = 14;
    text_ += wrapped(fmt::format(format, std::forward<Values>(values)...), screen_.width, kIndent) + '\n';
  }
  void gap() { text_ += '\n'; }
  std::string strong(std::string_view text) const { return dressed("1", text); }
  std::string warning(std::string_view text) const { return dressed("33", text); }
  std::string text() && { return std::move(text_); }

 private:
  std::string dressed(std::string_view code, std::string_view text) const {
    return screen_.color ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
  }

  Screen screen_;
  std::string text_;
};

/// The same angle in a handy unit, from degrees to microarcseconds.
std::string pictured(double rad);
/// A name of the program's in plain words: spaces for its underscores.
std::string spoken(std::string name);
/// The summary of the drift over the rows that can be trusted, which are mostly all of them.
DriftSummary reliable_drift(const RunResult& result);
/// Whether verdict and threshold follow the rotor's axis, and it is another one than body axis 3.
bool judges_rotor_axis(const RunResult& result);

void write_lines(TextPage& page, const std::vector<LabelledLine>& lines);
void write_status(TextPage& page, const RunResult& result);
void write_verdict(TextPage& page, const RunResult& result);
void write_stops(TextPage& page, const RunResult& result);
/// The choice that "auto" made.
void write_choice(TextPage& page, const RunResult& result);
/// The accuracy that was asked for and reached.
void write_accuracy(TextPage& page, const RunResult& result);
void write_threshold(TextPage& page, const RunResult& result);
/// How well the drift is known if the inputs have errors.
void write_known_to(TextPage& page, const RunResult& result);
/// @param changed the scenario differs from its file, so that a headline figure that is not met says nothing about the program
void write_headline(TextPage& page, const HeadlineCheck& check, const RunResult& result, bool changed);
void write_notes(TextPage& page, const RunResult& result);
/// Where the results are, and in the last line the command that makes a page of them.
void write_end(TextPage& page, const Written& where, bool is_brief);

}  // namespace earthtop::tool
