// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/ompl_rrt_connect.h"

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <cmath>

namespace lodesman::bench {
namespace {

using Plane = ompl::base::RealVectorStateSpace;

class Rrt final : public OmplRrtConnect {
 public:
  explicit Rrt(const PassableGrid& grid) : plane_{std::make_shared<Plane>(2)} {
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    ompl::base::RealVectorBounds bounds{2};
    bounds.setLow(0.0);
    bounds.setHigh(0, grid.fan().columns - 1.0);
    bounds.setHigh(1, grid.fan().rows - 1.0);
    plane_->setBounds(bounds);
    information_ = std::make_shared<ompl::base::SpaceInformation>(plane_);
    information_->setStateValidityChecker([&grid](const ompl::base::State* state) {
      const double* const at = state->as<Plane::StateType>()->values;
      return grid.passable(static_cast<int>(std::lround(at[0])),
                           static_cast<int>(std::lround(at[1])));
    });
    information_->setStateValidityCheckingResolution(1.0 / plane_->getMaximumExtent());  // a pixel
    information_->setup();
    planner_ = std::make_shared<ompl::geometric::RRTConnect>(information_);
  }

  bool search(PathPixel start, PathPixel goal) override {
    const auto problem = std::make_shared<ompl::base::ProblemDefinition>(information_);
    problem->setStartAndGoalStates(state_of(start), state_of(goal));
    planner_->clear();
    planner_->setProblemDefinition(problem);
    planner_->setup();
    return planner_->solve(ompl::base::timedPlannerTerminationCondition(kTimeBoxS)) ==
           ompl::base::PlannerStatus::EXACT_SOLUTION;
  }

 private:
  [[nodiscard]] ompl::base::ScopedState<> state_of(PathPixel pixel) const {
    ompl::base::ScopedState<> state{plane_};
    state[0] = pixel.column;
    state[1] = pixel.row;
    return state;
  }

  std::shared_ptr<Plane> plane_;
  ompl::base::SpaceInformationPtr information_;
  std::shared_ptr<ompl::geometric::RRTConnect> planner_;
};

}  // namespace

std::unique_ptr<OmplRrtConnect> OmplRrtConnect::make(const PassableGrid& grid) {
  return std::make_unique<Rrt>(grid);
}

}  // namespace lodesman::bench
