// SPDX-License-Identifier: Apache-2.0
// Obstacles and their protection zones.
#include <algorithm>
#include <cmath>

#include "low_level/sonar/view_layers.h"

namespace lodesman::view {
namespace {

[[nodiscard]] cv::Mat area_of(const SonarView& view, const SonarObstacles* seen, bool protection) {
  cv::Mat area = empty_mask();
  const std::uint32_t count =
      seen != nullptr ? std::min<std::uint32_t>(seen->count, kMaxObstacles) : 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (is_drawable(seen->obstacles[i])) {
      fill_shape(area, view, seen->obstacles[i], protection);
    }
  }
  return area;
}

void draw_outlines(cv::Mat& image, const ViewPicture& picture) {
  const SonarView view{picture.range_m};
  const std::uint32_t count = std::min<std::uint32_t>(picture.obstacles->count, kMaxObstacles);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Obstacle& o = picture.obstacles->obstacles[i];
    if (is_drawable(o)) {
      draw_outline(image, body_outline(view, o), is_closed(o), view_colours::kWhite, 1);
    }
  }
}

}  // namespace

void draw_obstacles(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture) {
  const SonarView view{picture.range_m};
  if (picture.is_chart()) {
    paint(image, fan, area_of(view, picture.zones, true), view_colours::kZone, view_colours::kZone,
          0.0);
    if (picture.obstacles != nullptr) {
      draw_outlines(image, picture);
    }
    return;
  }
  // Over echoes both are glass, so that one sees what was segmented.
  const bool glass = picture.ping != nullptr;
  paint(image, fan, area_of(view, picture.zones, true), view_colours::kZone,
        view_colours::kZoneEdge, glass ? 0.45 : 1.0);
  paint(image, fan, area_of(view, picture.obstacles, false), view_colours::kObstacle,
        glass ? view_colours::kObstacle : view_colours::kWhite, glass ? 0.35 : 1.0);
}

}  // namespace lodesman::view
