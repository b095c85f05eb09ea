// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/drift_section.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/results/azimuth_trend.hpp"
#include "report/known_html.hpp"

namespace earthtop::report {
namespace {

using compare::Row;

std::vector<double> scaled(std::vector<double> list, double factor) {
  for (double& number : list) number *= factor;
  return list;
}

/// Whether each row's drift can be trusted; rows of older results that do not say so can.
std::vector<bool> reliable_rows(const Run& run) {
  std::vector<bool> list;
  for (const double flag : values(run, "drift_reliable")) list.push_back(flag != 0);
  return list;
}

/// The angle between the axes and its part in tilt, in one unit.
Panel angle_panel(const Run& run) {
  std::vector<double> angle = values(run, "drift_axis_rad"), tilt = values(run, "drift_tilt_rad");
  const ReadableUnit unit = angle_unit(std::max(largest_size(angle), largest_size(tilt)));
  angle = scaled(std::move(angle), unit.per_si);
  const std::vector<double> t = times(run);
  const std::vector<bool> reliable = reliable_rows(run);
  std::vector<double> later = angle;
  for (std::size_t i = 0; i < angle.size(); ++i) (reliable[i] ? later : angle)[i] = kNoNumber;
  const bool has_later = std::find(reliable.begin(), reliable.end(), false) != reliable.end();
  Panel panel{{"Angle between the two spin axes", std::string(unit.name)}, {}};
  panel.lines.push_back({"angle", t, std::move(angle)});
  panel.lines.push_back({"its part in tilt", t, scaled(std::move(tilt), unit.per_si), LineColor::orange, LineStyle::dashed});
  if (has_later) panel.lines.push_back({"not reliable", t, std::move(later), LineColor::grey, LineStyle::dotted});
  return panel;
}

/// Whether azimuths tell at all rows how the axes stand to each other.
bool has_azimuths(const Run& run, const std::vector<double>& azimuth) {
  const std::size_t axis = column("axis_L_x"), ref_axis = column("ref_axis_L_x"), apart = column("drift_axis_rad");
  return std::all_of(run.rows.begin(), run.rows.end(),
                     [&](const Row& row) {
                       return azimuths_are_meaningful(&row.value[axis], &row.value[ref_axis], row.value[apart]);
                     }) &&
         std::all_of(azimuth.begin(), azimuth.end(), [](double a) { return std::isfinite(a); });
}

/// The azimuth with its secular line, and what is left of it beside the line.
void add_azimuth(const Run& run, Figure& figure) {
  const std::vector<double> azimuth = values(run, "drift_azimuth_rad"), t = times(run);
  if (azimuth.empty() || !has_azimuths(run, azimuth)) return;
  const ReadableUnit unit = angle_unit(largest_size(azimuth));
  Panel panel{{"Azimuth, clockwise from above", std::string(unit.name)}, {}};
  panel.lines.push_back({"azimuth", t, scaled(azimuth, unit.per_si)});
  const auto rate = run.number("/drift/secular/azimuth_rate_rad_s");
  if (!rate) {
    figure.panels.push_back(std::move(panel));
    return;
  }
  double offset = 0;
  for (std::size_t i = 0; i < t.size(); ++i) offset += (azimuth[i] - *rate * run.rows[i].t_s) / static_cast<double>(t.size());
  std::vector<double> line, rest;
  for (std::size_t i = 0; i < t.size(); ++i) {
    line.push_back(offset + *rate * run.rows[i].t_s);
    rest.push_back(azimuth[i] - line.back());
  }
  panel.lines.push_back({"secular line", t, scaled(std::move(line), unit.per_si), LineColor::grey, LineStyle::broad});
  const ReadableUnit small = angle_unit(largest_size(rest));
  Panel beside{{"Azimuth minus its secular line", std::string(small.name)}, {}, 120};
  beside.lines.push_back({"residual", t, scaled(std::move(rest), small.per_si)});
  figure.panels.push_back(std::move(panel));
  figure.panels.push_back(std::move(beside));
}

Figure drift_figure(const Run& run) {
  Figure figure{
      "Drift", "Rotating minus non-rotating Earth; " + run.word("/matching_rule/statement"), {"Time", run.time.name}, {}};
  figure.panels.push_back(angle_panel(run));
  add_azimuth(run, figure);
  return figure;
}

Figure bound_figure(const Run& run) {
  const ReadableUnit unit = angle_unit(run.number("/drift/axis_max_rad").value_or(0));
  return {"Angle between the two spin axes, and the bound on its error",
          "Rotating against non-rotating Earth; " + run.word("/matching_rule/statement"),
          {"Time", run.time.name},
          {{{"Axis drift", std::string(unit.name), AxisScale::logarithmic},
            {{"bound on its error", times(run), values(run, "drift_axis_bound_rad", unit.per_si), LineColor::vermillion,
              LineStyle::filled},
             {"drift", times(run), values(run, "drift_axis_rad", unit.per_si)}}}}};
}

/// The bound on the error of the angle, as text.
std::string bound_of(const Run& run) {
  const auto drift = run.number("/drift/reliable/axis_rad"), bound = run.number("/drift/reliable/axis_bound_rad"),
             at = run.number("/drift/reliable/at_s");
  if (!drift || !bound || !at || !(*at > 0)) return "";
  std::string html = fmt::format("<p>The error of the angle at {} is at most {}", number_html(*at, "s"),
                                 error_html(*drift, *bound, angle_unit(*drift)));
  constexpr double kFar = 10;
  if (*bound > 0 && *drift >= kFar * *bound)
    html += fmt::format(", a fraction of {}", error_html(0, *bound / *drift, ReadableUnit{"", "", 1}));
  return html + fmt::format(". In radians the angle is {}.</p>\n", known_html(*drift, *bound, "rad"));
}

/// The trend of the azimuth with its bound, and what theory says of it; all azimuths clockwise from above.
std::string trend_of(const Run& run) {
  const auto word_of = [&](const char* pointer) { return escaped(run.word(pointer)); };
  std::string html;
  const auto rate = run.number("/drift/secular/azimuth_rate_rad_s");
  const auto bound = run.number("/drift/secular/azimuth_rate_bound_95_rad_s");
  if (rate && bound) {
    html = fmt::format("<p>Trend: the azimuth drifts by {}, clockwise from above", known_html(*rate, *bound, "rad/s"));
    if (const auto turns = run.number("/drift/secular/turns_seen"))
      html += fmt::format(", over {} turns of precession; ± is the 95 % bound", number_html(*turns, "", 3));
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

/// When the drift passes the requested threshold, and when motions come to rest.
std::string events_of(const Run& run) {
  const auto time = [](double t_s, const std::optional<double>& bound_s) {
    return known_html(t_s, bound_s.value_or(kNoNumber), "s");
  };
  std::string html;
  if (const std::string crossing = run.word("/drift/threshold_crossing"); !crossing.empty()) {
    html += fmt::format("<p>Threshold of {}: {}", number_html(run.number("/drift/threshold_rad").value_or(0), "rad"),
                        escaped(crossing));
    if (const auto passed = run.number("/drift/threshold_time_s"))
      html += ", passed at " + time(*passed, run.number("/drift/threshold_time_bound_s"));
    html += ".</p>\n";
  }
  for (std::size_t i = 0; const auto stop = run.number(fmt::format("/stops/{}/t_s", i)); ++i)
    html += fmt::format("<p>The {} prediction comes to rest at {}.</p>\n",
                        run.word(fmt::format("/stops/{}/prediction", i)) == "rotating" ? "rotating" : "non-rotating",
                        time(*stop, run.number(fmt::format("/stops/{}/bound_s", i))));
  return html;
}

}  // namespace

std::string headline_html(const Run& run) {
  const auto drift = run.number("/drift/reliable/axis_rad"), bound = run.number("/drift/reliable/axis_bound_rad"),
             at = run.number("/drift/reliable/at_s");
  if (!drift || !bound || !at || !(*at > 0)) return "No row of this run can be trusted.";
  std::string tip;
  if (run.has_contact && *at == run.rows.back().t_s) {
    const double far = value(run.rows.back(), column("drift_tip_m")),
                 error = value(run.rows.back(), column("drift_tip_bound_m"));
    if (std::isfinite(far)) tip = ", and the tip " + known_html(far, error, length_unit(far)) + " from there";
  }
  return fmt::format("After {} the axis stands {} from where the non-rotating prediction puts it{}. Both predictions: {}.",
                     number_html(*at, "s"), known_angle_html(*drift, *bound, true), tip,
                     escaped(run.word("/matching_rule/statement")));
}

std::string drift_section(const Run& run, Page& page, const std::string& note) {
  Figure figure = drift_figure(run);
  std::string caption = "The angle between the two axes and its part in tilt";
  if (figure.panels.size() > 1) caption += "; the azimuth";
  if (figure.panels.size() > 2) caption += ", and what is left of it without its secular line";
  return page.chart("parts", std::move(figure), caption + "." + note) + bound_of(run) +
         bound_chart_html(page, "axis", bound_figure(run)) + trend_of(run) + events_of(run);
}

std::string why_html(const Run& run) {
  std::string html;
  for (std::size_t i = 0; i < run.results.summary->value("why", Json::array()).size(); ++i)
    html += "<li>" + powers_html(escaped(run.word(fmt::format("/why/{}/text", i)))) + "</li>\n";
  return html.empty() ? html : "<ol class=\"why\">\n" + html + "</ol>\n";
}

std::string bound_chart_html(Page& page, const std::string& name, Figure figure) {
  return "<details><summary>The error's bound beside the drift, over all decades</summary>\n" +
         page.chart(name, std::move(figure), "Both on a logarithmic scale.") + "</details>\n";
}

}  // namespace earthtop::report
