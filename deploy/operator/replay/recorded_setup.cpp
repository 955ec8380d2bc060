// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/replay/recorded_setup.h"

#include <functional>
#include <optional>
#include <type_traits>

#include "deploy/boat/voyage.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/recording/mcap_reader.h"
#include "mid_level/recording/recording.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;

// What stands before the first message.
struct Notes {
  std::map<std::string, std::string> about;
  std::map<std::string, std::string> attachments;
};

[[nodiscard]] Notes notes_of(const fs::path& file) {
  Notes notes;
  McapFileSource source{file};
  McapReader reader{source};
  for (McapItem item = reader.next(); item != McapItem::kEnd && item != McapItem::kMessage;
       item = reader.next()) {
    if (item == McapItem::kMetadata && reader.metadata().name == kAboutRecord) {
      notes.about.insert(reader.metadata().values.begin(), reader.metadata().values.end());
    } else if (item == McapItem::kAttachment) {
      notes.attachments.try_emplace(reader.attachment().name, reader.attachment().data);
    }
  }
  return notes;
}

[[nodiscard]] TunablesChange change_between(const Tunables& recorded, const Tunables& set) {
  TunablesChange change;
  const auto add = [&](const auto& f) {
    if constexpr (std::is_same_v<decltype(f.member), double Tunables::*>) {
      if (std::not_equal_to<>{}(recorded.*(f.member), set.*(f.member))) {
        change.emplace_back(f.member, set.*(f.member));
      }
    }
  };
  Tunables::fields()([&](const auto&... f) { (add(f), ...); });
  return change;
}

}  // namespace

RecordedSetup recorded_setup(const fs::path& file, const std::vector<std::string>& sets) {
  const std::string& name = file.string();
  const Notes notes = notes_of(file);
  const auto text = notes.attachments.find("config.toml");
  if (text == notes.attachments.end()) {
    throw StartupError(name + ": is no recording of a boat: it has no config.toml");
  }
  const BoatConfig recorded = configuration_of(text->second, name + ": config.toml");
  const BoatConfig config = configuration_of(text->second, name + ": config.toml", sets);
  std::optional<Scenario> scenario;
  if (const auto sailed = notes.attachments.find("scenario.toml");
      sailed != notes.attachments.end()) {
    scenario = read_scenario(TomlDocument::from_text(sailed->second, name + ": scenario.toml"),
                             recorded.speeds);
  }
  const Scenario* world = scenario ? &*scenario : nullptr;
  const Voyage voyage = voyage_of(config, world);
  RecordedSetup setup{
      notes.about, {low_level_options(config, voyage), high_level_options(config, voyage)}, {}};
  setup.change = change_between(desk_options(recorded, voyage_of(recorded, world)).tunables,
                                desk_options(config, voyage).tunables);
  return setup;
}

}  // namespace lodesman::cli
