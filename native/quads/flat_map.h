// A surface over one boundary loop, or between two, flattened to a disc or to a ring.
#pragma once

#include "fairness/harmonic_values.h"
#include "geometry/target_surface.h"
#include "quads/tube.h"

namespace fairing {

// Harmonic with positive weights: where they are those of the edges no triangle is turned over (Tutte 1963). A disc's
// boundary lies on the unit circle. A tube is mapped to a cylinder, and that to the ring between two circles.
class FlatMap {
public:
    // The arguments must outlive it. Throws SolverError where the surface can't be flattened. Precondition: the patch
    // has one boundary loop or two, which pass no vertex twice.
    FlatMap(const Patch& patch, const Points& points);

    // Loops of local vertices, the patch on their left. The second one begins near the beginning of the first.
    [[nodiscard]] const std::vector<Indices>& loops() const { return loops_; }
    [[nodiscard]] bool is_tube() const { return loops_.size() == 2; }
    // Precondition: one loop.
    [[nodiscard]] HoleBoundary hole() const;
    // Precondition: two.
    [[nodiscard]] TubeBoundary tube() const;
    // The mean length of the boundary's edges.
    [[nodiscard]] double edge_length() const;

    using Flat = Eigen::Matrix2Xd;
    // Flat positions of a pattern's vertices, with equal weights.
    [[nodiscard]] Flat places(const QuadPattern& pattern) const;
    // The triangle that contains a flat position, or the nearest one.
    [[nodiscard]] SurfacePoint located(const Eigen::Vector2d& place) const;

private:
    void cut_tube();
    // Values at the patch's vertices; on a tube angle and height.
    [[nodiscard]] Flat inside() const;
    [[nodiscard]] Flat known() const;
    [[nodiscard]] VectorX along(const Indices& loop) const;
    [[nodiscard]] VectorX angles() const;
    [[nodiscard]] double area() const;
    [[nodiscard]] Flat on_plane(Flat flat) const;
    static Flat solved(const HarmonicProblem& problem, const Flat& flat);
    [[nodiscard]] std::array<int, 2> bin_of(const Eigen::Vector2d& place) const;
    void sort_triangles();

    const Patch& patch_;
    const Points& points_;
    std::vector<Indices> loops_;
    Indices cut_;  // of a tube: vertices from loop to loop
    Flat flat_;    // of the patch's vertices, in the plane
    int bins_ = 1;
    std::vector<Indices> in_bin_;
};

}  // namespace fairing
