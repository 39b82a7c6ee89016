// Sharper and flatter fillets, and what they begin with.
#pragma once

#include "base/progress.h"
#include "base/types.h"

namespace fairing {

// Draws a surface towards a target (3 × n each): ∫ |Δ(x − points)|² + pull |x − target|² becomes least, where vertices
// that are `fixed`, and the slopes there, stay. `pull` (n) in length⁻⁴: within 1 / pull^¼ of its edges a target is
// smoothed, further away it is met. Vertices without triangles keep their places. Throws SolverError.
Points drawn_to(const Points& points, const Triangles& triangles, const Indices& fixed, const Points& target,
                const VectorX& pull);

// The surface of least ∫ |Δx|² (3 × n) over the mesh as it lies, with the slopes at `fixed` vertices: it rounds what is
// broken, however sharply, without a fold. `points` where no system fits.
Points least_bent(const Points& points, const Triangles& triangles, const Indices& fixed);

}  // namespace fairing
