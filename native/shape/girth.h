// How thick a surface is between its boundary loops.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Cross-sections of a patch around each of its boundary loops: level lines of a function that is about harmonic on
// equilateral triangles, 1 on that loop and 0 on all others. The lines belong to the connectivity, so that those of
// several surfaces of one patch can be compared. Keeps a reference to the patch.
class CrossSections {
public:
    // Nothing with fewer than two loops. O(vertices).
    static std::optional<CrossSections> of(const Patch& patch);

    // Loops with sections of their own; two loops have the same.
    [[nodiscard]] int count() const { return static_cast<int>(levels_.size()); }
    // Radii of the sections around one loop on a surface (3 × local vertices), from the others towards it: of the
    // circle with the same area, which is the area of the section's shadow in the direction in which that is largest.
    // Steps and noise of the mesh hardly add to it, as they do to a length.
    [[nodiscard]] VectorX radii(int loop, const Points& points) const;
    // The triangles that a section runs through.
    [[nodiscard]] Indices triangles(int loop, int section) const;

private:
    explicit CrossSections(const Patch& patch) : patch_(patch) {}

    const Patch& patch_;
    std::vector<VectorX> levels_;  // of all vertices, for each loop
};

// The radius of the thinnest cross-section over that of the thinner of its two ends, and that of the thickest over the
// thicker end's: 1 and 1 or nearly so for tubes and cones, less than 1 for waists, more than 1 for balloons and where
// arms meet (1.3 in a star of three equal ones). One end of a section is its loop, the other one are all others
// together.
struct GirthRange {
    double least = 1.0;
    double largest = 1.0;
    Indices thinnest;  // vertices beside these two cross-sections, ascending; none where the figure is 1
    Indices thickest;
};

// By local vertices, of a surface (3 × local vertices). Nothing with fewer than two loops.
std::optional<GirthRange> girth_range(const Patch& patch, const Points& points);
// Whether a surface with these normals at its fixed vertices leaves each loop along a tube (start/swept_tube): a girth
// is no flaw of others.
bool is_between_tubes(const Patch& patch, const Points& points, const Points& fixed_normals);

// The worse of both sides.
GirthRange worst_of(const GirthRange& a, const GirthRange& b);

}  // namespace fairing
