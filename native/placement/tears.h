// Triangles that are turned over or pass through others, kept up to date while parts of a surface move.
#pragma once

#include "mesh/patch.h"

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

}  // namespace fairing
