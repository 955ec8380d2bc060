// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/frame_file.h"

#include <cmath>
#include <limits>
#include <string>

#include "deploy/operator/bench/input_lines.h"

namespace lodesman::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMaxPx = 1e6;  // of a centre or semi-axis: far beyond the view
constexpr std::int64_t kMaxPixel = std::numeric_limits<std::int16_t>::max();
constexpr std::size_t kMaxIdLength = 256;

// Reads the values of one object; `prefix` is its place in the line.
struct ObjectReader {
  const LinePlace& place;
  const Json& object;
  std::string prefix;

  [[nodiscard]] const Json& at(const char* key) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      place.refuse(prefix + key, "missing");
    }
    return *found;
  }

  [[nodiscard]] double number(const char* key, double min, double max, bool min_excluded) const {
    const Json& value = at(key);
    if (!value.is_number()) {
      place.refuse(prefix + key, "must be a number");
    }
    const auto read = value.get<double>();
    if (!(read >= min && read <= max) || (min_excluded && read <= min)) {
      const std::string low = min_excluded ? "greater than 0 and" : "at least -1e6 and";
      place.refuse(prefix + key, "must be " + low + " at most 1e6");
    }
    return read;
  }

  [[nodiscard]] std::int64_t integer(const std::string& key, const Json& value, std::int64_t min,
                                     std::int64_t max) const {
    if (!value.is_number_integer()) {
      place.refuse(prefix + key, "must be a whole number");
    }
    const bool huge =
        value.is_number_unsigned() &&
        value.get<std::uint64_t>() > std::uint64_t{std::numeric_limits<std::int64_t>::max()};
    if (huge || value.get<std::int64_t>() < min || value.get<std::int64_t>() > max) {
      place.refuse(prefix + key,
                   "must be from " + std::to_string(min) + " to " + std::to_string(max));
    }
    return value.get<std::int64_t>();
  }

  [[nodiscard]] PathPixel pixel(const char* key) const {
    const Json& value = at(key);
    if (!value.is_array() || value.size() != 2) {
      place.refuse(prefix + key, "must be [column, row]");
    }
    return {static_cast<std::int16_t>(integer(key, value[0], -kMaxPixel, kMaxPixel)),
            static_cast<std::int16_t>(integer(key, value[1], -kMaxPixel, kMaxPixel))};
  }
};

[[nodiscard]] EllipsePx ellipse_of(const ObjectReader& reader) {
  const PointPx centre{reader.number("cx", -kMaxPx, kMaxPx, false),
                       reader.number("cy", -kMaxPx, kMaxPx, false)};
  const double a = reader.number("a", 0.0, kMaxPx, true);
  const double b = reader.number("b", 0.0, kMaxPx, true);
  return EllipsePx::with_angle(centre, a, b, reader.number("theta_rad", -kMaxPx, kMaxPx, false));
}

[[nodiscard]] std::vector<EllipsePx> obstacles_of(const ObjectReader& frame) {
  const Json& list = frame.at("obstacles");
  if (!list.is_array() || list.size() > kMaxFrameObstacles) {
    frame.place.refuse("obstacles", "must be a list of at most " +
                                        std::to_string(kMaxFrameObstacles) + " ellipses");
  }
  std::vector<EllipsePx> ellipses;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string name = "obstacles[" + std::to_string(i) + "]";
    if (!list[i].is_object()) {
      frame.place.refuse(name, "must be an object");
    }
    ellipses.push_back(ellipse_of({frame.place, list[i], name + "."}));
  }
  return ellipses;
}

void read_known(const ObjectReader& frame, FrameQuery& query) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (const auto cost = frame.object.find("cost_10_14"); cost != frame.object.end()) {
    query.knows_cost = true;
    if (!cost->is_null()) {
      query.known_cost_10_14 =
          static_cast<std::int32_t>(frame.integer("cost_10_14", *cost, 0, kMost));
    }
  }
  if (const auto free = frame.object.find("free_px"); free != frame.object.end()) {
    query.known_free_px = static_cast<std::uint32_t>(frame.integer("free_px", *free, 0, kMost));
  }
}

[[nodiscard]] FrameQuery frame_of(const LinePlace& place, const std::string& line) {
  Json object;
  try {
    object = Json::parse(line);
  } catch (const Json::parse_error& error) {
    place.refuse("json", "not JSON from character " + std::to_string(error.byte) + " on");
  } catch (const Json::exception&) {
    place.refuse("json", "holds a number that is too large");
  }
  if (!object.is_object()) {
    place.refuse("json", "must be an object");
  }
  const ObjectReader reader{place, object, ""};
  FrameQuery query;
  query.id = reader.at("id");
  const bool text = query.id.is_string() && query.id.get<std::string>().size() <= kMaxIdLength;
  if (!query.id.is_number_integer() && !text) {
    place.refuse("id", "must be a whole number or a text of at most 256 characters");
  }
  query.start = reader.pixel("start_px");
  query.goal = reader.pixel("goal_px");
  query.obstacles = obstacles_of(reader);
  read_known(reader, query);
  return query;
}

}  // namespace

std::vector<FrameQuery> read_frames(const std::filesystem::path& file) {
  const std::vector<std::string> lines = read_lines(file, kMaxFrameFileBytes);
  std::vector<FrameQuery> frames;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].find_first_not_of(" \t") != std::string::npos) {
      frames.push_back(frame_of({file, i + 1}, lines[i]));
    }
  }
  if (frames.empty()) {
    LinePlace{file, 1}.refuse("file", "holds no frame");
  }
  return frames;
}

}  // namespace lodesman::cli
