// The surface of a fillet on triangles, and new vertices on it.
#pragma once

#include <functional>
#include <map>
#include <set>

#include "geometry/nearest_point.h"

namespace fairing {

using Quad = std::array<int, 4>;
// Where a place on the triangles is on their surface.
using Carried = std::function<Vector3(const NearestPlace&)>;

// Thrown where no rows of quads fit.
struct NoRows : std::exception {};

struct RowVertex {
    NearestPlace under;  // on the triangles,
    Vector3 place;       // and where it is on their surface
    int half_edge;       // of the seam that it comes from, or `none`:
    Vector3 before;      // then where it was there
};

// Numbers: the surface's vertices, then new ones.
class RowSurface {
public:
    // Keeps references. `before`: where vertices were on the mesh; `loops`: of the border, the surface on the left.
    RowSurface(const Points& vertices, const Triangles& triangles, const Points& before,
               const std::vector<Indices>& loops, const Carried& carried);

    [[nodiscard]] int count() const { return static_cast<int>(vertices_.cols()); }
    [[nodiscard]] Vector3 place(int v) const {
        return v < count() ? Vector3(vertices_.col(v)) : made_[v - count()].place;
    }
    [[nodiscard]] Vector3 normal(int v) const;
    [[nodiscard]] Vector3 before(int v) const { return before_.col(v); }
    [[nodiscard]] double length_before(int a, int b) const { return (before(a) - before(b)).norm(); }
    [[nodiscard]] int next(int on_border) const { return next_.at(on_border); }
    [[nodiscard]] int previous(int on_border) const { return previous_.at(on_border); }

    // On the surface, nearest to a place.
    int add(const Vector3& near);
    void lift(int vertex, int half_edge, const Vector3& before);
    // New vertices that part a curve over 0 to 1, or a straight line, into edges of one length; without its ends.
    Indices along(const std::function<Vector3(double)>& curve, int parts);
    Indices between(int from, int to, int parts);
    // The shortest path over inner edges between two vertices of the border, clear of others that were asked for and
    // taken. Throws NoRows.
    [[nodiscard]] Indices path_within(int from, int to) const;
    void take(const Indices& path, int owner);
    void leave(int owner);

    [[nodiscard]] bool are_good(const std::vector<Quad>& quads) const;  // convex, and not turned over
    // The gap between two chains that begin and end beside each other or in one vertex; `to` lies on the left of
    // `from`. As roundest below.
    [[nodiscard]] std::vector<Eigen::Vector3i> zip(const Indices& from, const Indices& to) const;

    [[nodiscard]] const std::vector<RowVertex>& made() const { return made_; }

private:
    [[nodiscard]] Vector3 area(int triangle) const;
    [[nodiscard]] bool is_passable(int v) const { return !next_.contains(v) && !taken_.contains(v); }

    const Points& vertices_;
    const Triangles& triangles_;
    const Points& before_;
    const Carried& carried_;
    const NearestTriangles beneath_;
    std::map<int, int> next_, previous_;  // on the border
    std::vector<std::set<int>> beside_;
    Points normals_;
    std::map<int, int> taken_;  // inner vertices on paths: by whom
    std::vector<RowVertex> made_;
};

using VertexVector = std::function<Vector3(int)>;

// The triangulation of a polygon whose flattest triangle is roundest (G. T. Klincsek 1980). Empty where
// one would have less than `least` of twice its area over its longest side squared, which is negative where it is
// turned over.
std::vector<Eigen::Vector3i> roundest(const Indices& polygon, const VertexVector& place, const VertexVector& normal,
                                      double least);

// Degrees: the widest angle of a quad; above 180 where it is not convex.
double widest_angle(const std::array<Vector3, 4>& corners);

}  // namespace fairing
