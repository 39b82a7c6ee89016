// The clamped bi-Laplacian, S_I M⁻¹ S x = 0, as the system in the free vertices that every linear fair solves.
#pragma once

#include "arrays.h"

// matrix x_I = load: symmetric positive definite, in the order of `free`; lower triangle and upper one stored.
struct System {
    SparseMatrix matrix;
    Points load;
};

// S: cot α + cot β of `vertices`, M: a third of the incident areas. The mesh must reach two edges beyond `free`:
// the vertices outside, which are held, clamp the solution.
System bilaplacian_system(const Points& vertices, const Triangles& triangles, const Indices& free);

// The uniform graph Laplacian of all held vertices' membrane, as a system of the same kind.
System membrane_system(const Points& vertices, const Triangles& triangles, const Indices& free);
