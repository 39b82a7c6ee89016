#include "api/diagnose.h"
#include "api/hole_job.h"
#include "api/kept_skin.h"
#include "api/measure.h"
#include "api/remesh.h"
#include "base/columns.h"
#include "base/errors.h"
#include "fill/quads.h"
#include "geometry/self_intersection.h"

namespace fairing {

namespace {

// The corners of a quad, from one at which the shorter diagonal does not end.
std::array<int, 4> turned(const std::array<int, 4>& quad, const Points& points) {
    constexpr double shorter = 1.0 - 1e-6;  // by more than roundoff: equal diagonals keep their order
    const auto& [a, b, c, d] = quad;
    const double one = (points.col(a) - points.col(c)).norm();
    const double other = (points.col(b) - points.col(d)).norm();
    return one < shorter * other ? std::array{b, c, d, a} : quad;
}

// Triangles of the patch that hang on no free vertex.
std::vector<Eigen::Vector3i> staying(const HolePatch& patch) {
    std::vector<char> is_replaced(static_cast<std::size_t>(patch.triangles.cols()), 0);
    const MeshInput input = patch.input({});
    for (const Patch& each : patches_with_vertices(check_mesh(input))) {
        for (const int t : each.input_triangle) is_replaced[t] = 1;
    }
    std::vector<Eigen::Vector3i> rest;
    for (Eigen::Index t = 0; t < patch.triangles.cols(); ++t) {
        if (!is_replaced[t]) rest.emplace_back(patch.triangles.col(t));
    }
    return rest;
}

}  // namespace

std::optional<Rows> rows_over(const HolePatch& solved, int old_count, const Progress& progress) {
    QuadMesh made;
    try {
        made = quad_mesh(solved.input({}), within(progress));
    } catch (const SolverError&) {
        return std::nullopt;  // the surface can't be flattened
    }
    if (made.pattern.quads.empty()) return std::nullopt;
    Points points(3, old_count + made.vertices.cols());
    points << solved.vertices.leftCols(old_count), made.vertices;
    const int rim = static_cast<int>(made.boundary.size());
    const auto number = [&](int v) { return v < rim ? made.boundary[v] : old_count + v - rim; };
    std::vector<Eigen::Vector3i> halves;
    std::vector<Eigen::Vector3i> others;
    Rows rows;
    const int count = static_cast<int>(made.pattern.quads.size());
    for (int k = 0; k < count; ++k) {
        std::array<int, 4> quad{};
        std::transform(made.pattern.quads[k].begin(), made.pattern.quads[k].end(), quad.begin(), number);
        const auto [a, b, c, d] = turned(quad, points);
        halves.emplace_back(a, b, d);
        others.emplace_back(c, d, b);
        rows.pairs.push_back({k, count + k});
    }
    halves.insert(halves.end(), others.begin(), others.end());
    for (const auto& [a, b, c] : made.pattern.triangles) halves.emplace_back(number(a), number(b), number(c));
    for (const Eigen::Vector3i& triangle : staying(solved)) halves.push_back(triangle);
    rows.patch = {std::move(points), as_columns(halves), solved.fixed, solved.normals};
    rows.triangle = std::move(made.triangle);
    rows.weights = std::move(made.weights);
    return rows;
}

SolvedHole cut_from(const SolvedHole& solved, const HolePatch& patch, const Indices& triangle, const Points& weights) {
    SolvedHole made{patch, solved.report, true};
    VectorX curvature(patch.vertices.cols());
    const Eigen::Index old = patch.vertices.cols() - static_cast<Eigen::Index>(triangle.size());
    curvature.head(old) = solved.report.mean_curvature.head(old);
    for (std::size_t k = 0; k < triangle.size(); ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        const VectorX corners = solved.report.mean_curvature(solved.patch.triangles.col(triangle[k]));
        curvature[old + at] = corners.dot(weights.col(at));
    }
    made.report.mean_curvature = std::move(curvature);
    made.report.polished = false;
    for (Diagnostic& warning : made.report.warnings) {  // about the mesh that was solved, whose new vertices are gone
        if (warning.kind != ElementKind::vertex) continue;
        const auto is_gone = [&](int v) { return v >= old; };
        warning.elements.erase(std::remove_if(warning.elements.begin(), warning.elements.end(), is_gone),
                               warning.elements.end());
    }
    std::erase_if(made.report.warnings, is_fold);
    warn_of_folds(flipped_triangles(patch.input({})), crossing_triangles(patch.triangles, patch.vertices),
                  made.report.warnings);
    return made;
}

Diagnostic no_rows(Indices loop, const char* why, const char* text) {
    const auto edges = static_cast<double>(loop.size());
    std::sort(loop.begin(), loop.end());
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    const std::string message = "no rows of quads over the boundary of " + std::to_string(static_cast<int>(edges)) +
                                " edges, only pairs of triangles: " + text;
    return {Code::no_quad_rows, message, std::move(loop), ElementKind::vertex, {{"edges", edges}, {why, 1.0}}};
}

VertexPairs pairs_among(const SolvedHole& solved, const VertexPairs& kept) {
    return paired_quads(solved.patch.vertices, solved.patch.triangles, kept).pairs;
}

SolvedHole in_rows(SolvedHole solved, int loops, int old_count, const SolveAgain& solve, const Progress& progress) {
    constexpr int fine_enough = 900;  // new vertices on which the equation may be solved
    const auto rows = rows_over(solved.patch, old_count, progress);
    if (!rows) {
        const Indices boundary = solved.patch.fixed;
        solved.report.warnings.push_back(loops > 2
                                             ? no_rows(boundary, "several", "more than two boundary loops are joined")
                                             : no_rows(boundary, "shape", "no pattern fits its corners"));
        return solved;
    }
    if (rows->patch.vertices.cols() - old_count >= fine_enough && solved.report.converged) {
        FairResult again = solve(rows->patch);
        if (again.converged) {
            SolvedHole made{rows->patch, std::move(again)};
            made.patch.vertices = made.report.vertices;
            made.pairs = rows->pairs;
            return made;
        }
    }
    SolvedHole made = cut_from(solved, rows->patch, rows->triangle, rows->weights);
    made.pairs = rows->pairs;
    return made;
}

}  // namespace fairing
