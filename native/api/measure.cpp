#include "api/measure.h"

#include <Eigen/Geometry>

#include "api/component.h"
#include "api/diagnose.h"
#include "base/columns.h"
#include "base/errors.h"
#include "fairness/harmonic_values.h"
#include "fairness/inner_weights.h"
#include "geometry/flips.h"
#include "geometry/mean_curvature.h"
#include "geometry/one_ring.h"
#include "geometry/surface_fit.h"
#include "mesh/pieces.h"
#include "multigrid/coarsening.h"

namespace fairing {

namespace {

// Planar coordinates of a triangle: columns b − a and c − a in its own plane.
Eigen::Matrix2d planar_edges(const Points& points, const Eigen::Vector3i& triangle) {
    const Vector3 ab = points.col(triangle[1]) - points.col(triangle[0]);
    const Vector3 ac = points.col(triangle[2]) - points.col(triangle[0]);
    const double length = ab.norm();
    Eigen::Matrix2d edges;
    edges << length, ab.dot(ac) / length, 0.0, ab.cross(ac).norm() / length;
    return edges;
}

// Fixed vertices whose normals nobody prescribed get the fit to their own side.
Points normals_at_fixed(const Patch& patch, const Points& local, const FixedNormals& normals,
                        NormalsAtBoundary boundary) {
    return boundary == NormalsAtBoundary::prescribed ? normals.gather(fixed_vertices(patch))
                                                     : one_sided_normals(patch, local);
}

// Exponent of two: doubles end at 1023.
constexpr int largest_exponent = 1000;

// The power of two by which lengths up to this one become about 1 without losing bits: their squares are numbers then.
double scale_to_one(double length) {
    int exponent = 0;
    std::frexp(length, &exponent);
    return std::ldexp(1.0, -std::clamp(exponent, -largest_exponent, largest_exponent));
}

// H of input vertices, the mean of their sides.
class CurvatureMeans {
public:
    CurvatureMeans(const FixedNormals& normals, Eigen::Index vertex_count)
        : normals_(normals), sum_(VectorX::Zero(vertex_count)), sides_(VectorX::Zero(vertex_count)) {}

    void add(const Patch& patch, Points local, NormalKind kind, NormalsAtBoundary boundary) {
        const double scale = scale_to_one((local.rowwise().maxCoeff() - local.rowwise().minCoeff()).maxCoeff());
        local *= scale;
        FaceGeometry faces(local, patch.triangles);
        const Points at_fixed = normals_at_fixed(patch, local, normals_, boundary);
        const Points normals = vertex_normals(patch, local, faces, at_fixed, kind);
        const VectorX H = patch_curvature(patch, local, std::move(faces), normals, kind).mean;
        for (int v = 0; v < patch.vertex_count(); ++v) {
            sum_[patch.to_input[v]] += scale * H[v];
            sides_[patch.to_input[v]] += 1.0;
        }
    }

    [[nodiscard]] VectorX all() const { return sum_.cwiseQuotient(sides_.cwiseMax(1.0)); }

private:
    const FixedNormals& normals_;
    VectorX sum_;
    VectorX sides_;
};

// Each triangle is scaled by a power of two, so that squares of its lengths are numbers: its angles stay the same.
Eigen::Matrix3Xd cotangents(const Points& points, const Triangles& triangles) {
    Points corners(3, triangles.size());
    Triangles own(3, triangles.cols());
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const Eigen::Matrix3d given = points(Eigen::all, triangles.col(t));
        corners.middleCols<3>(3 * t) = given * scale_to_one(given.cwiseAbs().maxCoeff());
        const int first = static_cast<int>(3 * t);
        own.col(t) << first, first + 1, first + 2;
    }
    FaceGeometry faces(corners, own);
    return faces.cotangents;
}

// Rows of `values` (one for each vertex of the mesh) at these vertices.
Eigen::MatrixXd rows_at(const Eigen::MatrixXd& values, std::span<const int> vertices) {
    Eigen::MatrixXd result(static_cast<Eigen::Index>(vertices.size()), values.cols());
    for (std::size_t k = 0; k < vertices.size(); ++k)
        result.row(static_cast<Eigen::Index>(k)) = values.row(vertices[k]);
    return result;
}

}  // namespace

VectorX mean_curvature(const CheckedMesh& mesh, const View<Points>& points, NormalKind kind,
                       NormalsAtBoundary boundary) {
    CurvatureMeans means(mesh.normals, points.cols());
    for_each_piece(mesh.cut, mesh.roles, points,
                   [&](const Patch& patch, Points local) { means.add(patch, std::move(local), kind, boundary); });
    return means.all();
}

VectorX mean_curvature(std::span<const Patch> pieces, const FixedNormals& normals, const View<Points>& points,
                       NormalKind kind, NormalsAtBoundary boundary) {
    CurvatureMeans means(normals, points.cols());
    for (const Patch& patch : pieces) means.add(patch, gather(points, patch.to_input), kind, boundary);
    return means.all();
}

Indices component_of_triangles(const Triangles& triangles, const std::optional<Indices>& fixed, int vertex_count) {
    const Points anywhere = Points::Zero(3, vertex_count);
    const MeshTopology mesh = check_topology({anywhere, triangles, fixed, {}});
    const Pieces pieces(mesh.cut, mesh.roles);
    Indices number(pieces.size(), none);
    int count = 0;
    for (int k = 0; k < pieces.size(); ++k) {
        if (pieces.has_free_vertex(k)) number[k] = count++;
    }
    Indices result(static_cast<int>(triangles.cols()), none);
    for (std::size_t t = 0; t < mesh.cut.piece.size(); ++t) {
        result[mesh.cut.input_triangle[t]] = number[mesh.cut.piece[t]];
    }
    return result;
}

std::vector<Triangles> mesh_levels(const MeshInput& input, int most) {
    const CheckedMesh mesh = check_mesh(input);
    std::vector<std::vector<Triangles>> pieces;
    std::size_t depth = 1;
    for_each_piece(mesh.cut, mesh.roles, input.vertices, [&](const Patch& patch, const Points&) {
        const auto numbered = [&](const Triangles& of) {
            return of.unaryExpr([&](int v) { return patch.to_input[v]; });
        };
        std::vector<Triangles>& levels = pieces.emplace_back();
        levels.emplace_back(numbered(patch.triangles));
        for (const CoarseLevel& level : coarsen(patch, uniform_weights(patch))) {
            const Indices& in_patch = level.patch.to_input;
            levels.emplace_back(numbered(level.patch.triangles.unaryExpr([&](int v) { return in_patch[v]; })));
        }
        depth = std::max(depth, levels.size());
    });
    std::vector<Triangles> result(most > 0 ? std::min(depth, static_cast<std::size_t>(most)) : depth, Triangles(3, 0));
    for (std::size_t k = 0; k < result.size(); ++k) {
        for (const std::vector<Triangles>& levels : pieces) {
            const Triangles& own = levels[std::min(k, levels.size() - 1)];
            result[k].conservativeResize(3, result[k].cols() + own.cols());
            result[k].rightCols(own.cols()) = own;
        }
    }
    return result;
}

VectorX mean_curvature(const MeshInput& input, NormalKind kind) {
    const auto boundary = input.fixed_normals ? NormalsAtBoundary::prescribed : NormalsAtBoundary::one_sided;
    return mean_curvature(check_mesh(input), input.vertices, kind, boundary);
}

Points vertex_normals(const MeshInput& input, NormalKind kind) {
    const CheckedMesh mesh = check_mesh(input);
    Points sum = Points::Zero(3, input.vertices.cols());
    for_each_piece(mesh.cut, mesh.roles, input.vertices, [&](const Patch& patch, const Points& local) {
        FaceGeometry faces(local, patch.triangles);
        const Points boundary = kind == NormalKind::fitted ? one_sided_normals(patch, local)
                                                           : Points(3, patch.vertex_count() - patch.free_count);
        Points normals = vertex_normals(patch, local, faces, boundary, kind);
        for (int v = patch.free_count; v < patch.vertex_count() && kind == NormalKind::averaged; ++v) {
            OneRingBuffer buffer;
            normals.col(v) = averaged_normal(buffer.gather(patch, local, v));
        }
        for (int v = 0; v < patch.vertex_count(); ++v) sum.col(patch.to_input[v]) += normals.col(v);
    });
    for (auto column : sum.colwise()) column = direction(column);
    return sum;
}

MatrixEntries cotan_laplacian(const Points& points, const Triangles& triangles) {
    const Eigen::Matrix3Xd cotangent = cotangents(points, triangles);
    const EdgeTable edges = make_edges(triangles, static_cast<int>(points.cols()));
    VectorX weights = VectorX::Zero(edges.size());
    for (int s = 0; s < 3 * triangles.cols(); ++s) {
        weights[edges.edge_of_side[s]] += cotangent((s + 2) % 3, s / 3);
    }
    VectorX diagonal = VectorX::Zero(points.cols());
    MatrixEntries entries;
    const auto add = [&](int row, int column, double value) {
        entries.rows.push_back(row);
        entries.columns.push_back(column);
        entries.values.push_back(value);
    };
    for (int e = 0; e < edges.size(); ++e) {
        const auto [a, b] = edges.ends[e];
        add(a, b, -weights[e]);
        add(b, a, -weights[e]);
        diagonal[a] += weights[e];
        diagonal[b] += weights[e];
    }
    for (int v = 0; v < points.cols(); ++v) add(v, v, diagonal[v]);
    return entries;
}

Indices flipped_triangles(const MeshInput& input) {
    const CheckedMesh mesh = check_mesh(input);
    Indices flipped;
    for_each_piece(mesh.cut, mesh.roles, input.vertices, [&](const Patch& patch, const Points& local) {
        const Indices found = input_numbers(patch, flipped_triangles(patch, local));
        flipped.insert(flipped.end(), found.begin(), found.end());
    });
    std::sort(flipped.begin(), flipped.end());
    return flipped;
}

VectorX conformal_distortion(const Points& reference, const Points& points, const Triangles& triangles) {
    VectorX ratio(triangles.cols());
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const Eigen::Matrix2d J =
            planar_edges(points, triangles.col(t)) * planar_edges(reference, triangles.col(t)).inverse();
        // Singular values from J = conformal + anticonformal part: σ = |f_z| ± |f_z̄|.
        const double conformal = std::hypot(J(0, 0) + J(1, 1), J(1, 0) - J(0, 1));
        const double anticonformal = std::hypot(J(0, 0) - J(1, 1), J(1, 0) + J(0, 1));
        const double smallest = std::abs(conformal - anticonformal);
        const double value = (conformal + anticonformal) / smallest;
        ratio[t] = std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
    }
    return ratio;
}

Eigen::MatrixXd interpolate(const MeshInput& input, const Eigen::MatrixXd& given) {
    const CheckedMesh mesh = check_mesh(input);
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(input.vertices.cols(), given.cols());
    for (Eigen::Index k = 0; k < given.rows(); ++k) values.row((*input.fixed)[static_cast<int>(k)]) = given.row(k);
    for (const Patch& patch : make_patches(mesh.cut, mesh.roles)) {
        const Points points = gather(input.vertices, patch.to_input);
        const auto inside = harmonic_values(patch, points, rows_at(values, fixed_vertices(patch)));
        if (!inside) throw SolverError("the values could not be continued: the mesh has triangles without area");
        for (int v = 0; v < patch.free_count; ++v) values.row(patch.to_input[v]) = inside->row(v);
    }
    return values;
}

}  // namespace fairing
