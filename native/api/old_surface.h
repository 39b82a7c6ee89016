// The patch of one component with the surface on it, on which a new mesh is made.
#pragma once

#include "api/component.h"
#include "fill/edge_lengths.h"

namespace fairing {

// In units of D. The arguments must outlive it.
struct OldSurface {
    OldSurface(const MeshInput& input, const CheckedMesh& mesh, const Patch& component);

    [[nodiscard]] VectorX lengths(const WantedLengths& wanted, const KeptEdges& kept = {}) const;

    const Patch& patch;
    Normalisation unit;
    Points points;
    Points normals;

private:
    void fit_at_creases(const std::vector<char>& free_slope);
};

// Those with free vertices. Throws NO_FREE_VERTICES where there are none.
std::vector<Patch> patches_with_vertices(const CheckedMesh& mesh);

}  // namespace fairing
