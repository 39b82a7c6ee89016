#include "multigrid/transfer.h"

#include <algorithm>

#include "base/parallel.h"

namespace fairing {

namespace {

// bring_back(k) for each removal, pass by pass from the last on.
template <typename BringBack>
void in_reverse(const Removals& removals, const BringBack& bring_back) {
    for (std::size_t pass = removals.pass_begin.size(); --pass > 0;) {
        const int first = removals.pass_begin[pass - 1];
        for_ranges(removals.pass_begin[pass] - first, coarse_grain, [&](int begin, int end) {
            for (int k = first + begin; k < first + end; ++k) bring_back(k);
        });
    }
}

}  // namespace

void Transfer::prolong(const SingleField& coarse, SingleField& fine) const {
    fine.setZero();  // a coarse level may lack some of the fixed vertices
    for (int c = 0; c < coarse_count(); ++c) fine.col(coarse_in_fine[at(c)]) = coarse.col(c);
    in_reverse(removals, [&](int k) {
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        for (int j = removals.begin[at(k)]; j < removals.begin[at(k) + 1]; ++j)
            sum += removals.weights[at(j)] * fine.col(removals.neighbours[at(j)]);
        fine.col(removals.vertex[at(k)]) = sum;
    });
}

void Transfer::restrict(SingleField& fine, SingleField& coarse) const {
    for (int k = 0; k < removals.size(); ++k) {
        const Eigen::Vector4f value = fine.col(removals.vertex[at(k)]);
        for (int j = removals.begin[at(k)]; j < removals.begin[at(k) + 1]; ++j)
            fine.col(removals.neighbours[at(j)]) += removals.weights[at(j)] * value;
    }
    for (int c = 0; c < coarse_free_count; ++c) coarse.col(c) = fine.col(coarse_in_fine[at(c)]);
    coarse.rightCols(coarse.cols() - coarse_free_count).setZero();
}

void Transfer::prolong_means(const Points& coarse, int fine_free_count, Points& fine) const {
    for (std::size_t c = 0; c < coarse_in_fine.size(); ++c) {
        if (coarse_in_fine[c] < fine_free_count) fine.col(coarse_in_fine[c]) = coarse.col(static_cast<Eigen::Index>(c));
    }
    in_reverse(removals, [&](int k) {
        Vector3 sum = Vector3::Zero();
        for (int j = removals.begin[at(k)]; j < removals.begin[at(k) + 1]; ++j)
            sum += double{removals.weights[at(j)]} * fine.col(removals.neighbours[at(j)]);
        fine.col(removals.vertex[at(k)]) = sum;
    });
}

LiftedMean lifted_mean(const Points& points, const Points& normals, const int* vertices, const float* weights,
                       int count) {
    constexpr double least_cosine = 0.9;  // rings that bend more tell noise, or too little
    Vector3 mean = Vector3::Zero();
    Vector3 normal = Vector3::Zero();
    double sum = 0.0;
    for (int k = 0; k < count; ++k) {
        mean += double{weights[k]} * points.col(vertices[k]);
        normal += double{weights[k]} * normals.col(vertices[k]);
        sum += weights[k];
    }
    mean /= sum;
    Vector3 lift = Vector3::Zero();
    for (int k = 0; k < count; ++k) {
        const auto n = normals.col(vertices[k]);
        lift += double{weights[k]} * n.dot(points.col(vertices[k]) - mean) * n;
    }
    const double c = std::max(normal.norm() / sum, least_cosine);
    return {mean + 1.0 / (c * (1.0 + c) * sum) * lift, normal.normalized()};
}

void Transfer::prolong_surface(const Points& coarse, const Points& coarse_normals, int fine_free_count, Points& fine,
                               Points& fine_normals) const {
    for (std::size_t c = 0; c < coarse_in_fine.size(); ++c) {
        const int v = coarse_in_fine[c];
        if (v >= fine_free_count) continue;
        fine.col(v) = coarse.col(static_cast<Eigen::Index>(c));
        fine_normals.col(v) = coarse_normals.col(static_cast<Eigen::Index>(c));
    }
    in_reverse(removals, [&](int k) {
        const int first = removals.begin[at(k)];
        const int count = removals.begin[at(k) + 1] - first;
        const int v = removals.vertex[at(k)];
        const LiftedMean lifted =
            lifted_mean(fine, fine_normals, &removals.neighbours[at(first)], &removals.weights[at(first)], count);
        fine.col(v) = lifted.point;
        fine_normals.col(v) = lifted.normal;
    });
}

}  // namespace fairing
