// Array types shared by the whole engine.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fairing {

using Vector3 = Eigen::Vector3d;
template <typename Scalar>
using Vector3Of = Eigen::Matrix<Scalar, 3, 1>;
using VectorX = Eigen::VectorXd;

// Points, normals and displacements: column i belongs to vertex i (the memory of a C-ordered (n, 3) array).
using Points = Eigen::Matrix3Xd;
// Triangles: column t holds the three vertex indices of triangle t, counter-clockwise.
using Triangles = Eigen::Matrix3Xi;

using Indices = std::vector<int>;

// "No such element" in index tables (the missing neighbour of a border edge).
inline constexpr int none = -1;

}  // namespace fairing
