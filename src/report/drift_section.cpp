// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/drift_section.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/drift/drift.hpp"
#include "earthtop/integrate/method.hpp"
#include "report/drift_chart.hpp"
#include "report/known_html.hpp"

namespace earthtop::report {
namespace {

/// The bound comes from the output rows: it only grows, so that it needs no others.
Figure bound_figure(const Run& run) {
  const ReadableUnit unit = angle_unit(run.number("/drift/axis_max_rad").value_or(0));
  Figure figure{
      "The bound on the error of the angle between the two spin axes",
      fmt::format("{} against {}; {}", run.compared().former, run.compared().latter, run.word("/matching_rule/statement")),
      {"Time", run.time.name},
      {{{"Bound on the error", std::string(unit.name), AxisScale::logarithmic}, {}}}};
  figure.panels[0].lines = {{"", times(run, run.listed), values(run.listed, "drift_axis_bound_rad", unit.per_si),
                             LineColor::vermillion, LineStyle::filled}};
  return figure;
}

/// The trend of the azimuth with its bound, and what theory says of it; all azimuths clockwise from above.
std::string trend_of(const Run& run) {
  const auto word_of = [&](const char* pointer) { return escaped(run.word(pointer)); };
  std::string html;
  const auto rate = run.number("/drift/secular/azimuth_rate_rad_s");
  const auto bound = run.number("/drift/secular/azimuth_rate_bound_95_rad_s");
  if (rate && bound) {
    html = fmt::format("<p>Trend: the azimuth drifts by {}, counted clockwise from above", known_html(*rate, *bound, "rad/s"));
    if (const auto turns = run.number("/drift/secular/turns_seen"))
      html += run.word("/solution/method") == to_string(Method::fourier)
                  ? std::string(", for all time, as the rates of the motions' Fourier sums tell; ± is a bound")
                  : fmt::format(", over {} turns of precession; ± is the 95 % bound", number_html(*turns, "", 3));
    else
      html += ": the mean of the run and no more, as " + word_of("/drift/secular/reason");
    html += ".</p>\n";
  } else if (const std::string reason = word_of("/drift/secular/reason"); !reason.empty()) {
    html = "<p>Trend: not determined: " + reason + ".</p>\n";
  }
  const auto predicted = run.number("/theory/0/predicted"), error = run.number("/theory/0/predicted_error");
  if (predicted && error && run.word("/theory/0/name") == "precession_rate_change")
    html += fmt::format("<p>First-order theory: {}{}.</p>\n", known_html(0.0 - *predicted, *error, "rad/s"),
                        run.results.summary->value(Json::json_pointer("/theory/0/applies"), true) ? "" : ": it does not apply");
  return html;
}

/// A value of the summary with the bound on its error.
std::string known_value(const Run& run, const std::string& value, const std::string& bound, const char* unit) {
  return known_html(run.number(value).value_or(kNoNumber), run.number(bound).value_or(kNoNumber), unit);
}

/// When spin and tilt come to the values asked for.
std::string reached_html(const Run& run) {
  std::string html;
  for (const char* what : {"spin", "tilt"}) {
    if (!run.results.summary->contains(Json::json_pointer(fmt::format("/motion/{}_reached_s", what)))) continue;
    const std::string pointer = fmt::format("/motion/{}_reached", what);
    html += !run.results.summary->value(Json::json_pointer(pointer + "_is_sure"), true)
                ? fmt::format("<p>Within its error the {} asked for may be reached or not.</p>\n", what)
            : run.number(pointer + "_s") ? fmt::format("<p>The {} asked for is reached at {}.</p>\n", what,
                                                       known_value(run, pointer + "_s", pointer + "_bound_s", "s"))
                                         : fmt::format("<p>The {} asked for is not reached.</p>\n", what);
  }
  return html;
}

/// The spin that is left, and a pendulum's swing.
std::string motion_html(const Run& run) {
  std::string html;
  const auto start = run.number("/top/spin_rad_s"), left = run.number("/motion/spin_final_rad_s");
  constexpr double kTold = 1e-3;  // of the spin
  if (start && left && std::abs(*left - *start) > kTold * std::abs(*start))
    html += fmt::format("<p>At the end the spin is {}.</p>\n",
                        known_value(run, "/motion/spin_final_rad_s", "/motion/spin_final_bound_rad_s", "rad/s"));
  if (run.number("/motion/swing/plane_rate_rad_s"))
    html += fmt::format(
        "<p>The plane of the swing turns by {}, clockwise seen from above; without {} it would by {}. Its semi-axes "
        "are {} and {} at the end.</p>\n",
        known_value(run, "/motion/swing/plane_rate_rad_s", "/motion/swing/plane_rate_bound_rad_s", "rad/s"),
        run.compared().agent,
        known_value(run, "/motion/swing/apsidal_rate_rad_s", "/motion/swing/apsidal_rate_bound_rad_s", "rad/s"),
        known_value(run, "/motion/swing/major_end_rad", "/motion/swing/major_end_bound_rad", "rad"),
        known_value(run, "/motion/swing/minor_end_rad", "/motion/swing/minor_end_bound_rad", "rad"));
  return html;
}

}  // namespace

std::string drift_events_html(const Run& run) {
  const auto time = [](double t_s, const std::optional<double>& bound_s) {
    return known_html(t_s, bound_s.value_or(kNoNumber), "s");
  };
  std::string html;
  if (const std::string crossing = run.word("/drift/threshold_crossing"); !crossing.empty()) {
    const auto passed = run.number("/drift/threshold_time_s");
    const std::string threshold = "the threshold of " + number_html(run.number("/drift/threshold_rad").value_or(0), "rad");
    if (crossing == to_string(ThresholdCrossing::not_reached))
      html += "<p>The drift does not reach " + threshold + ".</p>\n";
    else if (crossing == to_string(ThresholdCrossing::clear))
      html += fmt::format("<p>The drift passes {} at {}.</p>\n", threshold,
                          time(passed.value_or(kNoNumber), run.number("/drift/threshold_time_bound_s")));
    else
      html += fmt::format("<p>Within its error the drift may pass {} or not; as computed it {}.</p>\n", threshold,
                          passed ? "passes it at " + number_html(*passed, "s", 9) : "does not");
  }
  for (std::size_t i = 0; const auto stop = run.number(fmt::format("/stops/{}/t_s", i)); ++i)
    html += fmt::format("<p>The {} prediction comes to rest at {}.</p>\n",
                        run.word(fmt::format("/stops/{}/prediction", i)) == "rotating" ? "rotating" : "non-rotating",
                        time(*stop, run.number(fmt::format("/stops/{}/bound_s", i))));
  return html + reached_html(run);
}

std::string drift_section(const Run& run, Page& page) {
  const DriftCurves drawn = drift_curves(run, run.drawn);
  Figure figure = drift_figure(drawn, drawn);
  std::string caption = "The angle between the two axes";
  if (figure.panels[0].lines.size() > 1) caption += " and its part in tilt";
  if (figure.panels.size() > 1)
    caption += drawn.azimuth_rate_rad_s ? ", and what is left of the azimuth without its secular line" : ", and the azimuth";
  return page.chart("parts", std::move(figure), drift_figure(drift_curves(run, run.listed), drawn),
                    caption + ". " + run.drawn_words);
}

std::string bound_section(const Run& run, Page& page) {
  return trend_of(run) + motion_html(run) +
         page.chart("axis", bound_figure(run), "On a logarithmic scale, at the output rows.");
}

std::string why_html(const Run& run) {
  std::string html;
  for (std::size_t i = 0; i < run.results.summary->value("why", Json::array()).size(); ++i)
    html += "<li>" + with_powers(escaped(run.word(fmt::format("/why/{}/text", i)))) + "</li>\n";
  return html.empty() ? html : "<ol class=\"why\">\n" + html + "</ol>\n";
}

}  // namespace earthtop::report
