// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/view_saver.h"

#include <fmt/format.h>

#include "deploy/operator/report/output_file.h"
#include "low_level/sonar/view_image.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {

ViewSaver::ViewSaver(const std::filesystem::path& run_directory, Duration period, double range_m)
    : directory_{run_directory / "sonar"}, period_{period}, range_m_{range_m} {
  std::error_code error;
  std::filesystem::create_directories(directory_, error);
  if (error) {
    throw StartupError(directory_.string() + ": cannot be made: " + error.message());
  }
}

void ViewSaver::save(const Blackboard& board, const Plan& plan, const SonarPath* path,
                     const PlanRecord& record) {
  if (plan.captured < due_) {
    return;
  }
  due_ = plan.captured + period_;
  Reader<SonarObstacles> frames{board.sonar_obstacles};
  const auto* frame = frames.latest();
  while (frame != nullptr && frame->value.frame > plan.frame) {
    frame = frames.at(frame->sequence - 1);
  }
  const std::string caption =
      fmt::format("t = {:.1f} s   frame {}   plan {}: {}", record.captured_s, plan.frame, plan.id,
                  to_string(plan.reason));
  ViewPicture picture;
  picture.range_m = range_m_;
  picture.obstacles = frame != nullptr ? &frame->value : nullptr;
  if (path != nullptr) {
    picture.path = {path->pixels.data(), path->pixel_count};
  }
  const VehiclePose pose{{{plan.pose_x_m, plan.pose_y_m}},
                         Heading::clockwise_from_y_rad(plan.pose_heading_rad)};
  picture.goal = pose.to_vehicle({{plan.goal_x_m, plan.goal_y_m}});
  picture.caption = caption;
  const std::vector<std::uint8_t> bytes = encode_view(picture, ViewFormat::kJpeg);
  const std::string text{bytes.begin(), bytes.end()};
  try {
    write_whole_file(directory_ / fmt::format("{:06}.jpg", saved_), text);
    ++saved_;
  } catch (const StartupError& error) {
    fault_ = fault_.empty() ? error.what() : fault_;
  }
}

}  // namespace lodesman::cli
