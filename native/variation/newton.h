// Minimises the variation of curvature over motions of the vertices of one mesh.
#pragma once

#include "base/progress.h"
#include "variation/variation_energy.h"

namespace fairing {

// Damping that takes the place of none where no step is found without, and of a rough initial surface.
inline constexpr double raised_damping = 1e-3;

// Unit of both measures, in D: an elbow has some ten of it, what looks like a cylinder a thousandth.
inline constexpr double merit_unit = 1.0;

struct NewtonLimits {
    double tolerance;  // of the largest height of a full step, units of D
    int most_steps;
    double damping = 0.0;          // initial; large damping removes roughness before anything moves far
    double shortest_share = 0.0;   // of a step; the descent ends where only a smaller share can be taken
    double most_merit = HUGE_VAL;  // the descent is given up where the merit is larger after ten steps
    double turns = HUGE_VAL;       // tolerance of the largest turn of a full step, radians
    double least_fall = 0.0;       // it also ends where a full step lowers merit_unit + merit by less than this share
};

struct NewtonResult {
    bool converged = false;
    int steps = 0;
    double merit = 0.0;
    double gradient = 0.0;  // largest derivative of the merit by a height
};

// Newton's steps with Levenberg–Marquardt damping and a line search; a step that would fold triangles is
// shortened. `sheet`: start and result. Throws Cancelled.
NewtonResult minimise(const VariationEnergy& energy, Sheet& sheet, const NewtonLimits& limits,
                      const Progress& progress);

// The unit normals of least variation for fixed points, those of the problem where given exactly. Begins at Max's
// normals.
Points fitted_normals(const Problem& problem, const Points& points, Measure measure, const Progress& progress);

}  // namespace fairing
