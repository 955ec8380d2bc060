// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/vessel.h"
#include "tests/support/catch.h"
