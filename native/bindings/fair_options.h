// Options and results of solves, as Python knows them.
#pragma once

#include "api/fair.h"
#include "bindings/convert.h"

namespace fairing::bindings {

// What a caller chooses but arrays.
struct Options {
    FairOptions fair;
    HeldInside held;
};

// Inner fairness that is given by arrays.
struct FairnessArrays {
    std::optional<IntArray> neighbours;
    std::optional<DoubleArray> weights;
};

FairOptions to_fair_options(const Options& options, const PaperOptions& paper, const FairnessArrays& fairness);

py::dict to_dict(const FairResult& result);

}  // namespace fairing::bindings
