// Triangles that are turned over or pass through others, kept up to date while parts of a surface move.
#pragma once

#include "mesh/patch.h"
#include "placement/place.h"

namespace fairing {

// Local numbers, ascending, of the triangles with a free corner that are turned over, and of all that pass through
// others.
Indices torn_triangles(const Patch& patch, const Points& points);

class Tears {
public:
    // `points`: 3 × local vertices. The patch has to stay.
    Tears(const Patch& patch, const Points& points);

    // The same for a surface that differs from the last one in the places of some vertices. The result is that of a new
    // search, but only triangles that moved, their neighbours and those torn before are tested.
    [[nodiscard]] Tears after(const Points& points, const Indices& moved) const;

    [[nodiscard]] const Indices& triangles() const { return torn_; }
    [[nodiscard]] std::size_t count() const { return torn_.size(); }

private:
    Tears(const Patch& patch, Indices turned, Indices crossing);

    const Patch* patch_;
    Indices turned_;
    Indices crossing_;
    Indices torn_;  // both, each once
};

// Up to so many folds are always worked on. More of them that do not become fewer are a whole sheet that is turned
// over.
inline constexpr std::size_t few_folds = 20;

// Whether the normal of triangle `t` of the problem's patch points against the surface that its free corners lie on
// (the triangles of the target, so that noise of the boundary's normals doesn't matter). False without a free corner:
// no placement turns such a triangle.
bool is_folded(const Problem& problem, const TargetSurface& target, const Placement& placement, int t);

// All of them, as a mask.
std::vector<char> folded_mask(const Problem& problem, const TargetSurface& target, const Placement& placement);

// All of them, and those that are turned over against their neighbours in the projected mesh itself; ascending.
Indices folded_triangles(const Problem& problem, const TargetSurface& target, const Placement& placement);

// The same without triangles at the boundary that only their neighbours speak against: where the boundary itself turns
// sharply, no placement gives them other neighbours.
Indices folds_of_placement(const Problem& problem, const TargetSurface& target, const Placement& placement);

// `points` (3 × local vertices) with fewer torn triangles (placement/tears), or as they are: what lies around these is
// filled anew, then their free corners are tried elsewhere, on the surface and off it. The fixed vertices stay, and
// what lies farther than six rings from torn triangles.
Points untorn(const Patch& patch, Points points);

}  // namespace fairing
