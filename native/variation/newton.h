// Minimises the variation energy over motions of the vertices of one mesh.
#pragma once

#include "base/progress.h"
#include "variation/variation_energy.h"

namespace fairing {

struct NewtonLimits {
    double tolerance;  // of the largest height of a step, units of D
    int most_steps;
    bool leave_when_stuck = false;
    double damping = 1e-6;
    double scale = 0.0;
};

struct NewtonResult {
    bool converged = false;
    int steps = 0;
    double energy = 0.0;
    double damping = 0.0;
    double rise = 0.0;
    double share = 0.0;
    double gradient = 0.0;   // largest |∂E/∂h|
};

// Newton's steps with Levenberg–Marquardt damping and a line search on the energy; a step that would fold triangles is
// shortened. `sheet`: start and result. Throws Cancelled.
NewtonResult minimise(const VariationEnergy& energy, Sheet& sheet, const NewtonLimits& limits,
                      const Progress& progress);

// Unit normals that suit points best: of least energy while the points stay, those of the problem where given exactly.
// Begins at Max's normals.
Points fitted_normals(const Problem& problem, const Points& points, const Progress& progress);

}  // namespace fairing
