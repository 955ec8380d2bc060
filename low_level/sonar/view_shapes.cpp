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

}  // namespace

void draw_obstacles(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture) {
  const SonarView view{picture.range_m};
  // Over echoes both are glass, so that one sees what was segmented.
  const bool glass = picture.ping != nullptr;
  const bool edges = picture.shows_the_known();
  paint(image, fan, area_of(view, picture.zones, true), view_colours::kZone,
        view_colours::kZoneEdge, edges ? 0.0 : (glass ? 0.45 : 1.0));
  if (!edges) {
    paint(image, fan, area_of(view, picture.obstacles, false), view_colours::kObstacle,
          glass ? view_colours::kObstacle : view_colours::kWhite, glass ? 0.35 : 1.0);
  } else if (picture.obstacles != nullptr) {
    for (std::uint32_t i = 0; i < std::min<std::uint32_t>(picture.obstacles->count, kMaxObstacles);
         ++i) {
      if (is_drawable(picture.obstacles->obstacles[i])) {
        outline_body(image, view, picture.obstacles->obstacles[i], view_colours::kWhite, 1);
      }
    }
  }
}

}  // namespace lodesman::view
