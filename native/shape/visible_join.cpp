#include "shape/visible_join.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "base/parallel.h"
#include "geometry/dihedral_bands.h"
#include "geometry/triangle.h"
#include "mesh/loops.h"
#include "mesh/twins.h"
#include "shape/kinks.h"
#include "shape/limits.h"

namespace fairing {

namespace {

Vector3 normal_of(const Points& points, const Triangles& triangles, int side) {
    return direction(area_vector(points, triangles.col(side / 3)));
}

double angle_at(const JoinedMesh& mesh, const Meeting& edge) {
    const int opposite = mesh.outside((edge.outside % 3 + 2) % 3, edge.outside / 3);
    return dihedral_angle(normal_of(mesh.vertices, mesh.inside, edge.inside),
                          normal_of(mesh.vertices, mesh.outside, edge.outside), mesh.vertices.col(edge.ends[0]),
                          mesh.vertices.col(opposite));
}

// Between two of the sorted values, where it falls there.
double percentile(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double above = sorted[std::min(below + 1, sorted.size() - 1)];
    return sorted[below] + (place - static_cast<double>(below)) * (above - sorted[below]);
}

// Nine tenths of the edges bend within some range. Where it is narrow, what exceeds it is seen; of a wide one half is
// enough: coarse cages bend at every edge.
double limit_among(const DihedralBands& bands, Eigen::Index triangle_count) {
    if (triangle_count == 0) return visible_kink;  // nothing is known
    std::vector<double> angles;
    for (int e = 0; e < bands.edges().size(); ++e) {
        if (bands.edges().side_count(e) == 2) angles.push_back(bands.angle(e));
    }
    if (angles.empty()) return finest_kink;
    std::sort(angles.begin(), angles.end());
    const double range = percentile(angles, 0.95) - percentile(angles, 0.05);
    return std::clamp(std::max(std::min(range, visible_kink), 0.5 * range), finest_kink, steep_kink);
}

bool is_border(const Patch& patch, const std::array<int, 2>& ends) {
    const RingView ring = patch.ring(ends[0]);
    return !ring.closed() && (ring.vertices.front() == ends[1] || ring.vertices.back() == ends[1]);
}

Indices border_of(const Patch& patch) {
    Indices border;
    for (int v = patch.free_count; v < patch.vertex_count(); ++v) {
        if (!patch.ring(v).closed()) border.push_back(v);
    }
    return border;
}

// The strip's sides on the patch's border, in the order of their edges.
Indices border_sides(const Patch& patch, const PatchStrip& strip, const EdgeTable& edges) {
    Indices sides;
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) != 1) continue;
        const auto [a, b] = edges.ends[e];
        if (is_border(patch, {strip.vertices[a], strip.vertices[b]})) sides.push_back(edges.side(e, 0));
    }
    return sides;
}

// Twice the angle by which the normals lean outwards from the triangle at a border side, degrees.
double mirrored_angle(const Triangles& triangles, const Points& points, int side, const Vector3& normal) {
    const Vector3 face = normal_of(points, triangles, side);
    const Vector3 along = points.col(side_head(triangles, side)) - points.col(side_tail(triangles, side));
    const Vector3 outwards = direction(along.cross(face));
    return 2.0 * std::atan2(normal.dot(outwards), normal.dot(face)) * 180.0 / std::numbers::pi;
}

}  // namespace

VisibleJoin visible_join(const JoinedMesh& given, const Indices& boundary) {
    const JoinedMesh mesh{given.vertices, without_collapsed(given.inside), without_collapsed(given.outside)};
    const DihedralBands inside(mesh.vertices, mesh.inside);
    const DihedralBands outside(mesh.vertices, mesh.outside);
    DihedralBands::Walk walk_inside = inside.walk();
    DihedralBands::Walk walk_outside = outside.walk();
    EdgeMeans means(mesh.vertices.cols());
    for (const Meeting& edge : meetings(inside.edges(), outside.edges())) {
        const auto [a, b] = edge.ends;
        AngleRange usual = inside.usual(a, b, walk_inside);
        usual.include(outside.usual(a, b, walk_outside));
        means.add(edge.ends, usual.excess(angle_at(mesh, edge)), (mesh.vertices.col(a) - mesh.vertices.col(b)).norm());
    }
    VisibleJoin join;
    join.degrees.resize(static_cast<Eigen::Index>(boundary.size()));
    for (Eigen::Index k = 0; k < join.degrees.size(); ++k) join.degrees[k] = means[boundary[static_cast<int>(k)]];
    join.limit = limit_among(outside, mesh.outside.cols());
    join.seen = seen_along(join.degrees, join.limit);
    return join;
}

VectorX one_sided_join(const Patch& patch, const Points& points, const Points& prescribed) {
    // All triangles that the bands of border edges depend on: of a large patch few.
    const PatchStrip strip = strip_around(patch, border_of(patch), DihedralBands::rings);
    const Points places = strip.gather(points);
    const DihedralBands bands(places, strip.triangles);
    const Indices sides = border_sides(patch, strip, bands.edges());
    VectorX excess(static_cast<Eigen::Index>(sides.size()));
    for_ranges(static_cast<int>(sides.size()), fine_grain, [&](int begin, int end) {
        DihedralBands::Walk walk = bands.walk();
        for (int k = begin; k < end; ++k) {
            const int side = sides[k];
            const auto [a, b] = bands.edges().ends[bands.edges().edge_of_side[side]];
            const Vector3 normal = prescribed.col(strip.vertices[a] - patch.free_count) +
                                   prescribed.col(strip.vertices[b] - patch.free_count);
            const double angle = mirrored_angle(strip.triangles, places, side, normal);
            excess[k] = bands.usual(a, b, walk).excess(angle);
        }
    });
    EdgeMeans means(places.cols());
    for (Eigen::Index k = 0; k < excess.size(); ++k) {
        const std::array<int, 2> ends = bands.edges().ends[bands.edges().edge_of_side[sides[std::size_t(k)]]];
        means.add(ends, excess[k], (places.col(ends[0]) - places.col(ends[1])).norm());
    }
    VectorX join = VectorX::Zero(prescribed.cols());
    for (int k = 0; k < static_cast<int>(join.size()); ++k) {
        const int local = strip.local[patch.free_count + k];
        if (local != none) join[k] = means[local];
    }
    return join;
}

}  // namespace fairing
