// Options and results of solves, as Python knows them.
#pragma once

#include "api/fair.h"
#include "bindings/convert.h"

namespace fairing::bindings {

struct Options {
    std::string equation;
    std::string otherwise;
    double load;
    double bulge;
    std::string inner_fairness;
    std::string method;
    std::string normals;
    double tolerance;
    int max_iterations;
    int threads;
    double detail;
    double detail_size;
    std::string start;
    Indices creases;
    Indices smooth_curves;
    bool fair_border;
    double pin_radius;
};

// Inner fairness that is given by arrays.
struct FairnessArrays {
    std::optional<IntArray> neighbours;
    std::optional<DoubleArray> weights;
};

FairOptions to_fair_options(const Options& options, const PaperOptions& paper, const FairnessArrays& fairness);

py::dict to_dict(const FairResult& result);

}  // namespace fairing::bindings
