// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/assembled_boat.h"

#include "deploy/boat/device_catalogue.h"
#include "hal_sim/emulators/looped_world.h"
#include "hal_sim/world/world_task.h"
#include "mid_level/runtime/task_table.h"

namespace lodesman {
namespace {

// The simulated vessel has to be moved by something, and to move what is sensed.
void require_sound_vessel(const BoatConfig& config) {
  const std::string& hull = config.simulation.hull;
  if (!hull_file(hull)) {
    config.document.root().table("simulation").refuse("hull", "\"" + hull + '"' + kNoHull);
  }
  static_cast<void>(load_hull(hull));
  const TomlTable table = config.document.root().table("devices");
  if (config.simulation.vessel == SimulatedVessel::kThrust) {
    if (const char* real = real_device_aboard(config.devices); real != nullptr) {
      table.refuse(real,
                   "is real, and the simulated vessel is moved by simulated thrust: set "
                   "simulation.vessel to \"estimate\"");
    }
  } else if (config.simulation.vessel == SimulatedVessel::kBench) {
    if (const char* simulated = simulated_device(config.devices); simulated != nullptr) {
      table.refuse(simulated,
                   "is simulated, and the world is the bench's: set simulation.vessel to "
                   "\"thrust\" or \"estimate\"");
    }
  } else if (is_simulated_address(config.devices.heading) ||
             is_simulated_address(config.devices.position)) {
    config.document.root()
        .table("simulation")
        .refuse("vessel",
                "is where the estimate is, and that would come from simulated sensors aboard it: "
                "must be \"thrust\"");
  }
}

void require_sound_position(const BoatConfig& config, const Voyage& voyage, bool has_truth) {
  if (!voyage.origin && voyage.position_source != PositionSource::kGps) {
    config.document.root().table("origin").refuse(
        "at_start",
        "the first fixes would be the origin, and none are taken: the position's source "
        "must be gps (estimator.position_source), or give deg");
  }
  const TomlTable estimator = config.document.root().table("estimator");
  const PositionSource source = voyage.position_source;
  if (source == PositionSource::kTruth && is_real_address(config.devices.thrusters)) {
    estimator.refuse("position_source",
                     "the truth of a simulated world must not steer real thrusters: must be gps or "
                     "dead_reckoning");
  }
  if (source == PositionSource::kTruth && !has_truth) {
    estimator.refuse("position_source",
                     "no world is simulated that would tell the truth: must be gps or "
                     "dead_reckoning");
  }
  if (config.devices.position == "none" && source != PositionSource::kDeadReckoning) {
    config.document.root().table("devices").refuse(
        "position", "is none: the position's source must be dead_reckoning, not " +
                        std::string{source == PositionSource::kGps ? "gps" : "truth"} +
                        " (estimator.position_source, or the scenario's)");
  }
}

[[nodiscard]] WorldTask::MovedBy moved_by(const BoatConfig& config) noexcept {
  return config.simulation.vessel == SimulatedVessel::kThrust ? WorldTask::MovedBy::kThrust
                                                              : WorldTask::MovedBy::kEstimate;
}

}  // namespace

bool is_simulated(const BoatConfig& config) { return simulated_device(config.devices) != nullptr; }

bool has_real_devices(const BoatConfig& config) { return real_device(config.devices) != nullptr; }

bool has_real_thrusters(const BoatConfig& config) {
  return is_real_address(config.devices.thrusters);
}

std::optional<Scenario> simulated_scenario(const BoatConfig& config) {
  require_addresses(config);
  const TomlTable table = config.document.root().table("simulation");
  const char* simulated = simulated_device(config.devices);
  const std::string& name = config.simulation.scenario;
  if (simulated == nullptr && config.simulation.vessel != SimulatedVessel::kBench) {
    if (!name.empty()) {
      table.refuse("scenario", "no device is simulated: there is no world for it");
    }
    if (config.simulation.vessel == SimulatedVessel::kEstimate) {
      table.refuse("vessel", "no device is simulated: there is no world for it");
    }
    return std::nullopt;
  }
  if (name.empty()) {
    table.refuse("scenario", simulated == nullptr
                                 ? "the vessel is on the bench: give the scenario of its world"
                                 : std::string{"devices."} + simulated +
                                       " is simulated: give the scenario of its world");
  }
  return load_named_scenario(name, config.speeds);
}

void require_sound(const BoatConfig& config, const Scenario* scenario) {
  require_addresses(config);
  const bool has_truth =
      scenario != nullptr && config.simulation.vessel == SimulatedVessel::kThrust;
  if (scenario != nullptr) {
    require_sound_vessel(config);
  }
  require_sound_position(config, voyage_of(config, scenario), has_truth);
  if (scenario != nullptr) {
    require_scene(config, *scenario);
    require_faults(config, *scenario);
  }
}

struct AssembledBoat::Impl {
  Impl(Blackboard& board, const BoatConfig& config, const Scenario* scenario) {
    if (scenario != nullptr && config.simulation.vessel != SimulatedVessel::kBench) {
      link = std::make_unique<SimLink>();
      world.emplace(*scenario, load_hull(config.simulation.hull), board, *link, moved_by(config));
      looped.emplace(*world, board, *link, scenario->faults);
    }
    low.emplace(board, Role::kLow,
                make_devices({config, board, scenario, link.get(), looped ? &*looped : nullptr,
                              lines, nav440_fixes}),
                low_level_options(config, voyage_of(config, scenario)));
  }

  std::unique_ptr<SimLink> link;
  std::optional<WorldTask> world;
  std::optional<LoopedWorld> looped;
  std::vector<std::unique_ptr<ByteStream>> lines;
  Nav440FixRelay nav440_fixes;
  std::optional<LowLevel> low;
};

AssembledBoat::AssembledBoat(Blackboard& board, const BoatConfig& config, const Scenario* scenario)
    : impl_{std::make_unique<Impl>(board, config, scenario)} {}

AssembledBoat::~AssembledBoat() = default;

std::vector<TaskEntry> AssembledBoat::tasks() {
  std::vector<TaskEntry> entries = impl_->low->tasks();
  if (impl_->looped && !impl_->looped->is_empty()) {
    entries.push_back(scheduled(TaskId::kWorld, *impl_->looped));
  } else if (impl_->world) {
    entries.push_back(scheduled(TaskId::kWorld, *impl_->world));
  }
  return entries;
}

}  // namespace lodesman
