// Places for rows of quads on a fillet's surface.
#pragma once

#include <memory>

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

// The only component of a mesh.
class FilletSurface {
public:
    // Throws what check_mesh throws, and NO_FREE_VERTICES.
    FilletSurface(Points vertices, Triangles triangles, Indices fixed, Points normals);
    ~FilletSurface();
    FilletSurface(const FilletSurface&) = delete;
    FilletSurface& operator=(const FilletSurface&) = delete;

    // `rows` − 1 places on each section, which part it into ways of one length.
    [[nodiscard]] PlacesOnFillet sections(const std::vector<Section>& sections, int rows) const;
    // The vertices of a pattern, of which the new ones are moved on the surface so that its quads become squares, or
    // rectangles at least.
    [[nodiscard]] PlacesOnFillet relaxed(const QuadPattern& pattern, const Points& points, int sweeps) const;

private:
    struct Solved;
    std::unique_ptr<const Solved> solved_;
};

}  // namespace fairing
