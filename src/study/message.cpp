// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/message.hpp"

namespace earthtop::study {
namespace {

enum : std::uint64_t { kNothing, kNumber, kWord };

void put_value(const Value& value, MessageWriter& writer) {
  if (const auto* number = std::get_if<double>(&value)) {
    writer.put(std::uint64_t{kNumber});
    writer.put(*number);
  } else if (const auto* word = std::get_if<std::string>(&value)) {
    writer.put(std::uint64_t{kWord});
    writer.put(std::string_view(*word));
  } else {
    writer.put(std::uint64_t{kNothing});
  }
}

Value take_value(MessageReader& reader) {
  switch (reader.number()) {
    case kNumber: return reader.real();
    case kWord: return reader.text();
    default: return {};
  }
}

void put_values(const std::vector<Value>& values, MessageWriter& writer) {
  writer.put(std::uint64_t{values.size()});
  for (const Value& value : values) put_value(value, writer);
}

std::vector<Value> take_values(MessageReader& reader) {
  std::vector<Value> values;
  for (std::uint64_t n = reader.number(); n > 0; --n) values.push_back(take_value(reader));
  return values;
}

}  // namespace

std::string to_message(const Chunk& chunk) {
  MessageWriter writer;
  writer.put(std::uint64_t{chunk.size()});
  for (const PlannedPoint& point : chunk) {
    writer.put(point.number);
    writer.put(std::uint64_t{point.settings.size()});
    for (const Setting& setting : point.settings) {
      writer.put(std::uint64_t{setting.at_base});
      writer.put(setting.level);
      writer.put(setting.fraction);
    }
  }
  return writer.bytes();
}

Chunk chunk_from(std::string_view bytes) {
  MessageReader reader(bytes);
  Chunk chunk;
  for (std::uint64_t n = reader.number(); n > 0; --n) {
    PlannedPoint& point = chunk.emplace_back();
    point.number = reader.number();
    for (std::uint64_t axes = reader.number(); axes > 0; --axes) {
      Setting setting;
      setting.at_base = reader.number() != 0;
      setting.level = reader.number();
      setting.fraction = reader.real();
      point.settings.push_back(setting);
    }
  }
  return chunk;
}

std::string to_message(const std::vector<PointResult>& results) {
  MessageWriter writer;
  writer.put(std::uint64_t{results.size()});
  for (const PointResult& point : results) {
    writer.put(point.number);
    put_values(point.axis_values, writer);
    for (const std::string* text : {&point.status, &point.reason, &point.scenario_sha256}) writer.put(std::string_view(*text));
    put_values(point.values, writer);
  }
  return writer.bytes();
}

std::vector<PointResult> results_from(std::string_view bytes) {
  MessageReader reader(bytes);
  std::vector<PointResult> results;
  for (std::uint64_t n = reader.number(); n > 0; --n) {
    PointResult& point = results.emplace_back();
    point.number = reader.number();
    point.axis_values = take_values(reader);
    for (std::string* text : {&point.status, &point.reason, &point.scenario_sha256}) *text = reader.text();
    point.values = take_values(reader);
  }
  return results;
}

}  // namespace earthtop::study
