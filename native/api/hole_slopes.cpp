#include <cstdio>

#include "api/hole_job.h"
#include "base/columns.h"
#include "boundary/boundary_fit.h"
#include "geometry/triangle.h"
#include "shape/limits.h"

namespace fairing {

VectorX trusted_curvatures(const SurroundingNormals& fits) {
    constexpr double usual = 4.0;   // times the median of the errors
    constexpr double small = 0.25;  // of the largest curvature
    std::vector<double> errors;
    double largest = 0.0;
    for (Eigen::Index k = 0; k < fits.curvatures.size(); ++k) {
        if (!fits.fitted[k]) continue;
        errors.push_back(fits.curvature_errors[k]);
        largest = std::max(largest, std::abs(fits.curvatures[k]));
    }
    if (errors.empty()) return fits.curvatures;
    std::sort(errors.begin(), errors.end());
    const std::size_t half = errors.size() / 2;
    const double middle = errors.size() % 2 ? errors[half] : 0.5 * (errors[half - 1] + errors[half]);
    const double limit = std::max(usual * middle, small * largest);
    VectorX result = fits.curvatures;
    for (Eigen::Index k = 0; k < result.size(); ++k) {
        if (!(fits.curvature_errors[k] <= limit)) result[k] = std::numeric_limits<double>::quiet_NaN();
    }
    return result;
}

namespace {

Vector3 averaged_normal_at(int vertex, const HoledMesh& mesh) {
    Vector3 sum = Vector3::Zero();
    for (const int t : mesh.stars().at(vertex)) {
        const auto corners = mesh.mesh().triangles.col(t);
        const Vector3 area = area_vector(mesh.mesh().vertices, corners);
        if (area.allFinite()) sum += area;
    }
    return direction(sum);
}

// Whether the other side of a wall is nearer than that.
bool faces_another(int vertex, const HoledMesh& mesh, double reach) {
    constexpr double opposite = -0.5;  // cosine between the normals of two sides of a wall
    const View<Points>& points = mesh.mesh().vertices;
    const Vector3 normal = averaged_normal_at(vertex, mesh);
    for (Eigen::Index v = 0; v < points.cols(); ++v) {
        if (!((points.col(v) - points.col(vertex)).squaredNorm() < reach * reach)) continue;
        if (averaged_normal_at(static_cast<int>(v), mesh).dot(normal) < opposite) return true;
    }
    return false;
}

std::string whole(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.0f", value);
    return text.data();
}

Diagnostic leaves(const Indices& vertices, double degrees, const char* figure, const std::string& what,
                  const std::string& advice) {
    const double count = size_of(vertices);
    const std::string text = "the surface " + what + " by up to " + whole(degrees) + "° at " + whole(count) +
                             " vertices of the boundary; " + advice;
    return {Code::not_tangent,
            text,
            vertices,
            ElementKind::vertex,
            {{"vertices", count}, {"degrees", degrees}, {figure, 1.0}}};
}

// How long the longer edge at a vertex of the boundary is.
double reach_at(int vertex, const std::vector<Indices>& loops, const Points& points) {
    double reach = 0.0;
    for (const Indices& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int next = loop[(k + 1) % loop.size()];
            if (loop[k] == vertex || next == vertex)
                reach = std::max(reach, (points.col(next) - points.col(loop[k])).norm());
        }
    }
    return reach;
}

}  // namespace

VectorX curvatures_around(const HolePatch& patch, const Triangles& around) {
    if (around.cols() == 0)
        throw std::invalid_argument(
            "continuity: 'G2' needs the curvature at the boundary: pass fixed_curvatures, or "
            "the triangles outside");
    const BoundaryNormals fits =
        boundary_normals({patch.vertices, patch.triangles, around}, patch.fixed, {}, SideRule::automatic);
    const VectorX own = trusted_curvatures(fits.normals);
    if (!patch.normals) return own;
    const SurroundingNormals beyond = surrounding_normals(patch.vertices, around, patch.fixed);
    const VectorX others = trusted_curvatures(beyond);
    VectorX result = own;
    for (Eigen::Index k = 0; k < result.size(); ++k) {
        const Vector3 given = patch.normals->col(k);
        Vector3 normal = fits.normals.normals.col(k);
        const bool is_nearer = std::abs(beyond.normals.col(k).dot(given)) > std::abs(normal.dot(given));
        if (is_nearer && fits.from_inside[k]) {  // somebody prefers the slope outside
            result[k] = others[k];
            normal = beyond.normals.col(k);
        }
        if (normal.dot(given) < 0.0) result[k] = -result[k];  // H on the side of the normals
    }
    return result;
}

Diagnostics not_tangent(const FairResult& report, const std::vector<Indices>& loops, const LocalMesh& around,
                        const HoledMesh& mesh) {
    const bool is_reported = is_loft(report.provenance) || report.provenance == Provenance::old_shape ||
                             report.provenance == Provenance::first_surface;  // by NO_SOLUTION, with their kinks
    if (!report.converged || is_reported) return {};
    Indices back;
    Indices off;
    double worst_back = 0.0;
    double worst_off = 0.0;
    for (std::size_t k = 0; k < report.fixed.size(); ++k) {
        const int v = report.fixed[k];
        const auto at = static_cast<Eigen::Index>(k);
        if (report.join[at] > turned_back) {
            back.push_back(v);
            worst_back = std::max(worst_back, report.join[at]);
        } else if (report.boundary_angle[at] > off_slope && v < static_cast<int>(around.to_mesh.size()) &&
                   faces_another(around.to_mesh[v], mesh, reach_at(v, loops, around.points))) {
            off.push_back(v);
            worst_off = std::max(worst_off, report.boundary_angle[at]);
        }
    }
    Diagnostics found;
    if (!back.empty())
        found.push_back(leaves(back, worst_back, "folded_back", "turns back",
                               "triangles around are folded over there: unfold them"));
    if (!off.empty())
        found.push_back(leaves(off, worst_off, "coarse", "leaves its surroundings",
                               "the boundary's edges are longer there than the wall is thick: subdivide them"));
    return found;
}

}  // namespace fairing
