// One triangle with points and edges in it.
#pragma once

#include <map>

#include "fillet/seam_mesh.h"

namespace fairing {

// A constrained Delaunay triangulation of a triangle: Lawson's flips, and for the edges asked for Anglada's (1997)
// polygons beside them.
class CutTriangle {
public:
    using Corners = std::array<int, 3>;
    // Its corners become points 0, 1, 2, counter-clockwise.
    CutTriangle(const Vector2& a, const Vector2& b, const Vector2& c);

    // Points come first on sides, then inside; each returns its number. On side k, from corner k on: in order.
    int add_on_side(int k, const Vector2& place);
    int add_inside(const Vector2& place);
    // Makes the triangles round, and then the straight line between two points an edge. A point on that line parts it.
    // False where roundoff leaves no way to do so, in a triangle with nearly no area.
    void make_delaunay();
    [[nodiscard]] bool add_edge(int a, int b);

    [[nodiscard]] const Vector2& place(int point) const { return places_[point]; }

    [[nodiscard]] const std::vector<Corners>& triangles() const { return triangles_; }
    // The triangle with this directed side, or `none`.
    [[nodiscard]] int at(int from, int to) const;
    [[nodiscard]] bool is_held(int a, int b) const;

private:
    [[nodiscard]] double area(int a, int b, int c) const;
    [[nodiscard]] int opposite(int triangle, int a, int b) const;
    [[nodiscard]] bool is_on(int a, int b, int point) const;
    void put(int triangle, const Corners& corners);
    void remove_sides(int triangle);
    bool flip(int a, int b);
    bool join(int a, int b);  // without points between
    struct Passage {          // what the line between two points crosses, from the first one on
        Indices triangles;
        Indices left, right;  // points beside it
    };
    [[nodiscard]] std::optional<Passage> passage(int a, int b) const;
    [[nodiscard]] bool cover(int a, int b, const Indices& chain, std::vector<Corners>& made) const;
    [[nodiscard]] bool is_in_circle(int a, int b, int c, int d) const;
    [[nodiscard]] int point_between(int a, int b) const;

    std::vector<Vector2> places_;
    std::vector<Corners> triangles_;
    std::map<std::array<int, 2>, int> sides_;
    std::map<std::array<int, 2>, char> held_;
    std::array<int, 3> last_on_side_{0, 1, 2};
    double flat_;  // twice the area of a triangle that counts as none
};

}  // namespace fairing
