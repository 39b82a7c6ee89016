// Nested dissection by coordinates, for matrices whose unknowns have a place.
#pragma once

#include "linear/elimination.h"

namespace fairing {

// Order of elimination (position → unknown) for a symmetric matrix given by its lower triangle. `points`: 3 × unknowns.
// Halves are cut across their longest extent; the unknowns of one half that are coupled with the other one come last
// (George 1973, Gilbert & Tarjan 1987). From some ten thousand unknowns on, it leaves less fill than minimum degree.
Indices nested_dissection(const SparseMatrix& lower, const Points& points);

}  // namespace fairing
