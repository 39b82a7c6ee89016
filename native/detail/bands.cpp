#include "detail/bands.h"

#include <cmath>
#include <numbers>

#include "geometry/face_geometry.h"

namespace fairing {

namespace {

using Entry = Eigen::Triplet<double>;

VectorX masses(const FaceGeometry& faces, const Triangles& triangles, Eigen::Index count) {
    VectorX mass = VectorX::Zero(count);
    for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) {
        for (int v : triangles.col(t)) mass[v] += faces.areas[t] / 3.0;
    }
    return (mass.array() > 0.0).select(mass, 1.0);
}

void add_edge(int i, int j, double weight, std::vector<Entry>& entries) {
    entries.emplace_back(i, i, weight);
    entries.emplace_back(j, j, weight);
    entries.emplace_back(i, j, -weight);
    entries.emplace_back(j, i, -weight);
}

// 1/(1 + t k²)² = ½ at k = 2π/wavelength.
double filter_of(double wavelength) {
    return (std::numbers::sqrt2 - 1.0) * std::pow(wavelength / (2.0 * std::numbers::pi), 2);
}

}  // namespace

SparseMatrix screened_laplacian(const Points& points, const Triangles& triangles, double t) {
    FaceGeometry faces;
    faces.update(points, triangles);
    const VectorX mass = masses(faces, triangles, points.cols());
    std::vector<Entry> entries;
    entries.reserve(static_cast<std::size_t>(mass.size() + 12 * triangles.cols()));
    for (int v = 0; v < static_cast<int>(mass.size()); ++v) entries.emplace_back(v, v, mass[v]);
    for (int f = 0; f < static_cast<int>(triangles.cols()); ++f) {
        for (int k = 0; k < 3; ++k) {
            const double weight = 0.5 * t * faces.cotangents(k, f);
            add_edge(triangles((k + 1) % 3, f), triangles((k + 2) % 3, f), weight, entries);
        }
    }
    SparseMatrix matrix(points.cols(), points.cols());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

std::optional<Bands> Bands::of(const Points& points, const Triangles& triangles, const std::vector<double>& wavelengths,
                               const Progress& progress) {
    FaceGeometry faces;
    faces.update(points, triangles);
    Bands bands;
    bands.mass_ = masses(faces, triangles, points.cols());
    const SparseMatrix unit = screened_laplacian(points, triangles, 1.0).triangularView<Eigen::Lower>();
    SparseCholesky low(points);
    for (const double wavelength : wavelengths) {
        const double t = filter_of(wavelength);
        SparseMatrix matrix = t * unit;
        for (int v = 0; v < static_cast<int>(points.cols()); ++v) matrix.coeffRef(v, v) += (1.0 - t) * bands.mass_[v];
        if (!low.factorise(matrix, "detail", progress)) return std::nullopt;
        bands.low_.push_back(low);
    }
    return bands;
}

Eigen::MatrixXd Bands::split(const VectorX& field) const {
    Eigen::MatrixXd result(field.size(), static_cast<Eigen::Index>(low_.size()) + 1);
    VectorX left = field;
    for (std::size_t k = 0; k < low_.size(); ++k) {
        VectorX longer = left;
        for (int pass = 0; pass < 2; ++pass) longer = low_[k].solve(mass_.asDiagonal() * longer);
        result.col(static_cast<Eigen::Index>(k)) = left - longer;
        left = longer;
    }
    result.rightCols(1) = left;
    return result;
}

}  // namespace fairing
