// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/study_points.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "report/study_cells.hpp"
#include "report/study_words.hpp"
#include "study/design.hpp"

namespace earthtop::report {
namespace {

constexpr std::size_t kCellsAcross = 32, kCellsUp = 20;

void stop_if_asked(const Watch& watch) {
  if (watch.asks_to_stop()) throw Interrupted();
}

Json json_of(const study::Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  return nullptr;
}

/// The changes of the base that make a point, as the page keeps them: its value for each pointer of the study's axes; nothing
/// where an axis leaves the base as it is.
class Changes {
 public:
  explicit Changes(const Study& study) : study_(study), design_(study) {
    for (const StudyAxis& axis : study.axes) pointers_.insert(pointers_.end(), axis.pointers.begin(), axis.pointers.end());
  }
  const std::vector<std::string>& pointers() const { return pointers_; }
  /// @param number  not less than that of the previous call
  Json of(std::uint64_t number) {
    Json values = std::vector<Json>(pointers_.size());
    for (const input::TreeChange& change : study::point_changes(study_, design_.point(number))) {
      const auto at = std::find(pointers_.begin(), pointers_.end(), change.pointer);
      if (at == pointers_.end()) continue;
      const auto* number_given = std::get_if<double>(&change.value);
      values[static_cast<std::size_t>(at - pointers_.begin())] =
          number_given ? Json(*number_given) : Json::parse(std::get<std::string>(change.value));
    }
    return values;
  }

 private:
  const Study& study_;
  study::Design design_;
  std::vector<std::string> pointers_;
};

void add_single_points(study::Store& store, Json& data, const Watch& watch) {
  const Study& study = store.study();
  const bool drawn = is_drawn(study.design.kind);  // what is drawn has no digits that were meant
  Changes changes(study);
  for (std::size_t i = 0; i < study.axes.size(); ++i) data["axes"][i]["values"] = Json::array();
  Json& points = data["points"] = Json::array();
  store.for_each([&](const study::PointResult& point) {
    stop_if_asked(watch);
    Json coordinates = Json::array(), values = Json::array();
    for (std::size_t i = 0; i < study.axes.size(); ++i) {
      const study::Value& setting = point.axis_values[i];
      const Json x = json_of(drawn ? setting : study::meant_value(study.axes[i], setting));
      Json& known = data["axes"][i]["values"];
      const auto at = std::find(known.begin(), known.end(), x);
      coordinates.push_back(at - known.begin());
      if (at == known.end()) known.push_back(x);
    }
    for (const study::Value& value : point.values) values.push_back(json_of(value));
    points.push_back({{"number", point.number},
                      {"axes", std::move(coordinates)},
                      {"values", std::move(values)},
                      {"set", changes.of(point.number)}});
  });
}

void add_cells(study::Store& store, Json& data, const Watch& watch) {
  const Study& study = store.study();
  std::vector<CellScale> axes(study.axes.size(), CellScale(kCellsAcross)),
      quantities(study.quantities.size(), CellScale(kCellsUp));
  store.for_each([&](const study::PointResult& point) {
    stop_if_asked(watch);
    for (std::size_t i = 0; i < axes.size(); ++i) axes[i].include(point.axis_values[i]);
    for (std::size_t q = 0; q < quantities.size(); ++q) quantities[q].include(point.values[q]);
  });
  for (CellScale& scale : axes) scale.divide();
  for (CellScale& scale : quantities) scale.divide();

  std::vector<CellPicture> pictures = cell_pictures(axes.size(), quantities.size());
  store.for_each([&](const study::PointResult& point) {
    stop_if_asked(watch);
    for (CellPicture& picture : pictures) {
      const auto* value = std::get_if<double>(&point.values[picture.quantity]);
      const auto i = axes[picture.across].cell(point.axis_values[picture.across]);
      const auto j = picture.up ? axes[*picture.up].cell(point.axis_values[*picture.up])
                                : quantities[picture.quantity].cell(point.values[picture.quantity]);
      if (value && i && j) picture.cells[{*i, *j}].include(point.number, *value);
    }
  });

  for (std::size_t i = 0; i < axes.size(); ++i) data["axes"][i]["scale"] = axes[i].json();
  data["scales"] = Json::array();
  for (const CellScale& scale : quantities) data["scales"].push_back(scale.json());
  std::set<std::uint64_t> examples;
  Json& shown = data["pictures"] = Json::array();
  for (const CellPicture& picture : pictures) {
    Json cells = Json::array();
    for (const auto& [at, cell] : picture.cells) {
      cells.push_back({at.first, at.second, cell.count, cell.mean, cell.example});
      examples.insert(cell.example);
    }
    if (!picture.cells.empty())
      shown.push_back({{"quantity", picture.quantity},
                       {"across", picture.across},
                       {"up", picture.up ? Json(*picture.up) : Json()},
                       {"cells", std::move(cells)}});
  }
  Changes changes(study);
  Json& list = data["examples"] = Json::object();
  for (const std::uint64_t number : examples) list[std::to_string(number)] = changes.of(number);
}

}  // namespace

void add_points(study::Store& store, Page& page, const Json& document, const Watch& watch) {
  const Study& study = store.study();
  Json& data = page.data();
  data["base"] = study.base.text;
  data["fixed"] = Json::array();
  for (const auto& [pointer, value] : study.set) data["fixed"].push_back({pointer, value});
  data["pointers"] = Json::array();
  data["axes"] = Json::array();
  for (const StudyAxis& axis : study.axes) {
    data["axes"].push_back({{"name", axis.name}});
    for (const std::string& pointer : axis.pointers) data["pointers"].push_back(pointer);
  }
  data["quantities"] = Json::array();
  for (const StudyQuantity& quantity : study.quantities) data["quantities"].push_back(quantity.name);
  Json& words = data["words"] = {{"axes", Json::array()}, {"quantities", Json::array()}};
  for (const StudyColumn& setting : settings_of(document))
    words["axes"].push_back({{"words", setting.words}, {"unit", setting.unit}});
  for (const StudyColumn& quantity : quantities_of(document))
    words["quantities"].push_back({{"words", quantity.words}, {"unit", quantity.unit}, {"factor", quantity.factor}});
  if (store.count() <= kMostSinglePoints)
    add_single_points(store, data, watch);
  else
    add_cells(store, data, watch);
}

}  // namespace earthtop::report
