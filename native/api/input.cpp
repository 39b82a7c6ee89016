#include "api/input.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "base/errors.h"
#include "mesh/memory_order.h"

namespace fairing {

namespace {

void check_indices(const MeshInput& input) {
    const auto count = static_cast<int>(input.vertices.cols());
    Indices offenders;
    for (int t = 0; t < input.triangles.cols(); ++t) {
        const auto corners = input.triangles.col(t);
        if (corners.minCoeff() < 0 || corners.maxCoeff() >= count) offenders.push_back(t);
    }
    if (offenders.empty()) return;
    const auto corners = input.triangles.col(offenders.front());
    const int vertex = corners.minCoeff() < 0 ? corners.minCoeff() : corners.maxCoeff();
    throw MeshError({Code::index_range,
                     "triangles: row " + std::to_string(offenders.front()) + " names vertex " + std::to_string(vertex) +
                         ", outside 0 … " + std::to_string(count - 1),
                     std::move(offenders),
                     ElementKind::triangle,
                     {{"vertex", vertex}, {"vertices", count}}});
}

std::vector<char> marks_of(const MeshInput& input, const Indices& vertices, const std::string& name) {
    const auto count = static_cast<int>(input.vertices.cols());
    std::vector<char> marks(count, 0);
    for (const int v : vertices) {
        if (v < 0 || v >= count) {
            throw MeshError({Code::index_range,
                             name + " names vertex " + std::to_string(v) + ", outside 0 … " + std::to_string(count - 1),
                             {v},
                             ElementKind::vertex,
                             {{"vertex", v}, {"vertices", count}}});
        }
        if (marks[v] && name == "fixed")
            throw std::invalid_argument("fixed names vertex " + std::to_string(v) + " twice");
        marks[v] = 1;
    }
    return marks;
}

// A vertex whose slope the surface finds is fixed, and has one kind of slope.
void check_slopes(const GivenRoles& given, const VertexRoles& roles) {
    for (std::size_t v = 0; v < given.fixed.size(); ++v) {
        if (!given.crease[v] && !given.smooth[v]) continue;
        const std::string name = given.crease[v] ? "creases" : "smooth_curves";
        if (roles.used[v] && !roles.fixed[v])
            throw std::invalid_argument(name + " names vertex " + std::to_string(v) + ", which is not fixed");
        if (given.crease[v] && given.smooth[v])
            throw std::invalid_argument("vertex " + std::to_string(v) + " is named by creases and by smooth_curves");
    }
}

// Triangles that nothing moves and that have a corner at infinity or nowhere say nothing about the rest: left out.
Triangles drop_unbounded_triangles(const MeshInput& input, const Triangles& triangles,
                                   const std::vector<char>& given_fixed, Indices& kept, Diagnostics& warnings) {
    if (input.vertices.allFinite()) return triangles;
    Indices dropped;
    Indices kept_columns;
    Indices kept_input;
    for (int t = 0; t < triangles.cols(); ++t) {
        const auto c = triangles.col(t);
        const bool held = given_fixed[c[0]] && given_fixed[c[1]] && given_fixed[c[2]];
        if (held && !input.vertices(Eigen::all, c).allFinite()) {
            dropped.push_back(kept[t]);
        } else {
            kept_columns.push_back(t);
            kept_input.push_back(kept[t]);
        }
    }
    kept = std::move(kept_input);
    if (!dropped.empty()) {
        warnings.push_back(about(
            Code::degenerate_face,
            counted(dropped.size(), "triangle between fixed vertices has a corner that is NaN or infinite and was",
                    "triangles between fixed vertices have a corner that is NaN or infinite and were") +
                " left out",
            dropped, ElementKind::triangle, "unbounded"));
    }
    return triangles(Eigen::all, kept_columns);
}

void check_finite(const MeshInput& input, const VertexRoles& roles) {
    Indices offenders;
    for (int v = 0; v < input.vertices.cols(); ++v) {
        if (roles.used[v] && !input.vertices.col(v).allFinite()) offenders.push_back(v);
    }
    if (!offenders.empty()) {
        throw MeshError(
            about(Code::nonfinite,
                  "vertex " + std::to_string(offenders.front()) + " has a coordinate that is NaN or infinite",
                  offenders, ElementKind::vertex, "vertices"));
    }
}

Indices all_fixed(const MeshInput& input, const VertexRoles& roles, Diagnostics& warnings) {
    Indices fixed = input.fixed.value_or(Indices{});
    std::vector<char> given(roles.fixed.size(), 0);
    for (int v : fixed) given[v] = 1;
    Indices added;
    for (int v = 0; v < static_cast<int>(roles.fixed.size()); ++v) {
        if (roles.border[v] && !roles.faired[v] && !given[v]) added.push_back(v);
    }
    fixed.insert(fixed.end(), added.begin(), added.end());
    if (input.fixed && !added.empty()) {
        warnings.push_back(
            about(Code::open_border_in_selection,
                  counted(added.size(), "vertex on an open border was not given as fixed and stays where it is",
                          "vertices on an open border were not given as fixed and stay where they are") +
                      "; where this is a seam of doubled vertices, use Merge by Distance first",
                  added, ElementKind::vertex, "vertices"));
    }
    return fixed;
}

// Average of the unit normals of the triangles at each fixed vertex (paper §7.5), zero at the others.
Points averaged_triangle_normals(const View<Points>& points, const CutMesh& mesh, const VertexRoles& roles) {
    Points sums = Points::Zero(3, points.cols());
    for (const auto t : mesh.triangles.colwise()) {
        const auto v = [&](int k) { return mesh.input_vertex[t[k]]; };
        if (!roles.fixed[v(0)] && !roles.fixed[v(1)] && !roles.fixed[v(2)]) continue;
        const Vector3 a = points.col(v(0));
        const Vector3 ab = points.col(v(1)) - a;
        const Vector3 cross = ab.stableNormalized().cross(Vector3(points.col(v(2)) - a).stableNormalized());
        const double length = cross.norm();
        if (!(length > 0.0)) continue;
        for (int k = 0; k < 3; ++k) sums.col(v(k)) += cross / length;
    }
    for (int v = 0; v < sums.cols(); ++v) {
        sums.col(v) = roles.fixed[v] ? direction(sums.col(v)) : Vector3(Vector3::Zero());
    }
    return sums;
}

void refuse_zero_normal(std::size_t row, int vertex) {
    throw MeshError({Code::zero_normal,
                     "fixed_normals: row " + std::to_string(row) + " (vertex " + std::to_string(vertex) +
                         ") has length zero; a unit normal is needed there",
                     {vertex},
                     ElementKind::vertex,
                     {{"row", static_cast<double>(row)}}});
}

void copy_given_normals(const MeshInput& input, CheckedMesh& mesh) {
    for (std::size_t k = 0; k < input.fixed->size(); ++k) {
        const int v = (*input.fixed)[k];
        if (!mesh.roles.used[v] || mesh.roles.pin[v]) continue;
        const Vector3 n = input.fixed_normals->col(static_cast<Eigen::Index>(k));
        if (!n.allFinite()) {
            throw MeshError({Code::nonfinite,
                             "the normal prescribed at vertex " + std::to_string(v) + " is NaN or infinite",
                             {v},
                             ElementKind::vertex,
                             {{"normals", 1}}});
        }
        mesh.normals(v) = direction(n);
        if (mesh.normals(v).isZero()) refuse_zero_normal(k, v);
    }
}

void warn_of_normals(const MeshInput& input, CheckedMesh& mesh) {
    if (!input.fixed_normals) {
        mesh.warnings.push_back({Code::normals_from_patch,
                                 "no normals were prescribed: averages of the triangles given are used, so the result "
                                 "depends on the interior",
                                 {},
                                 {},
                                 {}});
        return;
    }
    Indices pins;
    for (std::size_t k = 0; k < input.fixed->size(); ++k) {
        const int v = (*input.fixed)[k];
        if (mesh.roles.pin[v] && !mesh.roles.free_slope[v] &&
            input.fixed_normals->col(static_cast<Eigen::Index>(k)).norm() > 0.0)
            pins.push_back(v);
    }
    if (pins.empty()) return;
    mesh.warnings.push_back(
        about(Code::pin_normal_ignored,
              counted(pins.size(), "fixed vertex has no fixed neighbour: its position counts, its normal doesn't",
                      "fixed vertices have no fixed neighbour: their position counts, their normal doesn't"),
              pins, ElementKind::vertex, "vertices"));
}

// Normals that point to the side from which the triangles given are clockwise. The interior given may be noise, and a
// strongly curved surface over a flat one may differ by more than a right angle (a cap of 140°): only many that are
// nearly opposite count.
void warn_of_opposed_normals(const CheckedMesh& mesh, const FixedNormals& averaged, Diagnostics& warnings) {
    constexpr double cos_of_opposed = -0.8;    // 143°: caps reach 140°
    constexpr double least_share = 1.0 / 3.0;  // of the fixed vertices
    Indices opposed;
    for (int v : mesh.fixed) {
        if (mesh.normals(v).dot(averaged(v)) < cos_of_opposed) opposed.push_back(v);
    }
    if (static_cast<double>(opposed.size()) <= least_share * static_cast<double>(mesh.fixed.size())) return;
    warnings.push_back(
        about(Code::normals_oppose_winding,
              counted(opposed.size(), "prescribed normal points against the winding of its triangles: turn it round",
                      "prescribed normals point against the winding of their triangles: turn them round") +
                  ", or flip the triangles",
              opposed, ElementKind::vertex, "vertices"));
}

// Whether it has far more area than a flat one, by numbers neither too large nor too small for their squares.
bool is_surely_broad(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    const double square = longest * longest;
    return std::isnormal(square) && (b - a).cross(c - a).squaredNorm() > 1e-22 * square;
}

void warn_of_flat_triangles(const MeshInput& input, const CutMesh& mesh, Diagnostics& warnings) {
    Indices offenders;
    for (int t : mesh.input_triangle) {
        const Vector3 a = input.vertices.col(input.triangles(0, t));
        const Vector3 b = input.vertices.col(input.triangles(1, t));
        const Vector3 c = input.vertices.col(input.triangles(2, t));
        if (is_surely_broad(a, b, c)) continue;
        const double longest = std::max({(b - a).stableNorm(), (c - b).stableNorm(), (a - c).stableNorm()});
        const Vector3 cross = Vector3((b - a) / longest).cross(Vector3((c - a) / longest));
        if (!(cross.norm() > 1e-12)) offenders.push_back(t);
    }
    if (offenders.empty()) return;
    std::sort(offenders.begin(), offenders.end());
    warnings.push_back(about(Code::degenerate_face,
                             counted(offenders.size(), "triangle given has no area", "triangles given have no area"),
                             offenders, ElementKind::triangle, "without_area"));
}

// H of all vertices, NaN where nothing is prescribed.
VectorX curvatures_of(const MeshInput& input) {
    if (!input.fixed_curvatures) return {};
    VectorX curvatures = VectorX::Constant(input.vertices.cols(), std::numeric_limits<double>::quiet_NaN());
    curvatures(*input.fixed) = *input.fixed_curvatures;
    return curvatures;
}

}  // namespace

MeshTopology check_topology(const MeshInput& input) {
    check_indices(input);
    MeshTopology mesh;
    Diagnostics& warnings = mesh.topology_warnings;
    Indices kept;
    const GivenRoles given{marks_of(input, input.fixed.value_or(Indices{}), "fixed"),
                           marks_of(input, input.held.creases, "creases"),
                           marks_of(input, input.held.smooth_curves, "smooth_curves"), input.held.fair_border};
    Triangles triangles = drop_collapsed_triangles(input.triangles, kept, warnings);
    triangles = drop_unbounded_triangles(input, triangles, given.fixed, kept, warnings);
    sort_triangles(triangles, kept, static_cast<int>(input.vertices.cols()));
    const EdgeTable edges = make_edges(triangles, static_cast<int>(input.vertices.cols()));
    mesh.roles = classify_vertices(edges, given);
    check_slopes(given, mesh.roles);
    check_finite(input, mesh.roles);
    mesh.fixed = all_fixed(input, mesh.roles, warnings);
    mesh.cut = cut_mesh(triangles, edges, kept, mesh.roles, warnings);
    return mesh;
}

void check_geometry(const MeshInput& input, CheckedMesh& mesh) {
    mesh.warnings.clear();
    warn_of_flat_triangles(input, mesh.cut, mesh.warnings);
    mesh.normals = {mesh.roles.fixed, averaged_triangle_normals(input.vertices, mesh.cut, mesh.roles)};
    if (input.fixed_normals) {
        const FixedNormals averaged = mesh.normals;
        copy_given_normals(input, mesh);
        warn_of_opposed_normals(mesh, averaged, mesh.warnings);
    }
    warn_of_normals(input, mesh);
    mesh.curvatures = curvatures_of(input);
}

CheckedMesh check_mesh(const MeshInput& input) {
    CheckedMesh mesh{check_topology(input), {}, {}, {}};
    check_geometry(input, mesh);
    return mesh;
}

}  // namespace fairing
