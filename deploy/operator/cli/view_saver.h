// SPDX-License-Identifier: Apache-2.0
// Saves the sonar view of every so many seconds' plan as a JPEG, as the paper's DeltaT thread did,
// but beside the tasks and not in them. The watcher's thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/operator/report/run_record.h"
#include "low_level/sonar/mounting.h"
#include "low_level/sonar/view_image.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman::cli {

struct ViewSettings {
  Duration period{};
  ViewLook look = ViewLook::kPaper;
  bool by_echoes = false;        // not by obstacles that it was told of
  SonarMounting sonar_mounting;  // of the head that heard them
};

class ViewSaver {
 public:
  // Into <run directory>/sonar, which it makes.
  ViewSaver(const std::filesystem::path& run_directory, double range_m,
            const ViewSettings& settings);

  // Saves the view of this plan if one is due. `path` may be nullptr. A view that cannot be written
  // is left out: nobody's mission ends for a picture.
  void save(const Blackboard& board, const Plan& plan, const SonarPath* path,
            const PlanRecord& record);

  // One line that says why the first of those was left out; empty as long as none was.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

 private:
  // The picture's file as bytes.
  [[nodiscard]] std::vector<std::uint8_t> draw(const Blackboard& board, const Plan& plan,
                                               const SonarPath* path,
                                               const PlanRecord& record) const;

  std::filesystem::path directory_;
  double range_m_;
  ViewSettings settings_;
  Time due_{};
  int saved_ = 0;
  std::string fault_;
};

}  // namespace lodesman::cli
