// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/viewer_channels.h"

#include <array>
#include <map>
#include <string>

#include "mid_level/recording/raw_codec.h"
#include "mid_level/recording/sonar_picture.h"
#include "mid_level/recording/viewer_json.h"

namespace lodesman {

using viewer::Json;

namespace {

constexpr const char* kWorld = "world";
constexpr const char* kVehicle = "vehicle";
constexpr viewer::Colour kObstacle{0.85, 0.35, 0.20, 0.9};
constexpr viewer::Colour kZone{0.95, 0.75, 0.10, 0.9};
constexpr viewer::Colour kPath{0.15, 0.65, 0.30, 1.0};
constexpr viewer::Colour kGoal{0.15, 0.35, 0.90, 0.8};
constexpr viewer::Colour kHull{0.30, 0.30, 0.35, 0.9};
// The hull that clearances are told from.
constexpr double kBeam_m = 1.20;
constexpr double kLength_m = 2.04;
constexpr double kForeseen_s = 5.0;  // of a mover's way, as a line
constexpr int kInfo = 2;             // of Log
constexpr int kWarning = 3;
constexpr int kDiagonalKnown = 2;  // of LocationFix: the kind of its covariance

// How often each is shown at most; what is not named is shown each time.
template <class M>
constexpr Duration kPeriod = Duration{};
template <>
constexpr Duration kPeriod<VehicleState> = std::chrono::milliseconds{50};
template <>
constexpr Duration kPeriod<SonarPing> = std::chrono::milliseconds{500};

}  // namespace

class ViewerChannels::Impl {
 public:
  explicit Impl(ViewerSink& sink)
      : sink_{sink},
        transforms_{sink.add_topic("/tf", viewer::frame_transforms())},
        scene_{sink.add_topic("/scene", viewer::scene_update())},
        waypoints_{sink.add_topic("/waypoints", viewer::poses_in_frame())},
        position_{sink.add_topic("/position", viewer::location_fix())},
        sonar_{sink.add_topic("/sonar", viewer::compressed_image())},
        log_{sink.add_topic("/log", viewer::log_entry())} {
    const auto board = std::make_unique<Blackboard>();
    for_each_channel(*board, [this]<class C>(const ChannelInfo& info, const C& /*channel*/) {
      takers_.push_back({info.name, &Impl::take_as<typename C::Value>, {}});
    });
  }

  void take(const Publication& publication, std::span<const std::byte> raw) {
    Taker& taker = takers_[publication.channel];
    (this->*taker.take)(taker, publication.stamp, raw);
  }

  void begin_anew() {
    for (Taker& taker : takers_) {
      taker.due = {};
    }
    said_.clear();
    goal_.clear();
    hull_shown_ = false;
  }

 private:
  struct Taker {
    const char* name;
    void (Impl::*take)(Taker& taker, Time stamp, std::span<const std::byte> raw);
    Time due;
  };

  void tell(std::uint16_t topic, Time stamp, const Json& message, const std::string& part = {}) {
    sink_.publish(topic, part, stamp, message.dump(-1, ' ', false, Json::error_handler_t::replace));
  }

  void show_entity(const Json& entity, Time stamp) {
    tell(scene_, stamp, viewer::update_of(entity), entity["id"].get<std::string>());
  }

  template <class M>
  void take_as(Taker& taker, Time stamp, std::span<const std::byte> raw) {
    if constexpr (requires(Impl & impl, const M& message) { impl.show(message, Time{}, ""); }) {
      if (stamp < taker.due) {
        return;
      }
      taker.due = stamp + kPeriod<M>;
      if (const auto message = std::make_unique<M>(); decode_raw(raw, *message)) {
        show(*message, stamp, taker.name);
      }
    }
  }

  void show(const VehicleState& state, Time stamp, const char* /*channel*/) {
    const auto transform = [&](const char* child, double x_m, double y_m, double heading_rad) {
      return Json{{"timestamp", viewer::time(stamp)},
                  {"parent_frame_id", kWorld},
                  {"child_frame_id", child},
                  {"translation", viewer::vector(x_m, y_m, 0.0)},
                  {"rotation", viewer::rotation(heading_rad)}};
    };
    Json transforms = Json::array();
    transforms.push_back(transform(kVehicle, state.x_m, state.y_m, state.heading_rad));
    transforms.push_back(transform("odometry", state.world_from_odometry_x_m(),
                                   state.world_from_odometry_y_m(), 0.0));
    tell(transforms_, stamp, Json{{"transforms", transforms}});
    if (!hull_shown_) {
      hull_shown_ = true;
      Json hull = viewer::entity(kVehicle, "hull", stamp);
      hull["cubes"].push_back({{"pose", viewer::pose({}, 0.0)},
                               {"size", viewer::vector(kBeam_m, kLength_m, 0.4)},
                               {"color", viewer::colour(kHull)}});
      show_entity(hull, stamp);
    }
  }

  void show(const Tracks& tracks, Time stamp, const char* /*channel*/) {
    Json bodies = viewer::entity(kWorld, "obstacles", stamp);
    for (std::uint32_t i = 0; i < tracks.count; ++i) {
      const Track& track = tracks.tracks[i];
      viewer::add_body(bodies, track.shape, kObstacle);
      if (track.surely_moves()) {
        const viewer::Point here{track.shape.centre_x_m, track.shape.centre_y_m};
        const viewer::Point then{here.x_m + kForeseen_s * track.velocity_x_m_s,
                                 here.y_m + kForeseen_s * track.velocity_y_m_s};
        bodies["lines"].push_back(viewer::line({here, then}, false, 0.1, kObstacle));
      }
    }
    show_entity(bodies, stamp);
  }

  void show(const PathRequest& request, Time stamp, const char* /*channel*/) {
    if (request.space != PathSpace::kWorld) {
      return;
    }
    Json zones = viewer::entity(kWorld, "zones", stamp);
    for (std::uint32_t i = 0; i < request.zone_count; ++i) {
      viewer::add_zone(zones, request.zones[i].shape, kZone);
    }
    show_entity(zones, stamp);
  }

  void show(const SonarObstacles& frame, Time stamp, const char* /*channel*/) {
    Json seen = viewer::entity(kVehicle, "sonar_obstacles", stamp);
    for (std::uint32_t i = 0; i < frame.count; ++i) {
      viewer::add_body(seen, frame.obstacles[i], kObstacle);
      viewer::add_zone(seen, frame.obstacles[i], kZone);
    }
    show_entity(seen, stamp);
  }

  void show(const SonarPath& path, Time stamp, const char* /*channel*/) {
    if (path.point_count < 2) {
      return;
    }
    std::vector<viewer::Point> points;
    for (std::uint32_t i = 0; i < path.point_count; ++i) {
      points.push_back({path.points[i].x_m, path.points[i].y_m});
    }
    Json drawn = viewer::entity(kWorld, "path", stamp);
    drawn["lines"].push_back(viewer::line(points, false, 0.15, kPath));
    show_entity(drawn, stamp);
  }

  void show(const Plan& plan, Time stamp, const char* /*channel*/) {
    Json poses = Json::array();
    for (std::uint32_t i = 0; i < plan.waypoint_count; ++i) {
      poses.push_back(viewer::pose({plan.waypoints[i].x_m, plan.waypoints[i].y_m}, 0.0));
    }
    tell(waypoints_, stamp,
         Json{{"timestamp", viewer::time(stamp)}, {"frame_id", kWorld}, {"poses", poses}});
    say_change("plan", to_string(plan.rung), stamp, kInfo);
  }

  void show(const MissionStatus& mission, Time stamp, const char* channel) {
    const std::string goal = std::to_string(mission.mission) + "/" +
                             std::to_string(mission.goal_index) + to_string(mission.state);
    if (goal != goal_) {
      goal_ = goal;
      Json drawn = viewer::entity(kWorld, "goal", stamp);
      drawn["spheres"].push_back({{"pose", viewer::pose({mission.goal_x_m, mission.goal_y_m}, 0.0)},
                                  {"size", viewer::vector(1.0, 1.0, 1.0)},
                                  {"color", viewer::colour(kGoal)}});
      show_entity(drawn, stamp);
    }
    say_change(channel, to_string(mission.state), stamp, kInfo);
    if (mission.no_way != NoWayCause::kNone) {
      say_change("no_way", to_string(mission.no_way), stamp, kWarning);
    } else {
      said_.erase("no_way");
    }
  }

  void show(const ThrustStatus& thrust, Time stamp, const char* channel) {
    say_change(channel, std::string{to_string(thrust.state)} + " by " + to_string(thrust.cause),
               stamp, thrust.state == ThrustState::kStopped ? kWarning : kInfo);
  }

  void show(const DeviceHealth& health, Time stamp, const char* channel) {
    const bool is_well =
        health.status == DeviceStatus::kWorking || health.status == DeviceStatus::kAbsent;
    const bool is_clear = health.fault == DeviceFault::kNone;
    say_change(channel,
               std::string{to_string(health.status)} +
                   (is_clear ? "" : std::string{": "} + describe(health.fault)),
               stamp, is_well && is_clear ? kInfo : kWarning);
  }

  void show(const PositionFix& fix, Time stamp, const char* /*channel*/) {
    const double variance = fix.sigma_m * fix.sigma_m;
    tell(position_, stamp,
         Json{{"timestamp", viewer::time(stamp)},
              {"frame_id", "antenna"},
              {"latitude", fix.latitude_deg},
              {"longitude", fix.longitude_deg},
              {"altitude", 0.0},
              {"position_covariance", {variance, 0, 0, 0, variance, 0, 0, 0, 0}},
              {"position_covariance_type", kDiagonalKnown}});
  }

  void show(const SonarPing& ping, Time stamp, const char* /*channel*/) {
    tell(sonar_, stamp,
         Json{{"timestamp", viewer::time(stamp)},
              {"frame_id", kVehicle},
              {"data", viewer::base64(picture_.jpeg_of(ping))},
              {"format", "jpeg"}});
  }

  void say_change(const char* who, const std::string& what, Time stamp, int level) {
    std::string& said = said_[who];
    if (said == what) {
      return;
    }
    said = what;
    tell(log_, stamp,
         Json{{"timestamp", viewer::time(stamp)},
              {"level", level},
              {"message", std::string{who} + ": " + what},
              {"name", who},
              {"file", ""},
              {"line", 0}},
         who);
  }

  ViewerSink& sink_;
  std::uint16_t transforms_;
  std::uint16_t scene_;
  std::uint16_t waypoints_;
  std::uint16_t position_;
  std::uint16_t sonar_;
  std::uint16_t log_;
  std::vector<Taker> takers_;  // by channel
  SonarPicture picture_;
  std::map<std::string, std::string> said_;
  std::string goal_;
  bool hull_shown_ = false;
};

ViewerChannels::ViewerChannels(ViewerSink& sink) : impl_{std::make_unique<Impl>(sink)} {}
ViewerChannels::~ViewerChannels() = default;

void ViewerChannels::take(const Publication& publication, std::span<const std::byte> raw) {
  impl_->take(publication, raw);
}

void ViewerChannels::begin_anew() { impl_->begin_anew(); }

}  // namespace lodesman
