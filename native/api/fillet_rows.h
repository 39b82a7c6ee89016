// Places for rows of quads on a fillet's surface.
#pragma once

#include "api/fair.h"
#include "quads/shapes.h"

namespace fairing {

// A plane through a point of the boundary, to be followed to another one.
struct Section {
    Vector3 start;
    Vector3 end;
    Vector3 normal;
};

struct PlacesOnFillet {
    Points places;            // on curved triangles over the surface's,
    Indices triangle;         // the one under each,
    Points weights;           // and its barycentric coordinates there
    std::vector<char> found;  // of each section: whether it leads to its end
};

// `rows` − 1 places on each section of the only component of a mesh, which part it into ways of one length. Throws what
// check_mesh throws, and NO_FREE_VERTICES.
PlacesOnFillet section_places(const MeshInput& surface, const std::vector<Section>& sections, int rows);

// The new vertices of a pattern whose first ones stay, moved on the surface so that its quads become squares, or
// rectangles at least. Throws the same.
PlacesOnFillet relaxed_places(const MeshInput& surface, const QuadPattern& pattern, const Points& points, int sweeps);

}  // namespace fairing
