// One component of a call: from the caller's units to the solver's and back.
#pragma once

#include "api/fair.h"
#include "api/input.h"

namespace fairing {

// The similarity that takes a component to D = 1 with the centroid of its fixed vertices at the origin.
struct Normalisation {
    Vector3 centre;
    double diameter;  // D: twice the largest distance of the fixed vertices from their centroid

    [[nodiscard]] Points to_unit(const Points& points) const { return (points.colwise() - centre) / diameter; }
    [[nodiscard]] Points from_unit(const Points& points) const { return (points * diameter).colwise() + centre; }
};

// Columns of `points` at the given vertices.
Points gather(const Eigen::Ref<const Points>& points, std::span<const int> vertices);

Normalisation normalise(const Points& fixed_points);

// a: the RMS distance of a component's boundary from its centroid. The boundary is the vertices of edges with the
// component on one side only; in a closed component, which pins hold, all fixed vertices. 3 × fixed points.
double boundary_radius(const Patch& patch, const Points& fixed_points);

// Columns belong to the input's vertices.
struct ComponentData {
    View<Points> vertices;
    const FixedNormals& normals;      // prescribed ones
    const VectorX& curvatures;        // likewise; empty: none
    View<Points> reference;           // M0
    const Triangles& outside;         // around the patches
    bool given_normals;               // by the caller
    const std::vector<char>& faired;  // border vertices that become fair
};

// Input numbers of a patch's free vertices, and of its fixed ones.
std::span<const int> free_vertices(const Patch& patch);
std::span<const int> fixed_vertices(const Patch& patch);

// λ of one patch, from its own edges, from `neighbours`, from the caller's weights or from the reference (3 × local
// vertices; not read for uniform ones).
Lambda make_lambda(const Patch& patch, const Points& reference, InnerFairness kind, const FairOptions& options);

}  // namespace fairing
