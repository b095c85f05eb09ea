// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "earthtop/budget/budget.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/error.hpp"
#include "earthtop/model/gimbal_ledger.hpp"
#include "earthtop/model/ledger.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/results/top_lines.hpp"
#include "report/bars.hpp"
#include "report/contact_section.hpp"
#include "report/drift_section.hpp"
#include "report/finding.hpp"
#include "report/first_figure.hpp"
#include "report/journey_section.hpp"
#include "report/motion_data.hpp"
#include "report/pages.hpp"
#include "report/path_picture.hpp"
#include "report/run_data.hpp"
#include "report/seen.hpp"
#include "report/shell.hpp"
#include "report/thinning.hpp"
#include "report/top_still.hpp"
#include "results/seal.hpp"
#include "run/playable.hpp"
#include "scene/parts.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

using compare::Row;

constexpr std::size_t kMostArrows = 200;  // number of times at most at which torques are computed for the animation
constexpr double kBudgetSteps = 3e5;      // about a second; with more steps the bars of the ledger are left out

void append(Json& list, const Vec3<double>& vector) {
  for (int i = 0; i < 3; ++i) list.push_back(Json::parse(fmt::format("{:.4g}", vector[i])));
}

using Torques = std::array<Vec3<double>, 4>;
constexpr const char* kTorqueNames[] = {"gravity_N_m", "coriolis_N_m", "transverse_N_m", "centrifugal_N_m"};

Torques torques_at(const Model<double>& model, const Row& row) {
  static const std::size_t q = column("q_LB_w"), w = column("w_LB_B_x_rad_s"), rate = column("rotor_rate_rad_s"),
                           angles = column("outer_angle_rad");  // the inner angle and both rates follow
  const Quaternion<double> q_LB{row.value[q], Vec3<double>(row.value[q + 1], row.value[q + 2], row.value[q + 3])};
  const Vec3<double> w_LB_B(row.value[w], row.value[w + 1], row.value[w + 2]);
  const bool in_gimbals = model.kind == SceneKind::suspension;
  const double spin = (in_gimbals || model.kind == SceneKind::gyrostat) && model.rotor.axial > 0 ? row.value[rate] : 0;
  const LedgerEntry<double> entry =
      in_gimbals ? ledger_entry_in_gimbals(
                       LedgerObserver::laboratory, model, row.t_s,
                       {row.value[angles], row.value[angles + 1], row.value[angles + 2], row.value[angles + 3]}, spin)
                 : ledger_entry(LedgerObserver::laboratory, model, row.t_s, q_LB, w_LB_B, spin);
  return {entry.tau_phys_A, entry.tau_cor_A, entry.tau_trans_A, entry.tau_cent_A};
}

/// The torques that the laboratory observer counts, at some times. Between the rows of a resolved motion that these leave out, they are
/// means over neighbouring ones, with shares that fall to zero: torques that swing faster than the arrows can tell do not seem to
/// swing slowly.
Json torques_of(const Run& run, const Model<double>& model) {
  Json json = {{"t_s", Json::array()},
               {"others_applied", run.scene->scenario().effects.applied.any()}};  // then summed with gravity
  for (const char* name : kTorqueNames) json[name] = Json::array();
  // A row of means over windows has no attitude: of a window the mean of its torques is taken.
  const Motion& motion = run.played_is_mean ? run.drawn : run.played;
  const std::size_t count = motion.rows.size(), a_window = motion.a_window;
  const std::size_t stride = a_window > 0 ? a_window : std::max<std::size_t>(1, (count + kMostArrows - 1) / kMostArrows);
  const std::size_t reach = a_window > 0 ? a_window / 2 : motion.is_resolved && stride > 1 ? 2 * stride : 0;
  std::vector<Torques> all;
  if (reach > 0)
    for (const Row& row : motion.rows) all.push_back(torques_at(model, row));
  for (std::size_t i = a_window / 2; i < count; i += stride) {
    Torques mean;
    mean.fill(Vec3<double>(0, 0, 0));
    double weights = 0;
    const std::size_t here = std::min({reach, i, count - 1 - i});  // the same on both sides
    for (std::size_t k = i - here; k <= i + here; ++k) {
      const double place = (static_cast<double>(k) - static_cast<double>(i)) / (static_cast<double>(here) + 1);
      const double weight = (1 - place * place) * (1 - place * place);
      const Torques torques = reach > 0 ? all[k] : torques_at(model, motion.rows[k]);
      for (std::size_t n = 0; n < mean.size(); ++n) mean[n] += weight * torques[n];
      weights += weight;
    }
    json["t_s"].push_back(Json::parse(fmt::format("{:.6g}", motion.rows[i].t_s)));
    for (std::size_t n = 0; n < mean.size(); ++n) append(json[kTorqueNames[n]], Vec3<double>(mean[n] / weights));
  }
  return json;
}

/// The largest torque of apparent gravity about the pivot over the motion that is drawn (N m).
double largest_gravity(const Run& run) {
  const Model<double>& model = run.scene->model<double>();
  const ModelInTime<double> in_time(model);
  const std::size_t axis = column("q_LB_w");
  double largest = 0;
  for (const Row& row : run.drawn.rows) {
    const Quaternion<double> q_LB{row.value[axis], Vec3<double>(row.value[axis + 1], row.value[axis + 2], row.value[axis + 3])};
    const Vec3<double> moment_L = Rotation<double>(q_LB) * in_time.at(row.t_s).mass_moment_B;
    largest = std::max(largest, moment_L.cross(model.apparent_gravity_L).norm());
  }
  return largest;
}

std::string torques_html(const Run& run, Page& page) {
  if (!run.scene) return "<p>Not computed: this version does not follow such a scene.</p>\n";
  if (run.scene->costs()[0].work.steps > kBudgetSteps)
    return "<p>Not computed here for a run of this length; earthtop explain computes them.</p>\n";
  const Budget budget = effect_budget(*run.scene, run.watch);
  if (run.watch.asks_to_stop()) throw Interrupted();
  std::vector<Bar> bars;
  std::vector<std::vector<std::string>> rows;
  if (const double gravity = largest_gravity(run); gravity > 0) {
    bars.push_back({"gravity", gravity, false});
    rows.push_back({"gravity", "modelled", number_html(gravity, "N m", 3), "", "always"});
  }
  for (const EffectEntry& effect : budget.effects) {
    const auto shown = [](const std::optional<double>& number) { return number ? number_html(*number, "", 3) : std::string(); };
    rows.push_back({escaped(effect.name), effect.modelled ? "modelled" : "left out", shown(effect.torque_largest_N_m),
                    shown(effect.drift_rad), escaped(effect.reason)});
    if (effect.torque_largest_N_m && *effect.torque_largest_N_m > 0)
      bars.push_back({effect.name, *effect.torque_largest_N_m, !effect.modelled});
  }
  std::string table = table_html({"effect", "", "largest torque (N m)", "changes the drift by (rad)", "why"}, rows);
  if (bars.empty()) return table;
  return page.picture("torques", bars_svg("torques", "Largest torques", "N m", bars), "Solid: modelled. Hatched: left out.",
                      table);
}

std::string ledger_section(const Run& run, Page& page) {
  try {
    return torques_html(run, page);
  } catch (const ScenarioError& error) {  // the results are there, but this version does not follow such a scene
    return fmt::format("<p>Not computed: {}.</p>\n",
                       escaped(error.diagnostics().empty() ? error.what() : error.diagnostics()[0].message));
  }
}

std::string top_section(const Run& run) {
  Facts facts;
  for (const auto& [label, text] : top_lines(run.scene->top())) facts.emplace_back(label, escaped(text));
  return facts_html(facts);
}

std::string invariants_section(const Run& run) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& invariant : run.results.summary->value("invariants", Json::array())) {
    const double change = invariant.value("largest_change", kNoNumber), scale = invariant.value("scale", kNoNumber);
    rows.push_back({escaped(invariant.value("name", "")),
                    number_html(invariant.value("initial", kNoNumber), invariant.value("unit", "")), number_html(change, "", 3),
                    number_html(share_of(change, scale).value_or(kNoNumber), "", 3)});
  }
  if (rows.empty()) return "<p>No conserved quantity is followed in this run.</p>\n";
  return table_html({"quantity", "at release", "largest change", "relative to its largest term"}, rows);
}

std::string numerics_section(const Run& run) {
  std::vector<std::vector<std::string>> rows;
  const double duration = run.number("/outcome/reached_s").value_or(0);
  for (const char* part : {"solution", "certificate"}) {
    const std::string at = std::string("/") + part + "/";
    const double steps = run.number(at + "steps_accepted").value_or(0);
    rows.push_back({part, escaped(run.word(at + "method")), escaped(run.word(at + "observer")), escaped(run.word(at + "model")),
                    escaped(run.word(at + "precision")), fmt::format("{:g}", run.number(at + "relative_tolerance").value_or(0)),
                    fmt::format("{:.0f}", steps), fmt::format("{:.0f}", run.number(at + "steps_rejected").value_or(0)),
                    steps > 0 ? number_html(duration / steps, "", 3) : "",
                    fmt::format("{:.0f}", run.number(at + "right_hand_side_evaluations").value_or(0))});
  }
  return table_html(
      {"", "method", "observer", "model", "precision", "tolerance", "steps", "rejected", "mean step (s)", "evaluations"}, rows);
}

std::string provenance_section(const Run& run) {
  Facts facts;
  for (const char* key : {"program", "version", "commit", "compiler", "flags", "scenario_sha256"})
    facts.emplace_back(key, escaped(run.word(std::string("/provenance/") + key)));
  for (const Json& constant : run.results.summary->value(Json::json_pointer("/provenance/constants"), Json::array()))
    facts.emplace_back(constant.value("name", ""),
                       number_html(constant.value("value", kNoNumber), constant.value("unit", ""), 12) + ", " +
                           escaped(constant.value("source", "")));
  return facts_html(facts);
}

constexpr const char* kSphere =
    R"html(<figure class="scene"><canvas id="sphere" width="640" height="480" tabindex="0" role="img"
 aria-label="Path of the spin axis on the unit sphere, both predictions; arrow keys turn it"></canvas>
<p id="sphere-state" aria-live="polite"></p></figure>
)html";
/// The place of what makes the motions differ in the next text.
constexpr std::string_view kCausePlace = "CAUSE";
constexpr const char* kAnimation =
    R"html(<figure class="scene"><canvas id="top" width="860" height="520" tabindex="0" role="img"
 aria-label="The top in motion, with CAUSE and without, the cone of its axis and the Earth's axis; space stops it and starts it"></canvas>
<div class="controls"><button type="button" id="play">Play</button>
<input id="time" type="range" min="0" max="1000" value="0" aria-label="Time">
<label><input id="arrows" type="checkbox"> Torques</label> <output id="clock"></output></div></figure>
)html";

std::string animation_html(const Run& run) {
  std::string html = kAnimation;
  return html.replace(html.find(kCausePlace), kCausePlace.size(), escaped(run.compared().cause));
}

/// The top at the last time at which its drift can be trusted.
std::string still_html(const Run& run, Page& page) {
  const Trust trust(run);
  const std::vector<Row>& rows = run.listed.rows;
  const auto last = std::find_if(rows.rbegin(), rows.rend(), [&](const Row& row) { return trust.at(row.t_s); });
  if (!run.scene || run.has_contact || last == rows.rend()) return "";
  const auto direction = [&](const char* first) {
    const std::size_t at = column(first);
    return std::array{value(*last, at), value(*last, at + 1), value(*last, at + 2)};
  };
  TopStill still;
  still.cause = run.compared().cause;
  still.axis_L = direction("axis_L_x"), still.ref_axis_L = direction("ref_axis_L_x");
  const auto is_finite = [](const std::array<double, 3>& v) {
    return std::ranges::all_of(v, [](double x) { return std::isfinite(x); });
  };
  if (!is_finite(still.axis_L) || !is_finite(still.ref_axis_L)) return "";
  const Vec3<double> rate_L = earth_rate_L(*run.scene, last->t_s);
  still.earth_rate_L = {rate_L[0], rate_L[1], rate_L[2]};
  still.hangs = run.scene->top().center_of_mass_m[2] < 0;
  const auto [low, high] = std::ranges::minmax(values(run.drawn, "axis_L_z"));
  constexpr double kSteady = 0.1;  // of the axis's height, as far as a cone is one
  still.has_cone = high - low < kSteady;
  still.title = fmt::format("The top after {} s", fmt::format("{:g}", last->t_s));
  const double factor = magnification(still);
  still.subtitle = factor > 1 ? fmt::format("The angle between the two axes is drawn {:g} times as large as it is", factor)
                              : "The angle between the two axes is drawn as it is";
  return page.still("top", top_still_svg(still));
}

Run read_run(const std::filesystem::path& directory, const Watch& watch) {
  Run run;
  run.results = compare::open_comparand(directory, nullptr);
  run.watch = watch;
  const ScenarioReport report = examine_scenario({"", run.results.summary->value("scenario", Json()).dump(), false});
  run.scene = report.scene;
  const auto rows = run.results.open_rows();
  for (const char* needed : {"axis_L_x", "ref_axis_L_x", "drift_axis_rad", "q_LB_w", "w_LB_B_x_rad_s"})
    if (!rows->has_column(column(needed)))
      refuse_file(directory, fmt::format("its trajectory.csv has no {}; run the scenario again", needed));
  const auto& measures = compare::trajectory_table().measures;
  run.has_contact = std::all_of(measures.begin(), measures.end(), [&](const compare::Measure& measure) {
    return measure.owner != RowOwner::contact || rows->has(measure);
  });
  run.listed.rows = thinned_rows(*rows, run.results.stated_rows.value_or(0), watch);
  if (!run.listed.rows.empty()) run.time = time_unit(run.listed.rows.back().t_s);
  see_motion(run);
  return run;
}

/// Whether the page to play with runs the scene, and why not.
std::string played_html(const Run& run) {
  if (!run.scene) return "";
  const std::string why_not = unplayable(*run.scene);
  if (why_not.empty()) {
    std::string name = run.scene->scenario().name;
    std::replace(name.begin(), name.end(), '-', ' ');
    return fmt::format("The page to play with runs this scene, too: it is <code>{}</code> there.", escaped(name));
  }
  return fmt::format("The page to play with does not run this scene: {}.", escaped(why_not.substr(0, why_not.find("; "))));
}

}  // namespace

Report run_page(const std::filesystem::path& directory, const Watch& watch, const std::string& gallery) {
  const Run run = read_run(directory, watch);
  std::vector<std::string> notes;
  for (const std::filesystem::path& path : run.results.unverified) notes.push_back(unverified(path));
  Page page("run", title_of(run), std::move(notes));
  page.group(group_of(run));
  if (!gallery.empty()) page.belongs_to(gallery, played_html(run));
  page.finding(finding_html(run));
  page.headline(measure_html(run));
  page.verdict(run.word("/drift/verdict"), trust_html(run));
  add_motion(run, page.data());
  // The table's force acts on a top that stands on one, and its tip moves: these torques would not add up.
  if (run.scene && !run.has_contact) page.data()["torques"] = torques_of(run, model_of_rows<double>(*run.scene));
  const std::string played = "<p class=\"note\">" + escaped(run.played_words) + "</p>\n";
  const auto add_drift = [&] { page.section("drift", "Drift", drift_section(run, page) + drift_events_html(run)); };
  const bool is_told = add_first_figure(run, page);
  // Where the charts show the same times, their captions say so.
  page.section("motion", "The top in motion",
               animation_html(run) + still_html(run, page) + (run.played_words == run.drawn_words ? "" : played));
  if (!is_told) add_drift();
  if (run.has_contact) page.section("tip", "On the table", tip_drift_html(run, page));
  add_journey(run, page);
  if (const std::string why = why_html(run); !why.empty()) page.section("why", "Why", why);
  page.fold("protocol", "Protocol");
  if (run.scene) page.section("your-top", "Your top", top_section(run));
  if (is_told) add_drift();
  if (run.has_contact) page.section("table", "Contact with the table", contact_section(run, page));
  page.section("bound", "Trend and error", bound_section(run, page));
  page.section("sphere", "Path of the axis", kSphere + played);
  page.section("torques", "Torques", ledger_section(run, page));
  page.section("invariants", "Conserved quantities", invariants_section(run));
  page.section("numerics", "Steps", numerics_section(run));
  const Json scenario = run.results.summary->value("scenario", Json());
  page.section("scenario", "Scenario",
               "<p>With every default filled in.</p>\n<pre class=\"scroll\" tabindex=\"0\">" +
                   escaped(scenario.dump(2, ' ', false, Json::error_handler_t::replace)) + "</pre>\n");
  page.section("provenance", "Provenance", provenance_section(run));
  page.section(
      "command", "Make it again",
      Page::command(with_input("earthtop run - --out again", scenario.dump(-1, ' ', false, Json::error_handler_t::replace)) +
                    "earthtop report again\n"));
  return page.finish();
}

}  // namespace earthtop::report
