#include "multigrid/transfer.h"

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
