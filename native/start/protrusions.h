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
    [[nodiscard]] const Indices& triangles(int cap) const { return caps_[cap].triangles; }
    // How far each cap reaches from the middle of its rim on a surface (3 × local vertices).
    [[nodiscard]] VectorX reaches(const Points& points) const;
    // L / 2πR of each cap with rim L and reach R: 1 for flat discs and half balls, tan α for cones of half-angle α
    // below 45°, radius over length for fingers. 0 without reach.
    [[nodiscard]] VectorX bluntness(const Points& points) const;

private:
    struct Cap {
        Indices triangles;
        double level;  // of the function at the rim
    };

    struct Size {
        double rim = 0.0;
        double reach = 0.0;
    };

    explicit Protrusions(const Patch& patch) : patch_(patch) {}
    void append_caps(double level);
    [[nodiscard]] Size size_of(const Cap& cap, const Points& points) const;

    const Patch& patch_;
    VectorX levels_;  // of all vertices
    std::vector<Cap> caps_;
};

}  // namespace fairing
