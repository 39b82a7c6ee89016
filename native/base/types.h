// Array types shared by the whole engine, and those headers of the standard library that nearly every source needs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

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

// Reads as a `Matrix`, whose columns lie one after the other in an array of the caller's or in a matrix that lives
// longer.
template <typename Matrix>
class View : public Eigen::Map<const Matrix> {
public:
    using Map = Eigen::Map<const Matrix>;
    View(const Map& map) : Map(map) {}                                        // NOLINT: as a reference would
    View(const Matrix& kept) : Map(kept.data(), kept.rows(), kept.cols()) {}  // NOLINT
    View(Matrix&&) = delete;
    View(const View&) = default;
    ~View() = default;
    // Refers to the same matrix as the other one.
    View& operator=(const View& other) {
        new (static_cast<Map*>(this)) Map(other);
        return *this;
    }
};

}  // namespace fairing
