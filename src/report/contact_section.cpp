// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/contact_section.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "earthtop/drift/contact_event.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/results/compass_point.hpp"
#include "report/known_html.hpp"
#include "report/motion_data.hpp"
#include "report/path_picture.hpp"

namespace earthtop::report {
namespace {

using compare::Row;

constexpr double kShownTipDrift = 0.15;  // part of the path's extent to which the drift of the contact point is magnified
constexpr std::size_t kMostRows = 200;   // of a table

bool is_level(const Run& run) { return run.number("/scenario/contact/table/tilt_deg").value_or(0) == 0; }

/// By how much the drift is magnified in the picture of the path; 1 where it is not small beside the path.
double tip_magnification(double path_m, double drift_m) {
  if (!(drift_m > 0) || !(path_m * kShownTipDrift > drift_m)) return 1;
  const double most = kShownTipDrift * path_m / drift_m;
  return std::isfinite(most) ? round_down(most) : 1;
}

/// The magnification in digits: 1,000 or 2e+09.
std::string times_text(double factor) { return factor < 1e6 ? fmt::format("{:.0f}", factor) : fmt::format("{:g}", factor); }

/// Toward where a displacement on the table points, in words.
std::string toward(const Run& run, double x, double y) {
  if (is_level(run)) return fmt::format("to the {}", compass_point(x, y));
  return fmt::format("({:+.3g} m and {:+.3g} m along the table's axes)", x, y);
}

/// The paths at the output rows.
std::string path_table(const Run& run) {
  const char* const names[] = {"ref_tip_L_x_m", "ref_tip_L_y_m", "drift_tip_x_m", "drift_tip_y_m"};
  std::vector<std::vector<std::string>> rows;
  const std::vector<Row>& listed = run.listed.rows;
  const std::size_t stride = std::max<std::size_t>(1, (listed.size() + kMostRows - 1) / kMostRows);
  for (std::size_t i = 0; i < listed.size(); i += stride) {
    rows.push_back({fmt::format("{:.7g}", listed[i].t_s * run.time.per_s)});
    for (const char* name : names) rows.back().push_back(fmt::format("{:.7g}", value(listed[i], column(name))));
  }
  return table_html(
      {fmt::format("Time ({})", run.time.name), "prediction x (m)", "prediction y (m)", "drift x (m)", "drift y (m)"}, rows);
}

std::string path_html(const Run& run, Page& page) {
  // The mean of each window is drawn: a path through all their looks would join what is not known.
  const Motion& motion = run.drawn.a_window > 0 ? run.played : run.drawn;
  PathPicture picture;
  picture.name = "path";
  picture.title = "Path of the contact point";
  picture.reference = {"prediction", values(motion, "ref_tip_L_x_m"), values(motion, "ref_tip_L_y_m")};
  const std::vector<double> x = values(motion, "drift_tip_x_m"), y = values(motion, "drift_tip_y_m");
  const double path_m = extent(picture.reference.x, picture.reference.y), drift_m = std::fmax(largest_size(x), largest_size(y));
  const double factor = tip_magnification(path_m, drift_m);
  picture.rotating = {factor == 1 ? "with Earth rotation" : fmt::format("with Earth rotation, drift ×{}", times_text(factor)),
                      picture.reference.x, picture.reference.y};
  for (std::size_t i = 0; i < x.size(); ++i) {
    picture.rotating.x[i] += factor * x[i];
    picture.rotating.y[i] += factor * y[i];
  }
  const bool level = is_level(run);
  picture.right = level ? "East" : "the table's axis 1";
  picture.up = level ? "North" : "the table's axis 2";
  const std::string scale = factor == 1
                                ? "Both predictions to scale"
                                : fmt::format("The prediction to scale, its drift drawn {} times as large", times_text(factor));
  picture.subtitle = "Seen from above. " + scale;
  const std::string caption = fmt::format(
      "The table from above, the same scale in both directions. {}; the drift is {} at most. Rings: start. Dots: end.{}", scale,
      length_text(run.number("/drift/tip_max_m").value_or(drift_m), 3), run.drawn.a_window > 0 ? " " + run.played_words : "");
  return page.picture("path", path_svg(picture), caption, path_table(run));
}

/// The distance of the two contact points and its parts, in one unit.
Figure tip_figure(const Run& run, const Motion& motion) {
  const std::vector<double> t = times(run, motion);
  const ReadableUnit unit = length_unit(largest_size(values(run.drawn, "drift_tip_m")));
  const auto part = [&](const char* name) { return values(motion, name, unit.per_si); };
  const bool level = is_level(run);
  const std::array<std::vector<double>, 2> apart = {part("drift_tip_x_m"), part("drift_tip_y_m")};
  Panel panel{{"Drift of the contact point", std::string(unit.name)}, {}};
  panel.lines.push_back(line_of(motion, "distance", t, part("drift_tip_m"), LineColor::blue, LineStyle::solid, apart));
  panel.lines.push_back(
      line_of(motion, level ? "to the East" : "along axis 1", t, apart[0], LineColor::green, LineStyle::dotted));
  panel.lines.push_back(
      line_of(motion, level ? "to the North" : "along axis 2", t, apart[1], LineColor::orange, LineStyle::dashed));
  panel.labels_at_lines = true;
  return {
      "Distance of the two contact points", "Rotating minus non-rotating Earth", {"Time", run.time.name}, {std::move(panel)}};
}

Figure tip_bound_figure(const Run& run) {
  const ReadableUnit unit = length_unit(largest_size(values(run.drawn, "drift_tip_m")));
  Panel panel{{"Bound on the error", std::string(unit.name), AxisScale::logarithmic}, {}};
  panel.lines = {{"", times(run, run.listed), values(run.listed, "drift_tip_bound_m", unit.per_si), LineColor::vermillion,
                  LineStyle::filled}};
  return {"The bound on the error of the distance of the two contact points",
          "Rotating against non-rotating Earth",
          {"Time", run.time.name},
          {std::move(panel)}};
}

/// Slip and force have corners where the tip begins to roll: their lines go from point to point.
Figure force_figure(const Run& run, const Motion& motion) {
  const std::vector<double> t = times(run, motion);
  const auto line = [&](const char* label, const char* name, LineColor color, LineStyle style) {
    Line made{label, t, values(motion, name), color, style};
    made.a_column = motion.a_window;
    return made;
  };
  const auto panel = [&](const char* label, const char* unit, const char* reference, const char* rotating) {
    Panel made{{label, unit}, {}};
    made.lines.push_back(line("prediction", reference, LineColor::blue, LineStyle::broad));
    made.lines.push_back(line("with Earth rotation", rotating, LineColor::vermillion, LineStyle::solid));
    return made;
  };
  Figure figure{"Slip and normal force", "Both predictions", {"Time", run.time.name}, {}};
  figure.panels.push_back(panel("Slip of the tip", "m/s", "ref_slip_m_s", "slip_m_s"));
  figure.panels.push_back(panel("Normal force", "N", "ref_normal_force_N", "normal_force_N"));
  return figure;
}

/// The first and the last of the numbers that are finite; none where there are none.
struct Ends {
  double first = kNoNumber, last = kNoNumber;
};
Ends ends(const std::vector<double>& list) {
  Ends found;
  for (const double number : list) {
    if (!std::isfinite(number)) continue;
    if (!std::isfinite(found.first)) found.first = number;
    found.last = number;
  }
  return found;
}

/// These sentences say what can be seen in the pictures. A sentence is written only where it is true of what is drawn.
std::string seen_html(const Run& run) {
  if (run.drawn.rows.size() < 2) return "";
  std::string html = "<p>";
  const Ends x = ends(values(run.drawn, "tip_L_x_m")), y = ends(values(run.drawn, "tip_L_y_m")),
             slip = ends(values(run.drawn, "slip_m_s"));
  const double far = real::hypot(x.last - x.first, y.last - y.first);
  if (far > 0)
    html += fmt::format("The tip ends {} {} where it started. ", length_text(far, 3),
                        is_level(run) ? fmt::format("{} of", compass_point(x.last - x.first, y.last - y.first)) : "from");
  const Ends dx = ends(values(run.drawn, "drift_tip_x_m")), dy = ends(values(run.drawn, "drift_tip_y_m"));
  const double drift = real::hypot(dx.last, dy.last);
  if (drift > 0)
    html += fmt::format("The Earth's rotation moves its end by {} {}. ", length_text(drift, 3), toward(run, dx.last, dy.last));
  const std::vector<double> state = values(run.drawn, "contact_state"), force = values(run.drawn, "normal_force_N");
  if (std::all_of(state.begin(), state.end(), [](double s) { return s == static_cast<double>(ContactState::roll); }))
    html += "It rolls throughout. ";
  else if (slip.first > 0 && slip.last < 0.1 * slip.first)
    html += fmt::format("Its slip falls from {:.3g} m/s to {:.3g} m/s. ", slip.first, slip.last);
  double least = kNoNumber, most = kNoNumber;
  for (const double newtons : force) least = std::fmin(least, newtons), most = std::fmax(most, newtons);
  const std::string low = fmt::format("{:.4g} N", least), high = fmt::format("{:.4g} N", most);
  if (least <= most)
    html += "The table's normal force " +
            (low == high ? "is " + low + " throughout." : "stays between " + low + " and " + high + ".");
  return html + "</p>\n";
}

std::string event_words(const std::string& name) {
  for (const ContactEventType& type : kContactEvents)
    if (type.name == name) return std::string(type.words);
  return name;
}

std::string events_html(const Run& run) {
  std::string html;
  for (std::size_t i = 0; const auto t_s = run.number(fmt::format("/contact/events/{}/t_s", i)); ++i) {
    const std::string at = fmt::format("/contact/events/{}/", i);
    const auto bound = run.number(at + "bound_s"), apart = run.number(at + "time_difference_s");
    html += fmt::format("<p>At {}, in the {} prediction: {}.", known_html(*t_s, bound.value_or(kNoNumber), "s"),
                        run.word(at + "prediction") == "rotating" ? "rotating" : "non-rotating",
                        escaped(event_words(run.word(at + "event"))));
    if (apart)
      html += fmt::format(" The Earth's rotation makes it {} {}.", number_html(std::abs(*apart), "s", 10),
                          *apart < 0 ? "earlier" : "later");
    html += "</p>\n";
  }
  return html;
}

/// How far the prediction itself moves with what nobody knows well.
std::string changes_html(const Run& run) {
  std::vector<std::vector<std::string>> rows;
  bool of_friction = false;
  for (std::size_t i = 0; const auto axis = run.number(fmt::format("/contact/prediction_changes/{}/axis_rad", i)); ++i) {
    const std::string at = fmt::format("/contact/prediction_changes/{}/", i), step = run.word(at + "step");
    of_friction = of_friction || step.ends_with("%");
    rows.push_back({escaped(run.word(at + "input")), escaped(step), number_html(*axis, "rad", 3),
                    number_html(run.number(at + "tip_m").value_or(kNoNumber), "m", 3)});
  }
  if (rows.empty()) return "";
  const double at_s = run.number("/contact/prediction_changes/0/at_s").value_or(kNoNumber);
  return fmt::format("<p>How far the prediction itself moves by {}, with inputs that nobody knows well:</p>\n",
                     number_html(at_s, "s")) +
         table_html({"input", "changed by", "axis moves by", "tip moves by"}, rows) +
         (of_friction
              ? "<p>Nobody knows a coefficient of friction to 1 %: the drift, with the same friction in both predictions, "
                "is well defined, the prediction is not.</p>\n"
              : "<p>Few tables are level to an arcsecond: the drift, on the same table in both predictions, is well "
                "defined, the prediction is not.</p>\n");
}

/// The effect of friction's work and of the Earth on the integrals of the motion, and how well both computed motions keep to it.
std::string balances_html(const Run& run) {
  std::vector<std::vector<std::string>> rows;
  for (const char* prediction : {"rotating", "reference"}) {
    const std::string words = prediction == std::string("rotating") ? "rotating" : "non-rotating";
    const auto add = [&](const char* name, const std::string& at, const char* first, const char* last, const char* integral,
                         const char* unit) {
      const auto from = run.number(at + first), to = run.number(at + last), gained = run.number(at + integral);
      if (!from || !to || !gained) return;
      rows.push_back({name, words, number_html(*to - *from, unit), number_html(*gained, unit),
                      number_html(run.number(at + "balance_over_size").value_or(kNoNumber), "", 2)});
    };
    add("Jacobi integral, by the work of friction", fmt::format("/contact/work/{}/", prediction), "jacobi_first_J",
        "jacobi_last_J", "slip_work_J", "J");
    add("Jellett's integral, by the Earth and friction's moment", fmt::format("/contact/jellett/{}/", prediction),
        "first_kg_m3_s", "last_kg_m3_s", "integral_kg_m3_s", "kg m³/s");
  }
  if (rows.empty()) return "";
  return "<p>The contact changes these quantities at a known rate; from the release to the last row:</p>\n" +
         table_html({"quantity", "prediction", "changes by", "integral of its rate", "relative difference"}, rows);
}

}  // namespace

std::string tip_drift_html(const Run& run, Page& page) { return seen_html(run) + path_html(run, page); }

std::string contact_section(const Run& run, Page& page) {
  const double drift = ends(values(run.listed, "drift_tip_m")).last, bound = ends(values(run.listed, "drift_tip_bound_m")).last;
  std::string html = page.chart("tip", tip_figure(run, run.drawn), tip_figure(run, run.listed),
                                "The distance of the two contact points and its parts. " + run.drawn_words);
  if (!run.listed.rows.empty() && run.listed.rows.back().t_s > 0 && std::isfinite(drift) && std::isfinite(bound))
    html += fmt::format("<p>At the end the distance is {}.</p>\n", known_html(drift, bound, length_unit(drift)));
  html += page.chart("force", force_figure(run, run.drawn), force_figure(run, run.listed),
                     "Slip of the contact point over the table, and the force of the table on it. " + run.drawn_words);
  html += events_html(run) + balances_html(run) + changes_html(run);
  return html + page.chart("tip-bound", tip_bound_figure(run), "On a logarithmic scale, at the output rows.");
}

}  // namespace earthtop::report
