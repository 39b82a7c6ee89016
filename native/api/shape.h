// What surfaces look like: shape/, measured on whole meshes and by input vertices. Positions must be finite.
#pragma once

#include "api/input.h"
#include "shape/flank.h"
#include "shape/girth.h"
#include "shape/knobs.h"

namespace fairing {

// The worst of all pieces; nothing where none has several loops.
std::optional<GirthRange> girth(const MeshInput& input);
// By input vertices.
GirthRange by_input(const Patch& patch, GirthRange range);

// The knobs of all pieces, and the largest extent.
Knobs knobs(const MeshInput& input, double before);

// The first piece on a flank whose whole boundary has triangles of `around`, which are numbered likewise.
std::optional<Flank> flank(const MeshInput& input, const Triangles& around);

// The deepest piece, by input vertices. `normals`: one for each input vertex; only those of fixed ones count.
Sunken sunken_below(const MeshInput& input, const Points& normals);

}  // namespace fairing
