// Surfaces fitted at the vertices of a boundary to the triangles outside it, and the normals that follow from them.
#pragma once

#include "geometry/hard_edges.h"
#include "geometry/slope_fit.h"
#include "geometry/surface_fit.h"

namespace fairing {

// Edges of a boundary, as places in the list of vertices that were asked for.
using BoundaryEdges = std::vector<std::array<int, 2>>;

struct SurroundingFit {
    std::vector<std::optional<SlopeFit>> fits;  // of each vertex asked for, in units of `size`
    std::vector<char> parted;                   // hard edges meet there and no side is preferred: the fit uses all
    Points centres;                             // 3 × k: the vertices, in units of `size`
    Points averaged;                            // 3 × k: unit mean normals of the adjacent triangles, zero without any
    VectorX lengths;        // k: mean lengths of the adjacent edges, in units of `size`; zero without any
    Indices first;          // k: the first place of the same vertex
    BoundaryEdges edges;    // border edges between the vertices asked for, as indices into these
    double size = 1.0;      // of the coordinates
    VertexPairs hard = {};  // edges at which the surface around is broken
};

// A SurroundingFit whose fits and averaged normals are still to be filled in.
SurroundingFit blank_fit(const Points& points, const Triangles& triangles, const Indices& vertices, double size);

// Fits with free centres, from one side of each hard edge (SidedFits); `creases` are hard edges, too.
SurroundingFit fit_surroundings(const Points& points, const Triangles& triangles, const Indices& vertices,
                                const VertexPairs& creases = {});

struct SurroundingNormals {
    Points normals;            // 3 × k, unit; zero where there is no triangle
    std::vector<char> fitted;  // 0: averaged, for want of points
    VectorX errors;            // k, radians: standard errors of the fits; infinite where not fitted
    VectorX curvatures;        // k, length⁻¹: H (eq. 8); NaN where not fitted
    VectorX curvature_errors;  // k: their standard errors; infinite where not fitted
};

// Normals at `vertices` of the surface formed by `triangles` alone (the surroundings of a patch), filtered along the
// boundary.
SurroundingNormals surrounding_normals(const Points& points, const Triangles& triangles, const Indices& vertices,
                                       const VertexPairs& creases = {});
SurroundingNormals normals_of(const SurroundingFit& fit);

// Those triangles on which fits at the vertices, and the hard edges around them, depend.
Triangles triangles_near(const Triangles& triangles, const Indices& vertices, Eigen::Index count);

class SidedFits {
public:
    // For the vertices `at` on the surface that `triangles` form. Coordinates: as for SurfaceFits. Edges in `marked`
    // are hard. `elsewhere`, ascending: border edges that have no say in which side counts. Keeps a reference to the
    // points.
    SidedFits(const Points& points, const Triangles& triangles, const Indices& at, const VertexPairs& marked,
              const VertexPairs& elsewhere = {});

    // At one of `at`. Where hard edges take the surface apart at the vertex, the side counts on which its border edges
    // between vertices of `at` lie; where these are on several, the fit sees all of them.
    [[nodiscard]] std::optional<SlopeFit> at_vertex(int vertex);
    // Whether hard edges part the surface there, and no side counts.
    [[nodiscard]] bool is_parted(int vertex) const { return is_parted_[vertex] != 0; }
    // Edges at which the surface is broken.
    [[nodiscard]] const VertexPairs& hard() const { return hard_; }
    // The normalised sum of cross products on that side; zero without triangles.
    [[nodiscard]] Vector3 averaged(int vertex) const;

private:
    void choose_sides(const Triangles& broken, const Indices& input_vertex, const Indices& at,
                      const VertexPairs& elsewhere);

    const Points& points_;
    Triangles near_;
    VertexPairs hard_;
    Points copies_;
    Triangles broken_;
    Indices side_of_;  // of each vertex its copy that counts; `none`: the whole surface does
    std::vector<char> is_parted_;
    std::unique_ptr<SurfaceFits> one_side_;  // null without hard edges
    std::unique_ptr<SurfaceFits> whole_;
};

// The n_i (3 × k, unit) that minimise Σ |n_i − n̂_i|²/σ_i² + μ Σ |n_i − n_j − g_ij|²/(σ_i σ_j + δ_ij²) over the
// boundary's edges. n̂ and σ are the fits' normals and standard errors. g_ij is the mean of the turns from j to i that
// both fits predict. δ_ij is how far these two are apart: at a crease, or where the fits don't follow the surface.
// Normals stay where the fits agree, whatever the curvature. Where there is no fit the averaged normal stays.
Points filtered_normals(const SurroundingFit& fit);

}  // namespace fairing
