// SPDX-License-Identifier: Apache-2.0
// What the sonar heard, and what is known of the water.
#include <algorithm>
#include <array>
#include <cmath>

#include "low_level/sonar/view_layers.h"

namespace lodesman::view {
namespace {

constexpr double kFaintPower = 0.7;  // of an echo, so that faint ones show too

using Shades = std::array<cv::Vec3b, 256>;

// From water through brown to pale yellow; brightness rises with the echo all the way.
[[nodiscard]] Shades echo_shades() {
  Shades shades;
  const auto shade_of = [](const ViewColour& colour) {
    return cv::Vec3d{static_cast<double>(colour.blue), static_cast<double>(colour.green),
                     static_cast<double>(colour.red)};
  };
  const cv::Vec3d dark = shade_of(view_colours::kWater);
  const cv::Vec3d brown{40, 105, 165};
  const cv::Vec3d pale = shade_of(view_colours::kEcho);
  for (std::size_t i = 0; i < shades.size(); ++i) {
    const double strength = std::pow(static_cast<double>(i) / 255.0, kFaintPower);
    const cv::Vec3d shade = strength < 0.5 ? dark + (brown - dark) * (2.0 * strength)
                                           : brown + (pale - brown) * (2.0 * strength - 1.0);
    shades[i] = cv::Vec3b{shade};
  }
  return shades;
}

// Grey takes no colour from what lies over it, and leaves white to outlines.
[[nodiscard]] Shades grey_shades() {
  constexpr double kDarkest = 30.0;
  constexpr double kBrightest = 205.0;
  Shades shades;
  for (std::size_t i = 0; i < shades.size(); ++i) {
    const double strength = std::pow(static_cast<double>(i) / 255.0, kFaintPower);
    const double grey = kDarkest + (kBrightest - kDarkest) * strength;
    shades[i] = cv::Vec3b::all(static_cast<std::uint8_t>(grey));
  }
  return shades;
}

[[nodiscard]] bool is_image(const SonarPing& ping) {
  return ping.kind == PingKind::kImage && ping.beams > 0 && ping.bins > 0 &&
         ping.beams <= kMaxBeams && ping.bins <= kMaxBins && ping.range_m > 0.0 &&
         ping.beam_step_rad > 0.0;
}

// The mean of a bin and those that touch it, as the threshold method takes it.
[[nodiscard]] double mean_round(const SonarPing& ping, std::uint32_t beam, std::uint32_t bin) {
  const std::uint32_t beam_end = std::min(beam + 2, ping.beams);
  const std::uint32_t bin_end = std::min(bin + 2, ping.bins);
  double sum = 0.0;
  double count = 0.0;
  for (std::uint32_t b = beam > 0 ? beam - 1 : 0; b < beam_end; ++b) {
    for (std::uint32_t j = bin > 0 ? bin - 1 : 0; j < bin_end; ++j) {
      sum += ping.echo[b * ping.bins + j];
      count += 1.0;
    }
  }
  return sum / count;
}

// From the vehicle's frame into the head's.
[[nodiscard]] VehiclePoint to_head(const SonarMounting& mounting, const VehiclePoint& p) {
  const VehiclePose head{{{mounting.x_m, mounting.y_m}},
                         Heading::clockwise_from_y_rad(mounting.turn_rad)};
  return head.to_vehicle({p.xy_m});
}

[[nodiscard]] VehiclePoint place_of(const SonarView& view, int column, int row) {
  return view.to_vehicle({static_cast<std::int16_t>(column), static_cast<std::int16_t>(row)});
}

void draw_echoes(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture) {
  const SonarPing& ping = *picture.ping;
  const SonarView view{picture.range_m};
  const Shades shades = picture.shows_the_known() ? grey_shades() : echo_shades();
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      if (fan.at<std::uint8_t>(row, column) == 0) {
        continue;
      }
      const VehiclePoint p = to_head(picture.mounting, place_of(view, column, row));
      const double bin_of = p.xy_m.norm() / ping.range_m * ping.bins;
      const double beam_of = ping.beam_at(std::atan2(p.xy_m.x(), p.xy_m.y()));
      if (beam_of >= 0.0 && beam_of < ping.beams && bin_of < ping.bins) {
        const auto beam = static_cast<std::uint32_t>(beam_of);
        const auto bin = static_cast<std::uint32_t>(bin_of);
        const bool bright = mean_round(ping, beam, bin) >= picture.bright_from;
        const std::uint8_t echo =
            picture.bright_from > 0.0 ? (bright ? 255 : 0) : ping.echo[beam * ping.bins + bin];
        image.at<cv::Vec3b>(row, column) = shades[echo];
      }
    }
  }
}

// The returns of a profile, as far as they lie in the view.
void draw_points(cv::Mat& image, const ViewPicture& picture) {
  constexpr int kRadiusPx = 2;
  const SonarPing& ping = *picture.ping;
  const SonarView view{picture.range_m};
  const VehiclePose head{{{picture.mounting.x_m, picture.mounting.y_m}},
                         Heading::clockwise_from_y_rad(picture.mounting.turn_rad)};
  const cv::Vec3b pale = (picture.shows_the_known() ? grey_shades() : echo_shades()).back();
  for (std::uint32_t beam = 0; beam < std::min<std::uint32_t>(ping.beams, kMaxBeams); ++beam) {
    const double range_m = ping.points[beam].range_m;
    const double bearing_rad = ping.bearing_rad(beam);
    if (range_m > 0.0 && range_m <= ping.range_m && std::abs(bearing_rad) <= kFanHalf_rad) {
      const Eigen::Vector2d p =
          head.to_world({range_m * Eigen::Vector2d{std::sin(bearing_rad), std::cos(bearing_rad)}})
              .xy_m;
      cv::circle(image, whole_pixel(view, p.x(), p.y()), kRadiusPx, cv::Scalar{pale}, cv::FILLED);
    }
  }
}

}  // namespace

void draw_ping(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture) {
  if (picture.ping == nullptr) {
    return;
  }
  if (picture.ping->kind == PingKind::kProfile) {
    draw_points(image, picture);
  } else if (is_image(*picture.ping)) {
    draw_echoes(image, fan, picture);
  }
}

void draw_water(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture) {
  if (!picture.water) {
    return;
  }
  const SonarView view{picture.range_m};
  cv::Mat free = empty_mask();
  cv::Mat occupied = empty_mask();
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      const ViewWater water = picture.water(place_of(view, column, row));
      free.at<std::uint8_t>(row, column) = water == ViewWater::kFree ? 255 : 0;
      occupied.at<std::uint8_t>(row, column) = water == ViewWater::kOccupied ? 255 : 0;
    }
  }
  tint(image, fan, free, view_colours::kFree, view_colours::kFreeOpacity);
  tint(image, fan, occupied, view_colours::kOccupied, view_colours::kOccupiedOpacity);
}

}  // namespace lodesman::view
