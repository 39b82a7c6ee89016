// The operators that the stages of a solve share.
#pragma once

#include <memory>

#include "linear/anderson.h"
#include "operators/normal_operator.h"
#include "tangential/tangential_step.h"

namespace fairing {

struct Workspace {
    std::unique_ptr<NormalOperator> normal;  // of the equation: biharmonic, or Laplace for minimal surfaces
    std::unique_ptr<TangentialStep> tangential;
    bool keeps_factor = false;  // `normal` holds the factor of a surface near the start, which the iteration leaves
    std::unique_ptr<Anderson> history = {};  // of the iterations with that factor; they add to it
    double reaction = 0.0;  // by what share K's answers were too short on a coarser level (iteration/reaction)
};

}  // namespace fairing
