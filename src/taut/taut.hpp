#pragma once
// The one public include.

#include "taut/judge/judge.hpp"
#include "taut/linear/matrix_market.hpp"
#include "taut/linear/solve.hpp"
#include "taut/plan/plan.hpp"
#include "taut/report/report.hpp"
#include "taut/runtime/device.hpp"
#include "taut/scene/kinds.hpp"
#include "taut/scene/scene.hpp"
#include "taut/version.hpp"
#include "taut/world/world.hpp"
