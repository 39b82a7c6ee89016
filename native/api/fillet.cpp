#include "api/fillet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <Eigen/Geometry>

#include "base/progress.h"
#include "fillet/limits.h"
#include "fillet/seam_sides.h"
#include "fillet/side_normals.h"
#include "geometry/angle.h"
#include "geometry/turned_caps.h"

namespace fairing {

namespace {

constexpr double resolution = 0.5;  // of the spacing: how finely the line is sought
constexpr double apart = 1e-7;      // of the way to the next vertex: far more than roundoff, far less than is seen

std::vector<VertexPair> joined(const std::vector<VertexPair>& a, const std::vector<VertexPair>& b) {
    std::vector<VertexPair> both = a;
    both.insert(both.end(), b.begin(), b.end());
    return both;
}

Indices triangles_at(const LevelLine& line) {
    std::set<int> found;
    for (const LineSegment& segment : line.segments) found.insert(segment.triangle);
    return {found.begin(), found.end()};
}

Indices triangles_at_walls(const SeamMesh& mesh, const SeamDistance& distance) {
    std::set<int> found;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.twin[h] == none && distance.reaches(h / 3)) found.insert(h / 3);
    }
    return {found.begin(), found.end()};
}

LevelLine points_of_fillet(const SeamMesh& mesh, const SeamDistance& distance, const FilletInput& input,
                           SideNormals& sides) {
    const LevelLine found = level_line(mesh, distance, resolution * input.spacing, snap * input.spacing);
    const Indices passed = triangles_at(found);
    sides.find_at(passed);
    LevelLine line = resampled(mesh, distance, found, input.spacing, sides);
    join_at_walls(mesh, input.spacing, line);
    part_seams(mesh, input.spacing, line);
    sides.find_at(triangles_at_walls(mesh, distance));
    part_walls(mesh, distance, sides, input.spacing, line);
    return line;
}

// A side of a piece of the fillet beyond which there is none.
struct EndSide {
    int piece;
    int from, to;
};

std::vector<EndSide> ends_of(const SplitMesh& cut) {
    std::map<std::array<int, 2>, int> inner;
    for (Eigen::Index t = 0; t < cut.triangles.cols(); ++t) {
        if (cut.inside[t] == 0) continue;
        for (int k = 0; k < 3; ++k) inner[{cut.triangles(k, t), cut.triangles((k + 1) % 3, t)}] = static_cast<int>(t);
    }
    std::vector<EndSide> ends;
    for (const auto& [side, piece] : inner) {
        if (!inner.contains({side[1], side[0]})) ends.push_back({piece, side[0], side[1]});
    }
    return ends;
}

// Barycentric weights of a place in the plane of a triangle.
Vector3 weights_in(const Points& points, const Triangles& triangles, int triangle, const Vector3& place) {
    const Vector3 start = points.col(triangles(0, triangle));
    const Vector3 along = Vector3(points.col(triangles(1, triangle))) - start;
    const Vector3 to_apex = Vector3(points.col(triangles(2, triangle))) - start;
    const double length = along.norm();
    if (!(length > 0.0)) return Vector3::Constant(1.0 / 3.0);
    const Vector3 x = along / length;
    const Vector3 above = to_apex - to_apex.dot(x) * x;
    const double height = above.norm();
    const double apex = height > 0.0 ? (place - start).dot(above) / (height * height) : 0.0;
    const double head = ((place - start).dot(x) - apex * to_apex.dot(x)) / length;
    return {1.0 - apex - head, head, apex};
}

void add_boundary(const SeamMesh& mesh, const FilletInput& input, SideNormals& sides, FilletCut& result) {
    const std::vector<EndSide> ends = ends_of(result.mesh);
    std::set<int> parents;
    for (const EndSide& end : ends) parents.insert(result.mesh.parent[end.piece]);
    sides.find_at({parents.begin(), parents.end()});
    std::map<int, std::vector<std::pair<Vector3, double>>> seen;
    const Eigen::Index old = input.vertices.cols();
    for (const EndSide& end : ends) {
        const int parent = result.mesh.parent[end.piece];
        for (const int v : {end.from, end.to}) {
            const Vector3 place = v < old ? Vector3(input.vertices.col(v)) : Vector3(result.mesh.points.col(v - old));
            const Vector3 weights = weights_in(mesh.points, mesh.triangles, parent, place);
            seen[v].emplace_back(sides.normal(parent, weights), sides.curvature(parent, weights));
        }
    }
    // The mean of the pieces there, where the side itself has no area.
    const auto around = [&](int v) {
        Vector3 sum = Vector3::Zero();
        for (const auto t : result.mesh.triangles.colwise()) {
            if (t[0] != v && t[1] != v && t[2] != v) continue;
            std::array<Vector3, 3> at;
            for (std::size_t c = 0; c < 3; ++c) {
                const int corner = t[static_cast<Eigen::Index>(c)];
                at[c] =
                    corner < old ? Vector3(input.vertices.col(corner)) : Vector3(result.mesh.points.col(corner - old));
            }
            sum += (at[1] - at[0]).cross(at[2] - at[0]);
        }
        return sum;
    };
    result.normals.resize(3, static_cast<Eigen::Index>(seen.size()));
    result.curvatures.resize(static_cast<Eigen::Index>(seen.size()));
    for (const auto& [v, found] : seen) {
        const auto k = static_cast<Eigen::Index>(result.boundary.size());
        Vector3 normal = Vector3::Zero();
        double curvature = 0.0;
        bool parted = false;
        Vector3 first = Vector3::Zero();
        for (const auto& [n, h] : found) {
            if (first.isZero()) first = n;
            parted = parted || (!n.isZero() && radians_between(n, first) > corner_angle);
            normal += n;
            curvature += h / static_cast<double>(found.size());
        }
        if (normal.isZero()) normal = around(v);
        result.boundary.push_back(v);
        result.normals.col(k) = normal.normalized();
        result.curvatures[k] = curvature;
        if (parted) result.corners.push_back(v);
    }
}

Points weights_in_parents(const FilletInput& input, const SplitMesh& cut) {
    Points weights(3, cut.triangles.size());
    const Eigen::Index old = input.vertices.cols();
    for (Eigen::Index c = 0; c < cut.triangles.size(); ++c) {
        const int v = cut.triangles(c % 3, c / 3);
        const Vector3 place = v < old ? Vector3(input.vertices.col(v)) : Vector3(cut.points.col(v - old));
        const int parent = cut.parent[static_cast<std::size_t>(c / 3)];
        weights.col(c) = weights_in(input.vertices, input.triangles, parent, place);
    }
    return weights;
}

// Parts between seams without a wall, a border or a piece outside, unless they lie between two that have one: fillets
// from both sides meet there. `thin`: parts that reach no further from their seams are less than the new mesh shows.
Indices swallowed_vertices(const SeamMesh& mesh, const SeamDistance& distance, const SplitMesh& cut, double thin) {
    const Vector3 middle = Vector3::Constant(1.0 / 3.0);
    UnionFind parts = mesh.parts();
    std::vector<char> open(mesh.triangles.cols(), 0);
    std::vector<char> thick(mesh.triangles.cols(), 0);
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.twin[h] == none) open[parts.root(h / 3)] = 1;
        if (distance.reaches(h / 3) && distance.at(h / 3, middle).distance > thin) thick[parts.root(h / 3)] = 1;
    }
    for (std::size_t t = 0; t < cut.parent.size(); ++t) {
        if (cut.inside[t] == 0) open[parts.root(cut.parent[t])] = 1;
    }
    std::map<int, std::set<int>> beside;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none || mesh.twin[h] == none) continue;
        const int other = parts.root(mesh.twin[h] / 3);
        if (open[other] != 0) beside[parts.root(h / 3)].insert(other);
    }
    std::set<int> found;
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
        const int own = parts.root(t);
        if (open[own] != 0 || thick[own] == 0 || beside[own].size() > 1) continue;
        for (const int v : mesh.triangles.col(t)) found.insert(v);
    }
    return {found.begin(), found.end()};
}

// A seam that is a cap's longest side becomes the two sides over it, likewise a wall.
void part_edges(const TurnedCap& turned, std::vector<VertexPair>& edges) {
    const int a = turned.ends[0];
    const int b = turned.ends[1];
    const auto at = std::find_if(edges.begin(), edges.end(),
                                 [&](const VertexPair& e) { return e == VertexPair{a, b} || e == VertexPair{b, a}; });
    if (at == edges.end()) return;
    const VertexPair first{(*at)[0], turned.over};
    const VertexPair second{turned.over, (*at)[1]};
    const auto is_there = [&](const VertexPair& e) {
        return std::find(edges.begin(), edges.end(), e) != edges.end() ||
               std::find(edges.begin(), edges.end(), VertexPair{e[1], e[0]}) != edges.end();
    };
    *at = is_there(first) ? second : first;
    if (!is_there(first)) edges.push_back(first);
    if (!is_there(second)) edges.push_back(second);
}

// An edge without length, as booleans leave them, has no direction in which a distance could be counted: for the cut
// its ends go apart, along the seam, so that planes stay plane; those between them by halves.
void part_doubled(FilletInput& input) {
    std::set<int> doubled;
    const auto is_one = [&](int a, int b) { return input.vertices.col(a) == input.vertices.col(b); };
    for (const auto& [a, b] : input.seams) {
        if (is_one(a, b)) doubled.insert({a, b});
    }
    std::map<int, Vector3> ways;
    for (bool changed = !doubled.empty(); changed;) {
        changed = false;
        for (const auto& [a, b] : input.seams) {
            for (const auto& [from, to] : {VertexPair{a, b}, VertexPair{b, a}}) {
                if (!doubled.contains(from) || ways.contains(from)) continue;
                const bool is_end = !is_one(from, to);
                if (!is_end && !ways.contains(to)) continue;
                ways[from] = is_end ? Vector3(apart * (input.vertices.col(to) - input.vertices.col(from)))
                                    : Vector3(0.5 * ways.at(to));
                changed = true;
            }
        }
    }
    for (const auto& [v, way] : ways) input.vertices.col(v) += way;
}

// So that seams have no triangles without area beside them. `plane`: of each triangle, one in whose plane it is.
void turn_caps_at_seams(FilletInput& input, Indices& plane) {
    std::vector<char> on_seam(static_cast<std::size_t>(input.vertices.cols()), 0);
    for (const auto& [a, b] : input.seams) on_seam[a] = on_seam[b] = 1;
    std::vector<char> at_seam(plane.size(), 0);
    for (std::size_t t = 0; t < plane.size(); ++t) {
        const auto corners = input.triangles.col(static_cast<Eigen::Index>(t));
        at_seam[t] = on_seam[corners[0]] + on_seam[corners[1]] + on_seam[corners[2]] > 1 ? 1 : 0;
    }
    const std::vector<char> all(plane.size(), 1);
    for (const TurnedCap& turned : turn_caps(input.vertices, at_seam, all, snap * input.spacing, input.triangles)) {
        plane[turned.cap] = plane[turned.beside];
        for (auto* widths : {&input.widths.left, &input.widths.right}) {
            double& width = (*widths)[turned.over];
            if (on_seam[turned.over] == 0) width = 0.5 * ((*widths)[turned.ends[0]] + (*widths)[turned.ends[1]]);
        }
        on_seam[turned.over] = 1;
        part_edges(turned, input.seams);
        part_edges(turned, input.walls);
    }
}

void turn_caps_inside(const FilletInput& input, SplitMesh& cut) {
    Points points(3, input.vertices.cols() + cut.points.cols());
    points << input.vertices, cut.points;
    for (const TurnedCap& turned : turn_caps(points, cut.inside, cut.inside, snap * input.spacing, cut.triangles))
        cut.parent[turned.cap] = cut.parent[turned.beside];
}

// What both calls begin with.
struct Prepared {
    explicit Prepared(const FilletInput& given)
        : input(with_parted(given)),
          plane(turned(input)),
          mesh(input.vertices, input.triangles, input.seams, input.walls),
          distance(directed_mesh(), input.widths, widest() + input.spacing),
          sides(mesh, joined(input.seams, input.walls)) {}

    FilletInput input;
    Indices plane;
    SeamMesh mesh;
    SeamDistance distance;
    SideNormals sides;

private:
    static FilletInput with_parted(FilletInput input) {
        part_doubled(input);
        return input;
    }
    static Indices turned(FilletInput& input) {
        Indices plane(static_cast<std::size_t>(input.triangles.cols()));
        std::iota(plane.begin(), plane.end(), 0);
        turn_caps_at_seams(input, plane);
        return plane;
    }
    const SeamMesh& directed_mesh() {
        mesh.redirect(directed(mesh, input.seams));
        return mesh;
    }
    [[nodiscard]] double widest() const {
        double result = 0.0;
        for (const auto& [a, b] : input.seams) {
            for (const int v : {a, b}) result = std::max({result, input.widths.left[v], input.widths.right[v]});
        }
        return result;
    }
};

}  // namespace

FilletLine fillet_line(const FilletInput& given, const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    const Prepared made(given);
    const SeamMesh& mesh = made.mesh;
    FilletLine result;
    result.seams = made.input.seams;
    result.line = level_line(mesh, made.distance, resolution * given.spacing, snap * given.spacing);
    join_at_walls(mesh, given.spacing, result.line);
    std::map<int, VertexPair> ends;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        ends[mesh.edge[h]] = {mesh.tail(h), mesh.head(h)};
        if (mesh.twin[h] == none && made.distance.reaches(h / 3))
            result.walls.push_back({mesh.edge[h], mesh.tail(h), mesh.head(h), h / 3, h % 3});
    }
    for (const LinePoint& point : result.line.points) {
        const SeamFoot foot = made.distance.foot(point.triangle, point.weights);
        const int h = foot.half_edge;
        result.feet.push_back(
            {h == none ? VertexPair{none, none} : VertexPair{mesh.tail(h), mesh.head(h)}, foot.corner, foot.along});
        result.ends.push_back(point.edge == none ? VertexPair{none, none} : ends.at(point.edge));
    }
    progress.report(1.0, "done");
    return result;
}

FilletCut cut_fillet(const FilletInput& given, const std::optional<LevelLine>& line, const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    Prepared made(given);
    progress.report(0.3, "distance");
    FilletCut result;
    LevelLine along = line ? *line : points_of_fillet(made.mesh, made.distance, made.input, made.sides);
    for (LinePoint& point : along.points)
        if (line) point.weights = weights_in(made.mesh.points, made.mesh.triangles, point.triangle, point.place);
    result.mesh = cut_along(made.mesh, made.distance, along);
    result.swallowed = swallowed_vertices(made.mesh, made.distance, result.mesh, 0.5 * made.input.spacing);
    progress.report(0.7, "cut");
    if (result.swallowed.empty()) add_boundary(made.mesh, made.input, made.sides, result);
    for (int& parent : result.mesh.parent) parent = made.plane[parent];
    turn_caps_inside(made.input, result.mesh);
    result.weights = weights_in_parents(given, result.mesh);
    progress.report(1.0, "done");
    return result;
}

}  // namespace fairing
