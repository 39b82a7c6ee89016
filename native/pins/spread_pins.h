// Pins that lift or hold the surface over a radius instead of in a point.
#pragma once

#include "base/progress.h"
#include "geometry/face_geometry.h"
#include "mesh/patch.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Fixed vertices inside the patch none of whose neighbours is fixed, by their places among the fixed ones.
Indices isolated_pins(const Patch& patch);

// Solves Δ_B H = f + Σ_k λ_k g_k with every pin exactly at its place. g_k is a bell of standard deviation `radius`
// (units of D; pins/spread_pins.h) around pin k; λ_k is its multiplier. H is then bounded at the pins, whatever the
// mesh, where Δ_B H = f alone lets it grow like the logarithm of the edge length. `start`: 3 × local vertices, near the
// surface; pins that are not at their places yet are led there. The solution's points come from there; its termination
// says whether the iteration has converged. Throws Cancelled.
Solution spread_pins(const Problem& problem, double radius, const Points& start, const Progress& progress);

// Bells on a surface: 1 at a vertex, falling off within a radius.
// Diffuses a unit of heat at each of the vertices for the time ρ²/2, in eight implicit steps, and scales it to 1 there:
// nearly a Gaussian of standard deviation ρ in the distance along the surface. It does not reach across a slit or a
// thin wall. 3 × vertices of the patch, units of the radius; vertices × centres come back. Throws SolverError where the
// surface has degenerated.
Eigen::MatrixXd bells(const Patch& patch, const Points& points, const Stiffness& stiffness, const Indices& centres,
                      double radius, const Progress& progress);

// A patch whose isolated pins are numbered among the free vertices.
struct Released {
    Patch patch;
    Indices from;  // vertex of `patch` → vertex of the given one; free vertices keep their numbers
    Indices to;    // and back
};

// `pins`: places among the fixed vertices. They come right after the free ones, in their order.
Released released(const Patch& given, const Indices& pins);

// The problem without these pins, with uniform weights. `free` must outlive it.
Problem on_released(const Problem& problem, const Released& free);

// Isolated pins, by their places among the fixed vertices, around which the triangles' normals have a mean cosine below
// 1/2 to their mean, both by area: tips of spikes whose sides lean by at most 30° to their axis. `points`: 3 × local
// vertices.
Indices sharp_pins(const Patch& patch, const Points& points);

}  // namespace fairing
