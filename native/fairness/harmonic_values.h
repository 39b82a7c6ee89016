// Values that are known at some vertices, continued harmonically.
#pragma once

#include "fairness/inner_weights.h"

namespace fairing {

// The edges of a graph and what their differences add up to: Σ_j w_ij (x_i − x_j) = s_i at vertices that aren't known.
struct HarmonicProblem {
    const InnerWeights& edges;  // positive weights
    std::vector<char> is_known;
    Points places = Points(3, 0);                     // of all vertices, by which large systems are ordered; or none
    Eigen::MatrixXd sources = Eigen::MatrixXd(0, 0);  // (vertices × c); or none: 0
};

// (vertices × c): those that aren't known are replaced where they hang together with a known one. Without sources no
// value leaves the range of its column, up to rounding. Nothing where the system can't be solved.
std::optional<Eigen::MatrixXd> harmonic_values(const HarmonicProblem& problem, Eigen::MatrixXd values);

// Cotangent weights of a patch's edges, by their number, none below a thousandth.
InnerWeights harmonic_weights(const Patch& patch, const Points& points);

// With these weights. Rows: the free vertices; columns as those of `given`, whose rows are the fixed vertices. A linear
// function of `points` (3 × local vertices) stays linear on a flat patch without wide angles. Without fixed vertices
// all values are zero.
std::optional<Eigen::MatrixXd> harmonic_values(const Patch& patch, const Points& points, const Eigen::MatrixXd& given);

}  // namespace fairing
