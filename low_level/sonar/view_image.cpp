// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/view_image.h"

#include <fstream>

#include "low_level/sonar/image_codec.h"
#include "low_level/sonar/view_layers.h"

namespace lodesman {
namespace {

// [m] Of any sonar's range setting.
constexpr double kShortest_m = 1e-3;
constexpr double kLongest_m = 1e5;

// Of the fan, before anything is drawn. Where neither a ping nor anybody says what was seen, all of
// it is water.
[[nodiscard]] const ViewColour& ground_of(const ViewPicture& picture) {
  const bool is_told = picture.ping != nullptr || picture.water;
  return !picture.is_chart() ? view_colours::kWater
         : is_told           ? view_colours::kUnheard
                             : view_colours::kFaintest;
}

cv::Mat draw(const ViewPicture& picture) {
  const cv::Mat fan = view::fan_mask();
  cv::Mat image{kViewRows, kViewColumns, CV_8UC3, view::bgr(view_colours::kOutside)};
  image.setTo(view::bgr(ground_of(picture)), fan);
  const cv::Mat heard = view::draw_ping(image, fan, picture);
  view::draw_water(image, fan, heard, picture);
  view::draw_rings(image, picture);
  const std::vector<view::TrackShown> tracks = view::shown_tracks(picture);
  view::draw_what_rests(image, picture, tracks);
  view::draw_obstacles(image, fan, picture);
  view::draw_what_moves(image, picture, tracks);
  view::draw_path(image, picture);
  view::draw_labels(image, picture);
  view::draw_legend(image, picture);
  return image;
}

bool save(const std::filesystem::path& file, const ViewPicture& picture, ViewFormat format) {
  const std::vector<std::uint8_t> bytes = encode_view(picture, format);
  std::ofstream stream{file, std::ios::binary};
  for (const std::uint8_t byte : bytes) {
    stream.put(static_cast<char>(byte));
  }
  stream.close();
  return !bytes.empty() && stream.good();
}

}  // namespace

std::vector<std::uint8_t> encode_view(const ViewPicture& picture, ViewFormat format) {
  std::vector<std::uint8_t> bytes;
  if (!(picture.range_m >= kShortest_m && picture.range_m <= kLongest_m)) {
    return bytes;
  }
  try {
    const cv::Mat image = draw(picture);
    const BgrPixels pixels{image.cols, image.rows, image.data};
    bytes = format == ViewFormat::kPng ? encode_png(pixels) : encode_jpeg(pixels);
  } catch (const cv::Exception&) {
    bytes.clear();
  }
  return bytes;
}

bool save_jpeg(const std::filesystem::path& file, const ViewPicture& picture) {
  return save(file, picture, ViewFormat::kJpeg);
}

bool save_png(const std::filesystem::path& file, const ViewPicture& picture) {
  return save(file, picture, ViewFormat::kPng);
}

}  // namespace lodesman
