// SPDX-License-Identifier: Apache-2.0
// What the sonar heard.
#include <algorithm>
#include <array>
#include <cmath>

#include "low_level/sonar/view_layers.h"

namespace lodesman::view {
namespace {

constexpr double kFaintPower = 0.7;  // of an echo, so that faint ones show too

// Where a chart's shades begin and end among the ping's echoes, and how far apart at least: noise
// alone stays dark.
constexpr double kDarkShare = 0.4;
constexpr double kBrightShare = 0.995;
constexpr double kLeastSpan = 32.0;

using Shades = std::array<cv::Vec3b, 256>;

[[nodiscard]] cv::Vec3d vector_of(const ViewColour& colour) {
  return {static_cast<double>(colour.blue), static_cast<double>(colour.green),
          static_cast<double>(colour.red)};
}

// From water through brown to pale yellow; brightness rises with the echo all the way.
[[nodiscard]] Shades paper_shades() {
  Shades shades;
  const cv::Vec3d dark = vector_of(view_colours::kWater);
  const cv::Vec3d brown{40, 105, 165};
  const cv::Vec3d pale = vector_of(view_colours::kEcho);
  for (std::size_t i = 0; i < shades.size(); ++i) {
    const double strength = std::pow(static_cast<double>(i) / 255.0, kFaintPower);
    const cv::Vec3d shade = strength < 0.5 ? dark + (brown - dark) * (2.0 * strength)
                                           : brown + (pale - brown) * (2.0 * strength - 1.0);
    shades[i] = cv::Vec3b{shade};
  }
  return shades;
}

struct Stretch {
  double dark = 0.0;
  double bright = 255.0;
};

// What that share of so many echoes are no brighter than; `counts`: of each echo, from one on.
[[nodiscard]] std::size_t level_of(const std::array<std::uint32_t, 256>& counts, std::size_t from,
                                   double share) {
  std::uint64_t all = 0;
  for (std::size_t i = from; i < counts.size(); ++i) {
    all += counts[i];
  }
  std::uint64_t below = 0;
  for (std::size_t i = from; i < counts.size(); ++i) {
    below += counts[i];
    if (static_cast<double>(below) >= share * static_cast<double>(all)) {
      return i;
    }
  }
  return counts.size() - 1;
}

// By the ping's own echoes, so that gain and brightness of a sonar do not matter. What is black
// says nothing of either.
[[nodiscard]] Stretch stretch_of(const SonarPing& ping) {
  std::array<std::uint32_t, 256> counts{};
  const std::size_t cells = static_cast<std::size_t>(ping.beams) * ping.bins;
  for (std::size_t i = 0; i < cells; ++i) {
    ++counts[ping.echo[i]];
  }
  if (counts[0] == cells) {
    return {};
  }
  const auto dark = static_cast<double>(level_of(counts, 0, kDarkShare));
  const auto bright = static_cast<double>(level_of(counts, 1, kBrightShare));
  return {dark, std::max(bright, dark + kLeastSpan)};
}

[[nodiscard]] Shades chart_shades(const Stretch& stretch) {
  Shades shades;
  const cv::Vec3d dark = vector_of(view_colours::kFaintest);
  const cv::Vec3d pale = vector_of(view_colours::kBrightest);
  for (std::size_t i = 0; i < shades.size(); ++i) {
    const double share = (static_cast<double>(i) - stretch.dark) / (stretch.bright - stretch.dark);
    const double strength = std::pow(std::clamp(share, 0.0, 1.0), kFaintPower);
    shades[i] = cv::Vec3b{dark + (pale - dark) * strength};
  }
  return shades;
}

[[nodiscard]] bool has_beams(const SonarPing& ping) {
  const bool has_bins = ping.kind == PingKind::kProfile ||
                        (ping.kind == PingKind::kImage && ping.bins > 0 && ping.bins <= kMaxBins);
  return has_bins && ping.beams > 0 && ping.beams <= kMaxBeams && ping.range_m > 0.0 &&
         ping.beam_step_rad > 0.0;
}

[[nodiscard]] std::uint8_t echo_in(const SonarPing& ping, double beam_of, double bin_of) {
  return ping
      .echo[static_cast<std::uint32_t>(beam_of) * ping.bins + static_cast<std::uint32_t>(bin_of)];
}

// Between the middles of four cells, so that far beams are no stairs.
[[nodiscard]] double echo_between(const SonarPing& ping, double beam_of, double bin_of) {
  const double beam = std::clamp(beam_of - 0.5, 0.0, ping.beams - 1.0);
  const double bin = std::clamp(bin_of - 0.5, 0.0, ping.bins - 1.0);
  const auto beam0 = static_cast<std::uint32_t>(beam);
  const auto bin0 = static_cast<std::uint32_t>(bin);
  const std::uint32_t beam1 = std::min(beam0 + 1, ping.beams - 1);
  const std::uint32_t bin1 = std::min(bin0 + 1, ping.bins - 1);
  const auto along = [&](std::uint32_t of_beam) {
    const double near = ping.echo[of_beam * ping.bins + bin0];
    return near + (bin - bin0) * (ping.echo[of_beam * ping.bins + bin1] - near);
  };
  const double first = along(beam0);
  return first + (beam - beam0) * (along(beam1) - first);
}

// The mean of a bin and those that touch it, as the threshold method takes it.
[[nodiscard]] double mean_round(const SonarPing& ping, double beam_of, double bin_of) {
  const auto beam = static_cast<std::uint32_t>(beam_of);
  const auto bin = static_cast<std::uint32_t>(bin_of);
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

// What is drawn of the echo there.
[[nodiscard]] std::size_t shade_at(const ViewPicture& picture, double beam_of, double bin_of) {
  const SonarPing& ping = *picture.ping;
  if (picture.bright_from > 0.0) {
    return mean_round(ping, beam_of, bin_of) >= picture.bright_from ? 255 : 0;
  }
  return picture.is_chart()
             ? static_cast<std::size_t>(std::lround(echo_between(ping, beam_of, bin_of)))
             : echo_in(ping, beam_of, bin_of);
}

[[nodiscard]] VehiclePose head_of(const ViewPicture& picture) {
  return {{{picture.mounting.x_m, picture.mounting.y_m}},
          Heading::clockwise_from_y_rad(picture.mounting.turn_rad)};
}

// From the vehicle's frame into the head's, for as many pixels as there are.
class HeadFrame {
 public:
  explicit HeadFrame(const VehiclePose& head) : origin_{head.to_vehicle({{0.0, 0.0}}).xy_m} {
    axes_ << head.to_vehicle({{1.0, 0.0}}).xy_m - origin_,
        head.to_vehicle({{0.0, 1.0}}).xy_m - origin_;
  }
  [[nodiscard]] Eigen::Vector2d operator()(const VehiclePoint& p) const {
    return origin_ + axes_ * p.xy_m;
  }

 private:
  Eigen::Vector2d origin_;
  Eigen::Matrix2d axes_;
};

// Calls visit(column, row, beam_of, bin_of) for each pixel of the fan that a beam looks at; bin_of
// is in bins of an image, else the share of the range.
template <class Visit>
void for_each_heard(const cv::Mat& fan, const ViewPicture& picture, Visit visit) {
  const SonarPing& ping = *picture.ping;
  const SonarView view{picture.range_m};
  const HeadFrame to_head{head_of(picture)};
  const double bins = ping.kind == PingKind::kImage ? ping.bins : 1.0;
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      if (fan.at<std::uint8_t>(row, column) == 0) {
        continue;
      }
      const Eigen::Vector2d p = to_head(place_of(view, column, row));
      const double bin_of = p.norm() / ping.range_m * bins;
      const double beam_of = ping.beam_at(std::atan2(p.x(), p.y()));
      if (beam_of >= 0.0 && beam_of < ping.beams && bin_of < bins) {
        visit(column, row, beam_of, bin_of);
      }
    }
  }
}

[[nodiscard]] cv::Mat draw_echoes(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture) {
  const Stretch stretch = picture.bright_from > 0.0 ? Stretch{} : stretch_of(*picture.ping);
  const Shades shades = picture.is_chart() ? chart_shades(stretch) : paper_shades();
  cv::Mat heard = empty_mask();
  for_each_heard(fan, picture, [&](int column, int row, double beam_of, double bin_of) {
    image.at<cv::Vec3b>(row, column) = shades[shade_at(picture, beam_of, bin_of)];
    heard.at<std::uint8_t>(row, column) = 1;
  });
  return heard;
}

// The returns of a profile, as far as they lie in the view.
[[nodiscard]] cv::Mat draw_points(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture) {
  constexpr int kRadiusPx = 2;
  const SonarPing& ping = *picture.ping;
  const SonarView view{picture.range_m};
  const VehiclePose head = head_of(picture);
  cv::Mat heard = empty_mask();
  for_each_heard(fan, picture, [&](int column, int row, double, double) {
    heard.at<std::uint8_t>(row, column) = 1;
  });
  if (picture.is_chart()) {
    image.setTo(bgr(view_colours::kFaintest), heard);
  }
  const ViewColour& colour = picture.is_chart() ? view_colours::kBrightest : view_colours::kEcho;
  for (std::uint32_t beam = 0; beam < std::min<std::uint32_t>(ping.beams, kMaxBeams); ++beam) {
    const double range_m = ping.points[beam].range_m;
    const double bearing_rad = ping.bearing_rad(beam);
    if (range_m > 0.0 && range_m <= ping.range_m && std::abs(bearing_rad) <= kFanHalf_rad) {
      const Eigen::Vector2d p =
          head.to_world({range_m * Eigen::Vector2d{std::sin(bearing_rad), std::cos(bearing_rad)}})
              .xy_m;
      cv::circle(image, whole_pixel(view, p.x(), p.y()), kRadiusPx, bgr(colour), cv::FILLED,
                 cv::LINE_AA);
    }
  }
  return heard;
}

}  // namespace

cv::Mat draw_ping(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture) {
  if (picture.ping == nullptr || !has_beams(*picture.ping)) {
    return {};
  }
  return picture.ping->kind == PingKind::kProfile ? draw_points(image, fan, picture)
                                                  : draw_echoes(image, fan, picture);
}

}  // namespace lodesman::view
