// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/segment_command.h"

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deploy/boat/configuration.h"
#include "deploy/boat/level_options.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/cli/number_options.h"
#include "deploy/operator/cli/segment_frames.h"
#include "deploy/operator/cli/segment_overlay.h"
#include "deploy/operator/cli/segment_text.h"
#include "low_level/path/path_finder.h"
#include "low_level/sonar/detector.h"
#include "low_level/sonar/ping_image.h"
#include "low_level/sonar/protection.h"
#include "low_level/tracking/tracker.h"
#include "mid_level/base/heading.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct SegmentOptions {
  CommonOptions common;
  std::vector<std::string> images;
  double range_m = 0.0;
  double sector_deg = 0.0;
  bool fan = false;
  bool apex_at_bottom = true;
  std::optional<std::array<double, 2>> apex_px;  // column and row
  double radius_px = 0.0;                        // 0: the image's height
  std::string overlay_dir;
  std::string layers;                           // of the overlays; empty: as they come
  std::optional<std::array<double, 2>> plan_m;  // x and y
  bool track = false;                           // the frames are pings one after another
  double ping_hz = 10.0;
  double threshold = 0.0;  // 0: the configuration's
};

// What a goal, or the head's pixel outside an image, may lie away at most.
constexpr double kFar_m = 1e4;
constexpr double kFar_px = 1e5;

// What the vehicle would do with the same configuration.
DeltaTOptions configured(const SegmentOptions& options) {
  const BoatConfig config = load_configuration("default", options.common);
  DeltaTOptions delta_t = config.low.delta_t;
  if (options.threshold > 0.0) {
    delta_t.segmentation.method = DetectionMethod::kThreshold;
    delta_t.segmentation.threshold = options.threshold;
  }
  return delta_t;
}

// The frames of one call, one after another, through one Detector as on the vehicle.
class FrameReader {
 public:
  explicit FrameReader(const SegmentOptions& options)
      : options_{options}, delta_t_{configured(options)}, detector_{delta_t_.segmentation} {
    if (options.track) {
      tracker_.emplace(delta_t_.segmentation.min_range_m);
    }
    if (!options.overlay_dir.empty()) {
      const bool fixed = delta_t_.segmentation.method == DetectionMethod::kThreshold;
      overlay_.emplace(options.overlay_dir, options.layers,
                       fixed ? delta_t_.segmentation.threshold : 0.0);
    }
  }

  // False, and said, where the file holds no frame.
  [[nodiscard]] bool load(const fs::path& file);
  // What the frame loaded last shows.
  Json read(const fs::path& file);

 private:
  void take(const GreyImage& image, const fs::path& file);
  void take_what_is_known();
  void plan(Json& frame);
  void save_overlay(const fs::path& file);

  const SegmentOptions& options_;
  DeltaTOptions delta_t_;
  Detector detector_;
  std::optional<Tracker> tracker_;
  std::optional<SegmentOverlay> overlay_;
  PathFinder path_finder_;
  // On the heap, because a ping is half a megabyte.
  std::unique_ptr<SonarPing> ping_ = std::make_unique<SonarPing>();
  std::unique_ptr<SonarObstacles> seen_ = std::make_unique<SonarObstacles>();
  std::unique_ptr<SonarObstacles> obstacles_ = std::make_unique<SonarObstacles>();  // or tracks
  std::unique_ptr<Tracks> tracks_ = std::make_unique<Tracks>();
  std::unique_ptr<SonarPath> path_ = std::make_unique<SonarPath>();
};

bool FrameReader::load(const fs::path& file) {
  try {
    take(read_grey_image(file), file);
    return true;
  } catch (const StartupError& error) {
    std::cerr << error.what() << "\n";
    return false;
  }
}

void FrameReader::take(const GreyImage& image, const fs::path& file) {
  ping_->number += 1;
  ping_->captured = Time{from_seconds(static_cast<double>(ping_->number) / options_.ping_hz)};
  ping_->range_m = options_.range_m;
  ping_->sector_rad = to_rad(options_.sector_deg);
  if (!options_.fan) {
    polar_to_ping(image, file, *ping_);
    return;
  }
  FanGeometry fan = whole_image_fan(image, options_.apex_at_bottom);
  if (options_.apex_px) {
    fan.apex_column_px = (*options_.apex_px)[0];
    fan.apex_row_px = (*options_.apex_px)[1];
  }
  if (options_.radius_px > 0.0) {
    fan.radius_px = options_.radius_px;
  }
  fan_to_ping(image, fan, *ping_);
}

// [us] that this thread has had of its processor.
double processor_time_us() {
  timespec spent{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
  return 1e6 * static_cast<double>(spent.tv_sec) + 1e-3 * static_cast<double>(spent.tv_nsec);
}

// An ellipse is the same turned by half a turn: (-90, 90] says it once.
double half_turn_deg(double rad) {
  const double deg = to_deg(std::remainder(rad, std::numbers::pi));
  return deg <= -90.0 ? deg + 180.0 : deg;
}

// A polygon has its vertices, and one distance that its zone reaches to, in place of an ellipse's
// semi-axes.
Json to_json(const Obstacle& o) {
  Json out{{"id", o.id}, {"centre_m", {o.centre_x_m, o.centre_y_m}}};
  if (o.shape == ObstacleShape::kEllipse) {
    out["semi_axes_m"] = {o.semi_axis_first_m, o.semi_axis_second_m};
    out["angle_deg"] = half_turn_deg(o.angle_rad);
    out["protection_semi_axes_m"] = {o.protection_first_m, o.protection_second_m};
  } else {
    out["vertices_m"] = Json::array();
    for (const Vertex& v : std::span{o.vertices}.first(o.vertex_count)) {
      out["vertices_m"].push_back({v.x_m, v.y_m});
    }
    out["protection_m"] = o.protection_first_m;
  }
  out["range_m"] = std::hypot(o.centre_x_m, o.centre_y_m);
  out["bearing_deg"] = to_deg(std::atan2(o.centre_x_m, o.centre_y_m));
  out["peak"] = o.peak;
  return out;
}

// Of what moves, or may.
void add_velocity(const Track& track, Json& out) {
  if (track.velocity_xx_m2_s2 > 0.0) {
    out["velocity_m_s"] = {track.velocity_x_m_s, track.velocity_y_m_s};
    out["surely_moves"] = track.surely_moves();
  }
}

Json FrameReader::read(const fs::path& file) {
  const double before_us = processor_time_us();
  detector_.detect(*ping_, *seen_);
  if (tracker_) {
    tracker_->see(*ping_, *seen_, {}, *tracks_);
  }
  const double us = processor_time_us() - before_us;
  take_what_is_known();
  if (delta_t_.own_zones) {
    make_own_zones(*delta_t_.own_zones, *obstacles_);
  }
  Json frame{{"file", file.string()}, {"us", us}, {"obstacles", Json::array()}};
  for (std::uint32_t i = 0; i < obstacles_->count; ++i) {
    frame["obstacles"].push_back(to_json(obstacles_->obstacles[i]));
    if (tracker_) {
      add_velocity(tracks_->tracks[i], frame["obstacles"].back());
    }
  }
  if (obstacles_->dropped > 0) {
    frame["dropped"] = obstacles_->dropped;
  }
  frame["path_m"] = nullptr;  // nothing was asked for
  if (options_.plan_m) {
    plan(frame);
  }
  if (overlay_) {
    save_overlay(file);
  }
  return frame;
}

// The head is at rest, so that its frame is the odometry's. What is known takes the place of what
// is seen.
void FrameReader::take_what_is_known() {
  *obstacles_ = *seen_;
  if (!tracker_) {
    return;
  }
  obstacles_->count = tracks_->count;
  obstacles_->dropped += tracks_->dropped;
  for (std::uint32_t i = 0; i < tracks_->count; ++i) {
    obstacles_->obstacles[i] = tracks_->tracks[i].shape;
  }
}

void FrameReader::plan(Json& frame) {
  PathRequest request;
  request.id = request.frame = ping_->number;
  request.goal_x_m = (*options_.plan_m)[0];
  request.goal_y_m = (*options_.plan_m)[1];
  path_finder_.find_path(*obstacles_, request, *path_);
  frame["path_m"] = Json::array();
  const SonarView view{options_.range_m};
  for (std::uint32_t i = 0; i < path_->pixel_count; ++i) {
    const VehiclePoint point = view.to_vehicle(path_->pixels[i]);
    frame["path_m"].push_back({point.xy_m.x(), point.xy_m.y()});
  }
  frame["reason"] = to_string(path_->reason);
}

void FrameReader::save_overlay(const fs::path& file) {
  OverlayFrame frame{
      .file = file, .ping = ping_.get(), .seen = seen_.get(), .planned = obstacles_.get()};
  if (tracker_) {
    frame.tracker = &*tracker_;
    frame.tracks = tracks_.get();
  }
  if (options_.plan_m) {
    frame.path = path_.get();
    frame.goal = VehiclePoint{{(*options_.plan_m)[0], (*options_.plan_m)[1]}};
  }
  overlay_->save(frame);
}

void show_progress(const SegmentOptions& options, std::size_t done) {
  constexpr std::size_t kMany = 4;
  const std::size_t all = options.images.size();
  if (options.common.quiet || all < kMany) {
    return;
  }
  const bool terminal = isatty(STDERR_FILENO) == 1;
  if (terminal) {
    std::cerr << "\rsegment: " << done << "/" << all << (done == all ? "\n" : "") << std::flush;
  } else if (done == all || done % 100 == 0) {
    std::cerr << "segment: " << done << "/" << all << "\n";
  }
}

// A file that holds no frame is named, and the others are read all the same.
[[nodiscard]] int segment(const SegmentOptions& options) {
  FrameReader reader{options};
  Json frames = Json::array();
  int exit_status = kExitDone;
  for (std::size_t i = 0; i < options.images.size(); ++i) {
    const std::string& image = options.images[i];
    if (reader.load(image)) {
      frames.push_back(reader.read(image));
    } else {
      exit_status = kExitRefused;
    }
    show_progress(options, i + 1);
  }
  if (frames.empty()) {
    return exit_status;
  }
  if (options.common.json) {
    std::cout << Json{{"frames", std::move(frames)}}.dump(-1, ' ', false,
                                                          Json::error_handler_t::replace)
              << "\n";
  } else if (!options.common.quiet) {
    for (const Json& frame : frames) {
      print_frame(frame);
    }
  }
  return exit_status;
}

// CLI11 owns its subcommands, so the options live and die with theirs.
class SegmentCommand : public CLI::App {
 public:
  explicit SegmentCommand(int& exit_status)
      : CLI::App{kSegmentDescription, "segment"}, exit_status_{exit_status} {
    add_common_options(*this, options_.common);
    add_input_options();
    auto* overlay =
        add_option("--overlay", options_.overlay_dir, "Draw what was found into this directory")
            ->type_name("DIR");
    add_option("--layers", options_.layers,
               "--overlay: only these of echoes, bright (by threshold), obstacles, zones and, with "
               "--track, water and tracks")
        ->type_name("A,B")
        ->needs(overlay);
    add_pair_option(*this, "--plan", options_.plan_m, -kFar_m, kFar_m,
                    "Find a path to this goal in the vehicle frame")
        ->type_name("X,Y");
    add_flag("--track", options_.track,
             "The frames are pings one after another of a head at rest: follow what they show");
    add_option("--ping-hz", options_.ping_hz, "--track: pings a second")
        ->check(number_from(0.1, 100.0))
        ->capture_default_str();
    add_option("--threshold", options_.threshold, "Echo strength from which a bin is bright")
        ->check(number_from(1.0, 255.0));
    footer(
        "Example:\n  lodesman segment frames --range-m 30 --sector-deg 120 --track --overlay out");
    callback([this] { run(); });
  }

 private:
  void add_input_options() {
    add_option("IMAGE", options_.images,
               "8-bit PGM, PNG or JPEG frames, or a directory of them, which are taken by name")
        ->required();
    add_option("--range-m", options_.range_m, "Range setting of the sonar")
        ->required()
        ->check(number_from(0.1, 300.0));
    add_option("--sector-deg", options_.sector_deg, "Sector that the frames show")
        ->required()
        ->check(number_from(1.0, 180.0));
    add_option("--layout", layout_,
               "polar: a column a beam, row 0 nearest; fan: as displayed, range as the distance "
               "from the apex")
        ->check(CLI::IsMember({"polar", "fan"}))
        ->capture_default_str();
    add_option("--apex", apex_, "fan: where the head is; with top, range grows downwards")
        ->check(CLI::IsMember({"top", "bottom"}))
        ->capture_default_str();
    add_pair_option(*this, "--apex-px", options_.apex_px, -kFar_px, kFar_px,
                    "fan: the head's pixel; default: the middle of the bottom (or top) row")
        ->type_name("COLUMN,ROW");
    add_option("--radius-px", options_.radius_px,
               "fan: pixels from the apex to full range; default: the image's height")
        ->check(number_from(1.0, 1e5));
  }

  void run() {
    options_.images = frame_files(options_.images);
    options_.fan = layout_ == "fan";
    options_.apex_at_bottom = apex_ == "bottom";
    exit_status_ = segment(options_);
  }

  int& exit_status_;
  SegmentOptions options_;
  std::string layout_ = "polar";
  std::string apex_ = "bottom";
};

}  // namespace

void add_segment_command(CLI::App& root, int& exit_status) {
  root.add_subcommand(std::make_shared<SegmentCommand>(exit_status));
}

}  // namespace lodesman::cli
