// Fits at vertices of a boundary that see one side of each hard edge.
#pragma once

#include <memory>
#include <optional>

#include "geometry/hard_edges.h"
#include "geometry/surface_fit.h"

namespace fairing {

// Those triangles on which fits at the vertices, and the hard edges around them, depend.
Triangles triangles_near(const Triangles& triangles, const Indices& vertices, Eigen::Index count);

class SidedFits {
public:
    // For the vertices `at` on the surface that `triangles` form. Coordinates: as for SurfaceFits. Edges in `marked`
    // are hard. `elsewhere`, ascending: border edges that choose no side. Keeps a reference to the points.
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

}  // namespace fairing
