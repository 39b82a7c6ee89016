// CGAL's Polygon_mesh_processing::fair with fairing_continuity = 1 (C1, its default).
#pragma once

#include "arrays.h"

enum class CgalSolver { sparse_lu, umfpack };  // sparse_lu: CGAL's default, Eigen's SparseLU with COLAMD

// Positions of all vertices; only `free` ones move. The mesh must reach two edges beyond them.
// Throws std::runtime_error where CGAL reports failure.
Points cgal_fair(const Points& vertices, const Triangles& triangles, const Indices& free, CgalSolver solver);
