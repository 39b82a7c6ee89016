#include "multigrid/transfer.h"

#include <Eigen/LU>

#include "geometry/frame.h"

namespace fairing {

Vector3 lifted_mean(const Points& points, const Points& normals, const int* vertices, const double* weights,
                    int count) {
    Vector3 mean = Vector3::Zero();
    double sum = 0.0;
    for (int k = 0; k < count; ++k) {
        mean += weights[k] * points.col(vertices[k]);
        sum += weights[k];
    }
    mean /= sum;
    Vector3 lift = Vector3::Zero();
    for (int k = 0; k < count; ++k) {
        const auto n = normals.col(vertices[k]);
        lift += weights[k] * n.dot(points.col(vertices[k]) - mean) * n;
    }
    return mean + 0.5 / sum * lift;
}

std::vector<double> Transfer::linear_weights(const Points& points, const Points& normals) const {
    std::vector<double> result = removals.weights;
    std::vector<Eigen::Vector2d> offsets;
    for (int k = 0; k < removals.size(); ++k) {
        const int v = removals.vertex[at(k)];
        const Frame frame(normals.col(v));
        const int first = removals.begin[at(k)];
        const int last = removals.begin[at(k) + 1];
        offsets.clear();
        Eigen::Vector2d mean = Eigen::Vector2d::Zero();
        for (int j = first; j < last; ++j) {
            const Vector3 d = points.col(removals.neighbours[at(j)]) - points.col(v);
            offsets.emplace_back(frame.u.dot(d), frame.v.dot(d));
            mean += result[at(j)] * offsets.back();
        }
        Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
        for (int j = first; j < last; ++j) {
            const Eigen::Vector2d d = offsets[at(j - first)] - mean;
            spread += result[at(j)] * d * d.transpose();
        }
        const double determinant = spread.determinant();
        if (!(determinant > 1e-4 * spread.trace() * spread.trace())) continue;
        const Eigen::Vector2d slope = spread.inverse() * mean;
        for (int j = first; j < last; ++j) result[at(j)] *= 1.0 - slope.dot(offsets[at(j - first)] - mean);
    }
    return result;
}

void Transfer::prolong_surface(const Points& coarse, const Points& coarse_normals, int fine_free_count, Points& fine,
                               Points& fine_normals) const {
    for (std::size_t c = 0; c < coarse_in_fine.size(); ++c) {
        const int v = coarse_in_fine[c];
        if (v >= fine_free_count) continue;
        fine.col(v) = coarse.col(static_cast<Eigen::Index>(c));
        fine_normals.col(v) = coarse_normals.col(static_cast<Eigen::Index>(c));
    }
    for (int k = removals.size(); k-- > 0;) {
        const int first = removals.begin[at(k)];
        const int count = removals.begin[at(k) + 1] - first;
        const int v = removals.vertex[at(k)];
        fine.col(v) =
            lifted_mean(fine, fine_normals, &removals.neighbours[at(first)], &removals.weights[at(first)], count);
        Vector3 normal = Vector3::Zero();
        for (int j = first; j < first + count; ++j)
            normal += removals.weights[at(j)] * fine_normals.col(removals.neighbours[at(j)]);
        fine_normals.col(v) = normal.normalized();
    }
}

}  // namespace fairing
