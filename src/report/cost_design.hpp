#pragma once
// Which settings of a method are worth trying: few, chosen so that substeps and iterations and the method's
// own choices can be told apart.

#include "taut/plan/methods.hpp"
#include "taut/report/cost.hpp"

#include <vector>

namespace taut {

/// At most 20 settings of a method in one precision: substeps 1 to 128, iterations 1 to 64, no product above
/// 256. Everything that the design does not vary is as in `base`; an explicit method refuses steps that
/// are not stable, so that a study shows where its limit lies.
std::vector<MethodSettings> method_design(MethodKind kind, Precision precision,
                                          const MethodSettings& base = {});

/// Every product of the lists in `options`, for one method; of methods without iterations each substep once.
std::vector<MethodSettings> method_product(MethodKind kind, Precision precision, const CostOptions& options,
                                           const MethodSettings& base = {});

} // namespace taut
