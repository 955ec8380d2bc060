// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/view_saver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "deploy/operator/report/output_file.h"
#include "low_level/sonar/known_obstacles.h"
#include "low_level/sonar/view_image.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/geometry/pose_history.h"

namespace lodesman::cli {
namespace {

// The newest that is of no later frame.
template <class T>
[[nodiscard]] const T* up_to(std::uint64_t frame, Reader<T>& reader) {
  const auto* one = reader.latest();
  while (one != nullptr && one->value.frame > frame) {
    one = reader.at(one->sequence - 1);
  }
  return one != nullptr ? &one->value : nullptr;
}

// A ping has no other picture than its own.
[[nodiscard]] const SonarPing* ping_of(std::uint64_t frame, Reader<SonarPing>& reader) {
  const auto* one = reader.latest();
  while (one != nullptr && one->value.number > frame) {
    one = reader.at(one->sequence - 1);
  }
  return one != nullptr && one->value.number == frame ? &one->value : nullptr;
}

// What a path in the world was asked to keep out of, in the vehicle frame; empty: nothing, or the
// question is not there any more.
[[nodiscard]] std::unique_ptr<SonarObstacles> zones_of(const Blackboard& board,
                                                       const SonarPath* path,
                                                       const VehiclePose& pose) {
  Reader<PathRequest> requests{board.path_request};
  const auto* one = path != nullptr ? requests.latest() : nullptr;
  while (one != nullptr && one->value.id > path->request) {
    one = requests.at(one->sequence - 1);
  }
  if (one == nullptr || one->value.id != path->request || one->value.zone_count == 0) {
    return nullptr;
  }
  auto zones = std::make_unique<SonarObstacles>();
  for (const PathZone& zone : std::span{one->value.zones}.first(
           std::min<std::size_t>(one->value.zone_count, kMaxObstacles))) {
    zones->obstacles[zones->count++] = to_vehicle(pose, zone.shape);
  }
  return zones;
}

// Where the boat was when it heard that; a plan in the world is made a little later.
[[nodiscard]] VehiclePose pose_at(const Blackboard& board, Time captured, const Plan& plan) {
  PoseHistory poses;
  Reader<VehicleState> states{board.vehicle_state};
  while (const auto* state = states.next()) {
    poses.add(state->value);
  }
  const VehiclePose planned{{{plan.pose_x_m, plan.pose_y_m}},
                            Heading::clockwise_from_y_rad(plan.pose_heading_rad)};
  return poses.at(captured).value_or(planned);
}

// By places in the vehicle frame.
[[nodiscard]] auto water_around(const Coverage& seen, const VehiclePose& pose) {
  const Eigen::Vector2d boat = pose.p_WV.xy_m;
  Eigen::Matrix2d axes;
  axes << pose.to_world({{1.0, 0.0}}).xy_m - boat, pose.to_world({{0.0, 1.0}}).xy_m - boat;
  return [&seen, boat, axes](const VehiclePoint& p) {
    const Eigen::Vector2d there = boat + axes * p.xy_m;
    return seen.at(there.x(), there.y());
  };
}

// That of a plan in the sonar view, or as much of one in the world as a picture can hold.
[[nodiscard]] std::vector<PathPixel> pixels_of(const SonarPath& path, const VehiclePose& pose,
                                               double range_m) {
  const std::span pixels{path.pixels.data(), path.pixel_count};
  std::vector<PathPixel> line{pixels.begin(), pixels.end()};
  const SonarView view{range_m};
  const auto pixel = [](double at) {
    constexpr double kFarPx = 10'000.0;
    return static_cast<std::int16_t>(std::lround(std::clamp(at, -kFarPx, kFarPx)));
  };
  for (const PathPoint& point : std::span{path.points}.first(path.point_count)) {
    const VehiclePoint p = pose.to_vehicle({{point.x_m, point.y_m}});
    line.push_back({pixel(view.column_of(p.xy_m.x())), pixel(view.row_of(p.xy_m.y()))});
  }
  return line;
}

}  // namespace

ViewSaver::ViewSaver(const std::filesystem::path& run_directory, double range_m,
                     const ViewSettings& settings)
    : directory_{run_directory / "sonar"}, range_m_{range_m}, settings_{settings} {
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
  due_ = plan.captured + settings_.period;
  const std::vector<std::uint8_t> bytes = draw(board, plan, path, record);
  const std::string text{bytes.begin(), bytes.end()};
  try {
    write_whole_file(directory_ / fmt::format("{:06}.jpg", saved_), text);
    ++saved_;
  } catch (const StartupError& error) {
    fault_ = fault_.empty() ? error.what() : fault_;
  }
}

std::vector<std::uint8_t> ViewSaver::draw(const Blackboard& board, const Plan& plan,
                                          const SonarPath* path, const PlanRecord& record) const {
  Reader<SonarObstacles> frames{board.sonar_obstacles};
  Reader<SonarPing> pings{board.sonar_ping};
  Reader<Tracks> tracks{board.tracks};
  Reader<Coverage> coverage{board.coverage};
  const bool is_chart = settings_.look == ViewLook::kChart;
  ViewPicture picture;
  picture.range_m = range_m_;
  picture.look = settings_.look;
  picture.pose = pose_at(board, plan.captured, plan);
  picture.obstacles = up_to(plan.frame, frames);
  picture.tracks = up_to(plan.frame, tracks);
  if (settings_.by_echoes) {
    picture.ping = ping_of(plan.frame, pings);
    picture.mounting = settings_.sonar_mounting;
  }
  if (const Coverage* seen = up_to(plan.frame, coverage); seen != nullptr) {
    picture.water = water_around(*seen, picture.pose);
  }
  const auto zones = is_chart ? zones_of(board, path, picture.pose) : nullptr;
  picture.zones = zones ? zones.get() : is_chart ? nullptr : picture.obstacles;
  const std::vector<PathPixel> line =
      path != nullptr ? pixels_of(*path, picture.pose, range_m_) : std::vector<PathPixel>{};
  picture.path = line;
  picture.goal = picture.pose.to_vehicle({{plan.goal_x_m, plan.goal_y_m}});
  const std::string caption =
      fmt::format("t = {:.1f} s   frame {}   plan {}: {}", record.captured_s, plan.frame, plan.id,
                  to_string(plan.reason));
  picture.caption = caption;
  return encode_view(picture, ViewFormat::kJpeg);
}

}  // namespace lodesman::cli
