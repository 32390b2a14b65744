#include "taut/linear/operator.hpp"

namespace taut::linear {

void Operator::record_residual_pairs(Recorder&, const Gate&, Binding, Binding, Binding) const
{
    throw Error(ErrorCode::unsupported,
                "this operator forms no residual in two floats, so it cannot serve the "
                "precision \"mixed\": take \"float\" or \"double\"");
}

void Operator::record_step(Recorder&, const Gate&, const StepBuffers&) const
{
    throw Error(ErrorCode::unsupported,
                "this operator has no step of its own, though it says that it recomputes");
}

} // namespace taut::linear
