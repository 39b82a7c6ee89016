// The choices that the paper leaves open, and additions to it.
#pragma once

#include "paper/disk_curvature.h"

namespace fairing {

// How the coarsest level is filled before its curvature means anything (end of §7.4).
enum class PaperStart {
    linear,   // bilaplacian with λ
    improved  // the same, then made fair by mixed finite elements: for sparse and very irregular meshes
};

// What becomes of the updates' positions.
enum class Acceleration {
    plain,    // as published: each update starts where the last one ended
    anderson  // the best affine combination of the last cycles (one global and one local update each)
};

// The defaults are those of every caller; with plain acceleration and a single vertex sweep it is what was published.
struct PaperOptions {
    double damping = 0.9;   // s of §7.5, in (0, 1]
    int cg_steps = 60;      // n of the global H-update (§7.1)
    int h_sweeps = 1;       // Gauss–Seidel sweeps of the local H-update
    int vertex_sweeps = 2;  // sweeps over the vertices in each update (§7.2: one)
    double epsilon = 0.0;   // stop at max |Δ_B H − f| D³ ≤ ε (|H| D for minimal surfaces); 0: from the tolerance
    Acceleration acceleration = Acceleration::anderson;
    VirtualPoints virtual_points = VirtualPoints::everywhere;
    PaperStart start = PaperStart::improved;
    int levels = 0;  // 0: chosen
};

}  // namespace fairing
