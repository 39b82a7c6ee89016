// The choices that the paper leaves open, and additions to it.
#pragma once

namespace fairing {

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
    Acceleration acceleration = Acceleration::anderson;
    int levels = 0;  // 0: chosen
};

}  // namespace fairing
