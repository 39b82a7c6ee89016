#include "api/diagnose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "base/text.h"
#include "geometry/face_geometry.h"
#include "geometry/self_intersection.h"
#include "geometry/vertex_normal.h"

namespace fairing {

namespace {

double degrees_between(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

bool touches_free(const Patch& patch, int vertex) {
    const auto ring = patch.ring(vertex).vertices;
    return std::any_of(ring.begin(), ring.end(), [&](int v) { return patch.is_free(v); });
}

void warn_of_flips(const Patch& patch, const Points& points, Diagnostics& warnings) {
    Indices flipped = flipped_triangles(patch, points);
    if (flipped.empty()) return;
    warnings.push_back(
        {Code::flipped_triangles,
         counted(flipped.size(), "triangle of the result is turned over", "triangles of the result are turned over"),
         std::move(flipped), ElementKind::triangle});
}

void warn_of_sharp_outline(const Patch& patch, const Points& prescribed, Diagnostics& warnings) {
    constexpr double widest_turn = 20.0;
    Indices sharp;
    double widest = 0.0;
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[at(e)][1] != none) continue;
        const auto [a, b] = patch.edge_ends[at(e)];
        const double turn = degrees_between(prescribed.col(a - patch.free_count), prescribed.col(b - patch.free_count));
        widest = std::max(widest, turn);
        if (turn > widest_turn) sharp.insert(sharp.end(), {patch.to_input[at(a)], patch.to_input[at(b)]});
    }
    if (sharp.empty()) return;
    warnings.push_back({Code::sharp_boundary,
                        "the normals along the outline turn by up to " + std::to_string(std::lround(widest)) +
                            "° from one vertex to the next; a finer outline gives a more accurate surface",
                        std::move(sharp)});
}

void warn_of_crossings(const Patch& patch, const Points& points, Diagnostics& warnings) {
    Indices crossing = crossing_triangles(patch.triangles, points);
    if (crossing.empty()) return;
    for (int& t : crossing) t = patch.input_triangle[at(t)];
    warnings.push_back({Code::self_intersection,
                        counted(crossing.size(), "triangle of the result passes through others of the patch",
                                "triangles of the result pass through others of the patch"),
                        std::move(crossing), ElementKind::triangle});
}

}  // namespace

VectorX boundary_angles(const Patch& patch, const Points& actual, const Points& prescribed) {
    VectorX angles = VectorX::Zero(prescribed.cols());
    for (int k = 0; k < prescribed.cols(); ++k) {
        const int v = patch.free_count + k;
        if (patch.pin[at(v)] || !touches_free(patch, v)) continue;
        angles[k] = degrees_between(prescribed.col(k), actual.col(k));
    }
    return angles;
}

Indices flipped_triangles(const Patch& patch, const Points& points) {
    FaceGeometry faces;
    faces.update(points, patch.triangles);
    const Points no_normals = Points::Zero(3, patch.vertex_count() - patch.free_count);
    const Points normals = max_normals(patch, points, no_normals);
    Indices flipped;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        Vector3 around = Vector3::Zero();
        for (int v : patch.triangles.col(t)) around += normals.col(v);
        if (around.dot(faces.normals.col(t)) < 0.0) flipped.push_back(patch.input_triangle[at(t)]);
    }
    return flipped;
}

bool is_usable_reference(const Patch& patch, const Points& reference, Diagnostics& warnings) {
    constexpr double needle = 0.02;  // a right triangle of 90 : 1
    constexpr double tolerated_share = 0.1;
    Indices bad = flipped_triangles(patch, reference);
    std::vector<char> has_area(at(patch.vertex_count()), 0);
    for (int t = 0; t < patch.triangle_count(); ++t) {
        const auto corners = patch.triangles.col(t);
        const double shape =
            triangle_shape(reference.col(corners[0]), reference.col(corners[1]), reference.col(corners[2]));
        if (!(shape >= needle)) bad.push_back(patch.input_triangle[at(t)]);
        for (int v : corners) has_area[at(v)] = has_area[at(v)] || shape > 0.0;
    }
    // A vertex whose whole neighbourhood is a point or a line hangs on nothing.
    const bool collapsed =
        std::find(has_area.begin(), has_area.begin() + patch.free_count, 0) != has_area.begin() + patch.free_count;
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    if (!collapsed && static_cast<double>(bad.size()) <= tolerated_share * patch.triangle_count()) return true;
    warnings.push_back({Code::reference_unusable,
                        counted(bad.size(), "triangle of the reference mesh is a needle or turned over",
                                "triangles of the reference mesh are needles or turned over") +
                            ", so that no distribution of vertices can be read off it; uniform inner fairness was used",
                        std::move(bad), ElementKind::triangle});
    return false;
}

void warn_of_precision(const Patch& patch, const Points& input, const Precision& wanted, Diagnostics& warnings) {
    constexpr double tolerated_share = 1e-3;  // of the mean border edge
    double length = 0.0;
    int count = 0;
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[at(e)][1] != none) continue;
        const auto [a, b] = patch.edge_ends[at(e)];
        length += (input.col(patch.to_input[at(a)]) - input.col(patch.to_input[at(b)])).stableNorm();
        ++count;
    }
    double farthest = 0.0;
    for (int v : patch.to_input) farthest = std::max(farthest, input.col(v).cwiseAbs().maxCoeff());
    const double spacing = farthest * std::numeric_limits<double>::epsilon();
    const double edge = count > 0 ? length / count : wanted.diameter;
    if (spacing <= std::min(tolerated_share * edge, wanted.tolerance * wanted.diameter)) return;
    warnings.push_back({Code::precision,
                        "this far from the origin, coordinates can't be told apart as finely as the tolerance and the "
                        "edges ask for: move the mesh nearer to the origin",
                        {}});
}

std::optional<std::string> why_unusable(const Patch& patch, const Points& points, const VectorX& angles) {
    constexpr double least_area = 1e-9;  // D²
    constexpr double behind = 90.0;      // degrees
    FaceGeometry faces;
    faces.update(points, patch.triangles);
    if (!(faces.areas.sum() > least_area)) return "fell together to a point or a line: fix more vertices around it";
    const auto told = (angles.array() > 0.0).count();
    const auto turned = (angles.array() > behind).count();
    if (2 * turned <= told) return std::nullopt;
    return "runs into its outline from behind at " + std::to_string(turned) + " of " + std::to_string(told) +
           " vertices, which is not the surface asked for: where little of a shape is left outside, leave more of it";
}

void diagnose(const Patch& patch, const Points& points, const Points& prescribed, Diagnostics& warnings) {
    warn_of_flips(patch, points, warnings);
    warn_of_crossings(patch, points, warnings);
    warn_of_sharp_outline(patch, prescribed, warnings);
}

}  // namespace fairing
