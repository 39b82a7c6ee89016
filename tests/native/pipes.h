// Round pipes between two boundaries.
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "geometry/face_geometry.h"
#include "meshes.h"
#include "problem/problem.h"

namespace fairing::test {

inline constexpr int around = 48;

// A round pipe along z of equilateral triangles.
inline Mesh pipe(int rows) {
    const double height = std::numbers::sqrt3 * std::numbers::pi / around;
    Mesh mesh{Points(3, around * (rows + 1)), Triangles(3, 2 * around * rows)};
    for (int r = 0; r <= rows; ++r) {
        for (int c = 0; c < around; ++c) {
            const double angle = 2.0 * std::numbers::pi * (c + 0.5 * r) / around;
            mesh.points.col(r * around + c) << std::cos(angle), std::sin(angle), height * r;
        }
    }
    Eigen::Index t = 0;
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < around; ++c) {
            const int a = r * around + c;
            const int b = r * around + (c + 1) % around;
            mesh.triangles.col(t++) << a, b, a + around;
            mesh.triangles.col(t++) << b, b + around, a + around;
        }
    }
    return mesh;
}

// Its ends lean outwards by `lean`, like trumpets.
struct Pipe {
    Single single;
    Problem problem;

    explicit Pipe(int rows, double lean = 0.0) : Pipe(pipe(rows), lean) {}
    Pipe(const Mesh& mesh, double lean)
        : single(single_patch(mesh)), problem{single.patch(), {}, {}, uniform_weights(single.patch()), {}} {
        const Eigen::Index fixed = single.points.cols() - single.patch().free_count;
        problem.fixed_points = single.points.rightCols(fixed);
        problem.fixed_normals = problem.fixed_points;
        const double middle = 0.5 * problem.fixed_points.row(2).maxCoeff();
        for (auto normal : problem.fixed_normals.colwise()) {
            const double side = normal[2] < middle ? 1.0 : -1.0;
            normal *= std::cos(lean);
            normal[2] = side * std::sin(lean);
        }
    }
    [[nodiscard]] Points with(const Points& free) const {
        Points points = single.points;
        points.leftCols(free.cols()) = free;
        return points;
    }
    [[nodiscard]] double area(const Points& points) const {
        FaceGeometry faces;
        faces.update(points, single.patch().triangles);
        return faces.areas.sum();
    }
};

}  // namespace fairing::test
