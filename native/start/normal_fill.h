// An initial surface that follows the normals: pipes stay pipes, however long.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"

namespace fairing {

// Positions of all vertices (3 × local vertices). The prescribed normals are continued into the patch as a
// screened harmonic field of unit vectors; the positions are those whose edges are most nearly perpendicular to it.
// Where the membrane of a long pipe necks to a needle, this is the straight pipe. Nothing where the normals cancel.
std::optional<Points> normal_fill(const Problem& problem, const Progress& progress);

}  // namespace fairing
