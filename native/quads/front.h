// The boundary of what is still open while a hole is filled with quads, and the moves that leave less of it.
#pragma once

#include "base/types.h"

namespace fairing {

// Quads over a hole, and one triangle where its boundary has an odd number of edges. Vertices 0 … boundary_count − 1
// are the boundary's in their order, the pattern on their left; the others are new.
struct QuadPattern {
    int boundary_count = 0;
    int vertex_count = 0;
    std::vector<std::array<int, 4>> quads;  // counter-clockwise
    std::vector<std::array<int, 3>> triangles;
    // On a tube, edges along which the angle around it grows by a turn more than the difference of those at their ends.
    std::vector<std::array<int, 2>> over_seam;
};

// A place on the lattice of unit squares.
struct Lattice {
    int x = 0;
    int y = 0;
    friend bool operator==(const Lattice&, const Lattice&) = default;
    friend Lattice operator+(const Lattice& a, const Lattice& b) { return {a.x + b.x, a.y + b.y}; }
    friend Lattice operator-(const Lattice& a, const Lattice& b) { return {a.x - b.x, a.y - b.y}; }
    [[nodiscard]] Lattice turned(int quarters) const;  // counter-clockwise
};

// An irregular vertex inside, of three quads (`quarters` 1) or five (−1), or the triangle (1), which lies on the edge
// from the front's vertex `at` to the next. Without any, all rows would be those of a plane grid.
struct Pole {
    int at = 0;
    int quarters = 0;
    bool triangle = false;
};

// The squared errors, in units of 45°, of so many quads that share a boundary's angle (degrees), summed.
inline double angles_error(double angle, int faces) {
    const double each = (angle / faces - 90.0) / 45.0;
    return faces * each * each;
}

inline constexpr double weight_of_angles = 0.2;  // of their mean over the boundary, relative to a pattern's misfit

// A closed walk around the open part, that part on its left. `faces`: how many quads each vertex still gets there, 1 at
// a convex corner, 2 where it is straight, 3 at a concave corner. A part of a plane grid turns by Σ (2 − faces) = 4
// quarters, and a walk along unit edges returns to its start.
class QuadFront {
public:
    // `faces` at the boundary, one or more each; `places`: (2 × n) approximate positions in a plane; `angles` there in
    // degrees, or none.
    QuadFront(const Indices& faces, const Eigen::Matrix2Xd& places, VectorX angles);

    [[nodiscard]] int size() const { return static_cast<int>(vertices_.size()); }
    [[nodiscard]] const Indices& faces() const { return faces_; }
    [[nodiscard]] const std::vector<Eigen::Vector2d>& places() const { return places_; }
    [[nodiscard]] int boundary_count() const { return pattern_.boundary_count; }
    [[nodiscard]] int quad_count() const { return static_cast<int>(pattern_.quads.size()); }
    [[nodiscard]] bool is_new(int at) const { return vertices_[at] >= pattern_.boundary_count; }
    [[nodiscard]] int quarters() const;
    // The cost of turning by so many quarters more at a vertex of the walk, with as many quads less: 0 at new vertices
    // (they become poles); at the boundary the growth of the angles' squared errors, in units of 45°. Empty where no
    // angle or new vertex allows it.
    [[nodiscard]] std::optional<double> cost_of_turning(int at, int quarters) const;
    // size() + 1 points: from (0, 0) along the walk and back to the first vertex, which need not be at (0, 0) again.
    [[nodiscard]] std::vector<Lattice> walk() const;

    // A row of quads along the whole walk. False, and nothing changes, where it would meet itself.
    bool add_ring();
    // A row along the side that begins at the convex corner `at`. False where no convex corner ends it, or where it
    // would use up the adjacent edges.
    bool add_row(int at);
    // A row along a side of one or two edges, too short for a ring.
    bool add_short_row();
    // False where a vertex would have no quad left. Poles by ascending `at`.
    bool place(const std::vector<Pole>& poles);
    // The pattern with the open part filled by a grid; none where that part is no simple polygon of the lattice.
    [[nodiscard]] std::optional<QuadPattern> filled() const;

private:
    using Spokes = std::vector<Indices>;
    [[nodiscard]] int before(int at) const { return at == 0 ? size() - 1 : at - 1; }
    [[nodiscard]] int after(int at) const { return at == size() - 1 ? 0 : at + 1; }
    [[nodiscard]] bool ring_meets_itself() const;
    int new_vertex(const Eigen::Vector2d& place);
    [[nodiscard]] Eigen::Vector2d inwards(int at, double share) const;
    [[nodiscard]] Spokes spokes_of_ring(int first_new);
    void take(const Indices& vertices, int first_new);

    QuadPattern pattern_;
    VectorX angles_;  // at the boundary
    Indices vertices_;
    Indices faces_;
    Indices quads_at_;                         // each vertex of the boundary, made or still to come
    std::vector<Eigen::Vector2d> places_;      // of the walk's vertices
    std::vector<Eigen::Vector2d> new_places_;  // of all new vertices
};

}  // namespace fairing
