// What passes between Python and the drivers: row-major arrays, one point or triangle a row.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Indices = Eigen::VectorXi;
using SparseMatrix = Eigen::SparseMatrix<double>;
