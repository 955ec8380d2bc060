// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/viewer_json.h"

#include <cmath>
#include <numbers>

namespace lodesman::viewer {
namespace {

constexpr double kHeight_m = 1.0;
constexpr double kThinLine_m = 0.08;
constexpr int kLineStrip = 0;  // of LinePrimitive
constexpr int kLineLoop = 1;
constexpr int kCorners = 32;  // of an ellipse's edge

[[nodiscard]] Json number() { return {{"type", "number"}}; }
[[nodiscard]] Json text() { return {{"type", "string"}}; }
[[nodiscard]] Json integer() { return {{"type", "integer"}}; }
[[nodiscard]] Json list_of(const Json& items) { return {{"type", "array"}, {"items", items}}; }

// All of its members are there.
[[nodiscard]] Json object(const char* title, const Json& members) {
  Json names = Json::array();
  for (const auto& member : members.items()) {
    names.push_back(member.key());
  }
  return {{"title", title}, {"type", "object"}, {"properties", members}, {"required", names}};
}

[[nodiscard]] Json time_schema() {
  return object("time", {{"sec", integer()}, {"nsec", integer()}});
}
[[nodiscard]] Json vector_schema() {
  return object("foxglove.Vector3", {{"x", number()}, {"y", number()}, {"z", number()}});
}
[[nodiscard]] Json rotation_schema() {
  return object("foxglove.Quaternion",
                {{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}
[[nodiscard]] Json pose_schema() {
  return object("foxglove.Pose",
                {{"position", vector_schema()}, {"orientation", rotation_schema()}});
}
[[nodiscard]] Json colour_schema() {
  return object("foxglove.Color",
                {{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

[[nodiscard]] Json line_schema() {
  return object("foxglove.LinePrimitive", {{"type", integer()},
                                           {"pose", pose_schema()},
                                           {"thickness", number()},
                                           {"scale_invariant", {{"type", "boolean"}}},
                                           {"points", list_of(vector_schema())},
                                           {"color", colour_schema()},
                                           {"colors", list_of(colour_schema())},
                                           {"indices", list_of(integer())}});
}

// A cube or sphere; a cylinder has two more.
[[nodiscard]] Json solid_schema(const char* title, bool is_cylinder) {
  Json members{{"pose", pose_schema()}, {"size", vector_schema()}, {"color", colour_schema()}};
  if (is_cylinder) {
    members["bottom_scale"] = number();
    members["top_scale"] = number();
  }
  return object(title, members);
}

[[nodiscard]] Json entity_schema() {
  const Json none = list_of({{"type", "object"}});  // kinds of things that are never drawn here
  return object("foxglove.SceneEntity",
                {{"timestamp", time_schema()},
                 {"frame_id", text()},
                 {"id", text()},
                 {"lifetime", time_schema()},
                 {"frame_locked", {{"type", "boolean"}}},
                 {"metadata", none},
                 {"arrows", none},
                 {"cubes", list_of(solid_schema("foxglove.CubePrimitive", false))},
                 {"spheres", list_of(solid_schema("foxglove.SpherePrimitive", false))},
                 {"cylinders", list_of(solid_schema("foxglove.CylinderPrimitive", true))},
                 {"lines", list_of(line_schema())},
                 {"triangles", none},
                 {"texts", none},
                 {"models", none}});
}

[[nodiscard]] std::vector<Point> edge_of(const Obstacle& o, double first_m, double second_m) {
  std::vector<Point> edge;
  for (int i = 0; i < kCorners; ++i) {
    const double around = 2.0 * std::numbers::pi * i / kCorners;
    const double along = first_m * std::cos(around);    // the first semi-axis
    const double across = second_m * std::sin(around);  // to its right
    edge.push_back({o.centre_x_m + along * std::sin(o.angle_rad) + across * std::cos(o.angle_rad),
                    o.centre_y_m + along * std::cos(o.angle_rad) - across * std::sin(o.angle_rad)});
  }
  return edge;
}

[[nodiscard]] std::vector<Point> vertices_of(const Obstacle& o) {
  std::vector<Point> points;
  for (std::uint32_t i = 0; i < o.vertex_count; ++i) {
    points.push_back({o.vertices[i].x_m, o.vertices[i].y_m});
  }
  return points;
}

}  // namespace

Shape frame_transforms() {
  const Json transform = object("foxglove.FrameTransform", {{"timestamp", time_schema()},
                                                            {"parent_frame_id", text()},
                                                            {"child_frame_id", text()},
                                                            {"translation", vector_schema()},
                                                            {"rotation", rotation_schema()}});
  constexpr const char* kName = "foxglove.FrameTransforms";
  return {kName, object(kName, {{"transforms", list_of(transform)}})};
}

Shape location_fix() {
  constexpr const char* kName = "foxglove.LocationFix";
  return {kName, object(kName, {{"timestamp", time_schema()},
                                {"frame_id", text()},
                                {"latitude", number()},
                                {"longitude", number()},
                                {"altitude", number()},
                                {"position_covariance", list_of(number())},
                                {"position_covariance_type", integer()}})};
}

Shape log_entry() {
  constexpr const char* kName = "foxglove.Log";
  return {kName, object(kName, {{"timestamp", time_schema()},
                                {"level", integer()},
                                {"message", text()},
                                {"name", text()},
                                {"file", text()},
                                {"line", integer()}})};
}

Shape poses_in_frame() {
  constexpr const char* kName = "foxglove.PosesInFrame";
  return {kName, object(kName, {{"timestamp", time_schema()},
                                {"frame_id", text()},
                                {"poses", list_of(pose_schema())}})};
}

Shape compressed_image() {
  constexpr const char* kName = "foxglove.CompressedImage";
  return {kName, object(kName, {{"timestamp", time_schema()},
                                {"frame_id", text()},
                                {"data", {{"type", "string"}, {"contentEncoding", "base64"}}},
                                {"format", text()}})};
}

Shape scene_update() {
  const Json deletion = object("foxglove.SceneEntityDeletion",
                               {{"timestamp", time_schema()}, {"type", integer()}, {"id", text()}});
  constexpr const char* kName = "foxglove.SceneUpdate";
  return {kName, object(kName, {{"deletions", list_of(deletion)},
                                {"entities", list_of(entity_schema())}})};
}

Json time(Time at) {
  const std::int64_t ns = at.time_since_epoch().count();
  return {{"sec", ns / 1'000'000'000}, {"nsec", ns % 1'000'000'000}};
}

Json vector(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }

Json rotation(double clockwise_rad) {
  return {{"x", 0.0},
          {"y", 0.0},
          {"z", -std::sin(0.5 * clockwise_rad)},
          {"w", std::cos(0.5 * clockwise_rad)}};
}

Json pose(const Point& place, double clockwise_rad) {
  return {{"position", vector(place.x_m, place.y_m, 0.0)},
          {"orientation", rotation(clockwise_rad)}};
}

Json colour(const Colour& colour) {
  return {{"r", colour.r}, {"g", colour.g}, {"b", colour.b}, {"a", colour.a}};
}

Json entity(const char* frame, const char* id, Time at) {
  const Json none = Json::array();
  return {{"timestamp", time(at)}, {"frame_id", frame}, {"id", id},
          {"lifetime", time({})},  // without end
          {"frame_locked", true},  {"metadata", none},  {"arrows", none},
          {"cubes", none},         {"spheres", none},   {"cylinders", none},
          {"lines", none},         {"triangles", none}, {"texts", none},
          {"models", none}};
}

Json update_of(Json entity) {
  Json entities = Json::array();
  entities.push_back(std::move(entity));
  return {{"deletions", Json::array()}, {"entities", std::move(entities)}};
}

Json line(const std::vector<Point>& points, bool closed, double thickness_m,
          const Colour& in_colour) {
  Json places = Json::array();
  for (const Point& point : points) {
    places.push_back(vector(point.x_m, point.y_m, 0.0));
  }
  return {{"type", closed ? kLineLoop : kLineStrip},
          {"pose", pose({}, 0.0)},
          {"thickness", thickness_m},
          {"scale_invariant", false},
          {"points", places},
          {"color", colour(in_colour)},
          {"colors", Json::array()},
          {"indices", Json::array()}};
}

void add_body(Json& entity, const Obstacle& o, const Colour& in_colour) {
  if (o.shape != ObstacleShape::kEllipse) {
    entity["lines"].push_back(
        line(vertices_of(o), o.shape == ObstacleShape::kPolygon, 2.0 * kThinLine_m, in_colour));
    return;
  }
  // Its first semi-axis lies along y before it is turned.
  entity["cylinders"].push_back(
      {{"pose", pose({o.centre_x_m, o.centre_y_m}, o.angle_rad)},
       {"size", vector(2.0 * o.semi_axis_second_m, 2.0 * o.semi_axis_first_m, kHeight_m)},
       {"bottom_scale", 1.0},
       {"top_scale", 1.0},
       {"color", colour(in_colour)}});
}

void add_zone(Json& entity, const Obstacle& o, const Colour& in_colour) {
  if (o.shape == ObstacleShape::kEllipse) {
    entity["lines"].push_back(line(edge_of(o, o.protection_first_m, o.protection_second_m), true,
                                   kThinLine_m, in_colour));
  } else {
    // As wide as it keeps things off.
    entity["lines"].push_back(line(vertices_of(o), o.shape == ObstacleShape::kPolygon,
                                   2.0 * o.protection_first_m,
                                   {in_colour.r, in_colour.g, in_colour.b, 0.2}));
  }
}

std::string base64(const std::vector<unsigned char>& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < count ? bytes[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace lodesman::viewer
