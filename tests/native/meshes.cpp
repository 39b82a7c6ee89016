#include "meshes.h"
#include "mesh/pieces.h"

namespace fairing::test {

namespace {

// A fixed sequence in (−1, 1), the same on every platform.
double noise(int k) {
    const double s = std::sin(12.9898 * k + 4.1414) * 43758.5453;
    return 2.0 * (s - std::floor(s)) - 1.0;
}

}  // namespace

Mesh grid(int n, double jitter, const std::function<Vector3(double, double)>& surface, bool alternate) {
    Mesh mesh;
    mesh.points.resize(3, (n + 1) * (n + 1));
    mesh.triangles.resize(3, 2 * n * n);
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            const bool inner = i > 0 && i < n && j > 0 && j < n;
            const int v = i * (n + 1) + j;
            const double u = (j + (inner ? jitter * noise(2 * v) : 0.0)) / n;
            const double w = (i + (inner ? jitter * noise(2 * v + 1) : 0.0)) / n;
            mesh.points.col(v) = surface(u, w);
        }
    }
    int t = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j;
            const int b = a + 1;
            const int c = a + n + 2;
            const int d = a + n + 1;
            if (!alternate || (i + j) % 2 == 0) {
                mesh.triangles.col(t++) << a, b, c;
                mesh.triangles.col(t++) << a, c, d;
            } else {
                mesh.triangles.col(t++) << a, b, d;
                mesh.triangles.col(t++) << b, c, d;
            }
        }
    }
    return mesh;
}

Vector3 flat(double u, double v) { return {u, v, 0.0}; }

Vector3 sphere(double u, double v) {
    const double x = u - 0.5;
    const double y = v - 0.5;
    return Vector3(x, y, 1.0).normalized();
}

Single single_patch(const Mesh& mesh, std::vector<char> given) {
    Single single;
    Diagnostics warnings;
    Indices kept;
    const Triangles triangles = drop_collapsed_triangles(mesh.triangles, kept, warnings);
    const auto count = static_cast<int>(mesh.points.cols());
    given.resize(static_cast<std::size_t>(count), 0);
    const EdgeTable edges = make_edges(triangles, count);
    single.roles = classify_vertices(edges, {given, {}, {}});
    single.cut = cut_mesh(triangles, edges, kept, single.roles, warnings);
    single.patches = make_patches(single.cut, single.roles);
    const Patch& patch = single.patch();
    single.points.resize(3, patch.vertex_count());
    for (int v = 0; v < patch.vertex_count(); ++v) {
        single.points.col(v) = mesh.points.col(patch.to_input[static_cast<std::size_t>(v)]);
    }
    return single;
}

void push_beyond_boundary(const Patch& patch, int count, Points& points) {
    std::vector<char> taken(static_cast<std::size_t>(patch.vertex_count()), 0);
    for (const auto corners : patch.triangles.colwise()) {
        const int first = corners.minCoeff();
        const bool beside = std::count_if(corners.begin(), corners.end(), [&](int v) { return patch.is_free(v); }) == 1;
        if (count == 0 || !beside || taken[static_cast<std::size_t>(first)]) continue;
        Vector3 middle = -0.5 * points.col(first);
        for (const int v : corners) middle += 0.5 * points.col(v);
        points.col(first) += 1.5 * (middle - points.col(first));
        for (const int w : patch.ring(first).vertices) {
            for (const int u : patch.ring(w).vertices) taken[static_cast<std::size_t>(u)] = 1;
        }
        --count;
    }
}

Stiffness stiffness_of(const Single& single) {
    FaceGeometry faces;
    faces.update(single.points, single.patch().triangles);
    Stiffness stiffness;
    stiffness.update(faces, single.patch());
    return stiffness;
}

Eigen::MatrixXd dense(const Patch& patch, const Stiffness& stiffness) {
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(patch.vertex_count(), patch.vertex_count());
    return stiffness.apply(patch, identity, patch.vertex_count()).transpose();
}

}  // namespace fairing::test
