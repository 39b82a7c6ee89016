// A start for minimal surfaces: a membrane over the outline, then less and less area.
#pragma once

#include "solver/globalisation.h"

namespace fairing {

// The discrete harmonic map of the outline by the inner-fairness weights (3 × local vertices).
Points membrane(const Problem& problem, const Workspace& work);

// Repeats x ← the harmonic map from the last surface (Pinkall & Polthier 1993), which never increases the area.
Points descend_area(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

}  // namespace fairing
