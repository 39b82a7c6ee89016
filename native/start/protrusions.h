// What sticks out between the outlines of a patch: fingers, horns, bags.
#pragma once

#include <optional>

#include "base/progress.h"
#include "mesh/patch.h"

namespace fairing {

// Caps of a patch: discs beyond level lines of Prandtl's torsion function of its connectivity, Δu = −1 on equilateral
// triangles with u = 0 on the outlines. It grows into everything that ends within the patch. The caps belong to the
// connectivity, so that those of several surfaces of one patch can be compared.
class Protrusions {
public:
    // Nothing where the system can't be factorised.
    static std::optional<Protrusions> of(const Patch& patch, const Progress& progress);

    [[nodiscard]] int count() const { return static_cast<int>(caps_.size()); }
    // Triangles of a cap, those that its rim runs through included.
    [[nodiscard]] const Indices& triangles(int cap) const { return caps_[at(cap)].triangles; }
    // Diagonal of the box around each cap on a surface (3 × local vertices).
    [[nodiscard]] VectorX extents(const Points& points) const;
    // L² / 4πA of each cap with rim L and area A: 1 for flat discs, ½ for hemispheres, sin α for cones of half-angle α,
    // radius over twice the length for long fingers. 0 without area.
    [[nodiscard]] VectorX bluntness(const Points& points) const;

private:
    struct Cap {
        Indices triangles;
        double level;  // of the function at the rim
    };

    explicit Protrusions(const Patch& patch) : patch_(patch) {}
    void append_caps(double level);

    const Patch& patch_;
    VectorX levels_;  // of all vertices
    std::vector<Cap> caps_;
};

}  // namespace fairing
