// Surfaces of an equation that an artist would undo: waists and bulges between outlines.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"

namespace fairing {

// Whether a surface (3 × local vertices) between several outlines has a cross-section of less than half of what the
// shape before makes expect, or of more than 1.4 times that (method/girths), 1.2 of a tube that lies aside of
// that shape. False where it hardly bends both ways, or no shape before is known.
bool is_misshapen(const Problem& problem, const Points& points, const Progress& progress);

// Whether the first of two surfaces has waists, bulges or dents that the other has not.
bool is_wavier(const Patch& patch, const Points& points, const Points& other);

}  // namespace fairing
