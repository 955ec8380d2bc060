// SPDX-License-Identifier: Apache-2.0
// The shapes that people's viewers draw (Foxglove's schemas), as JSON, and JSON Schemas that
// describe them. Frames: `world` as ours, x east and y north; `vehicle` as ours, x to starboard and
// y ahead; a rotation takes the vehicle's axes to the world's. Pure functions; any thread.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mid_level/base/time.h"
#include "mid_level/messages/path.h"

namespace lodesman::viewer {

using Json = nlohmann::ordered_json;

// Of the viewers' own names.
struct Shape {
  const char* name;
  Json schema;
};
[[nodiscard]] Shape frame_transforms();
[[nodiscard]] Shape location_fix();
[[nodiscard]] Shape log_entry();
[[nodiscard]] Shape poses_in_frame();
[[nodiscard]] Shape compressed_image();
[[nodiscard]] Shape scene_update();

struct Colour {
  double r = 0.0;  // [-] [0, 1]
  double g = 0.0;
  double b = 0.0;
  double a = 1.0;
};

struct Point {
  double x_m = 0.0;
  double y_m = 0.0;
};

[[nodiscard]] Json time(Time at);
[[nodiscard]] Json vector(double x, double y, double z);
// Heading or any angle clockwise from +y: turns x and y by as much.
[[nodiscard]] Json rotation(double clockwise_rad);
[[nodiscard]] Json pose(const Point& place, double clockwise_rad);
[[nodiscard]] Json colour(const Colour& colour);

// A thing in the scene; it stands until one of the same id comes.
[[nodiscard]] Json entity(const char* frame, const char* id, Time at);
[[nodiscard]] Json update_of(Json entity);
[[nodiscard]] Json line(const std::vector<Point>& points, bool closed, double thickness_m,
                        const Colour& colour);
// Its body, as a cylinder or a wall, and the edge of its protection zone, added to an entity.
void add_body(Json& entity, const Obstacle& obstacle, const Colour& colour);
void add_zone(Json& entity, const Obstacle& obstacle, const Colour& colour);

[[nodiscard]] std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace lodesman::viewer
