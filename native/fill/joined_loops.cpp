#include "fill/joined_loops.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "fill/triangulation.h"

namespace fairing {

namespace {

Vector3 centre_of(const Points& points, const Indices& loop) {
    Vector3 sum = Vector3::Zero();
    for (const int v : loop) sum += points.col(v);
    return sum / static_cast<double>(loop.size());
}

// Area vector of a loop seen from a centre: Σ ½ d_i × d_{i+1}.
Vector3 area_vector(const Points& places, const Indices& loop) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vector3 here = places.col(loop[k]);
        sum += 0.5 * here.cross(Vector3(places.col(loop[(k + 1) % loop.size()])));
    }
    return sum;
}

struct Link {
    double length = std::numeric_limits<double>::infinity();
    std::size_t place = 0;  // in the polygon
    std::size_t loop = 0;
    std::size_t start = 0;  // in that loop
};

// The shortest path from the polygon to a loop that isn't part of it yet. Corners at the end of a link are left out: at
// these the order around the corner would matter.
Link shortest_link(const Points& points, const Indices& polygon, const std::vector<Indices>& loops,
                   const std::vector<char>& joined) {
    Link best;
    for (std::size_t place = 0; place < polygon.size(); ++place) {
        if (std::count(polygon.begin(), polygon.end(), polygon[place]) > 1) continue;
        for (std::size_t l = 0; l < loops.size(); ++l) {
            if (joined[l]) continue;
            for (std::size_t k = 0; k < loops[l].size(); ++k) {
                const double length = (points.col(polygon[place]) - points.col(loops[l][k])).squaredNorm();
                if (length < best.length) best = {length, place, l, k};
            }
        }
    }
    return best;
}

// Once around all loops, along each link twice.
Indices linked(const Points& points, const std::vector<Indices>& loops) {
    Indices polygon = loops.front();
    std::vector<char> joined(loops.size(), 0);
    joined[0] = 1;
    for (std::size_t count = 1; count < loops.size(); ++count) {
        const Link link = shortest_link(points, polygon, loops, joined);
        const Indices& loop = loops[link.loop];
        joined[link.loop] = 1;
        Indices detour;
        for (std::size_t k = 0; k <= loop.size(); ++k) detour.push_back(loop[(link.start + k) % loop.size()]);
        detour.push_back(polygon[link.place]);
        polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(link.place) + 1, detour.begin(), detour.end());
    }
    return polygon;
}

TriangleCost cost_around(const Points& points, const std::vector<Indices>& loops) {
    Vector3 centre = Vector3::Zero();
    for (const Indices& loop : loops) centre += centre_of(points, loop) / static_cast<double>(loops.size());
    Points directions(3, points.cols());
    for (Eigen::Index v = 0; v < points.cols(); ++v) directions.col(v) = direction(points.col(v) - centre);
    // Seen from outside, a loop with the surface on its left runs clockwise around the hole that it leaves.
    double clockwise = 0.0;
    for (const Indices& loop : loops)
        clockwise -= area_vector(directions, loop).dot(direction(centre_of(points, loop) - centre));
    return {points, std::move(directions), clockwise >= 0.0 ? 1.0 : -1.0};
}

}  // namespace

Triangles joined_loops(const Points& points, const std::vector<Indices>& loops, const Points* normals) {
    const TriangleCost cost =
        loops.size() == 1 || normals != nullptr ? TriangleCost(points) : cost_around(points, loops);
    const Indices polygon = loops.size() == 1 ? loops.front() : linked(points, loops);
    return as_columns(cheapest_triangulation(polygon, normals == nullptr ? cost : cost.along(*normals)));
}

Triangles triangulated_faces(const Points& points, const Indices& corners, const Indices& sizes) {
    std::vector<Eigen::Vector3i> triangles;
    auto begin = corners.begin();
    for (const int size : sizes) {
        const Indices face(begin, begin + size);
        begin += size;
        const Points local = points(Eigen::all, face).colwise() - points.col(face.front());
        Indices own(face.size());
        std::iota(own.begin(), own.end(), 0);
        const Points normals = area_vector(local, own).stableNormalized().replicate(1, size);
        for (const Eigen::Vector3i& each : cheapest_triangulation(own, TriangleCost(local).along(normals)))
            triangles.emplace_back(face[each[0]], face[each[1]], face[each[2]]);
    }
    return as_columns(triangles);
}

}  // namespace fairing
