#include "multigrid/transfer.h"

#include "base/parallel.h"
#include "base/progress.h"

namespace fairing {

namespace {

// bring_back(k) for each removal, pass by pass from the last on.
template <typename BringBack>
void in_reverse(const Removals& removals, int grain, const BringBack& bring_back) {
    for (std::size_t pass = removals.pass_begin.size(); --pass > 0;) {
        const int first = removals.pass_begin[pass - 1];
        for_ranges(removals.pass_begin[pass] - first, grain, [&](int begin, int end) {
            for (int k = first + begin; k < first + end; ++k) bring_back(k);
        });
    }
}

// Null: all are 1.
float weight_of(const float* weights, int k) { return weights != nullptr ? weights[k] : 1.0F; }

// The row of each fine vertex; `none` at fixed ones.
Indices rows_of(const Transfer& transfer) {
    const Removals& removals = transfer.removals;
    Indices row(transfer.fine_count, none);
    for (int k = 0; k < removals.size(); ++k) row[removals.vertex[k]] = k;
    for (int c = 0; c < transfer.coarse_free_count; ++c) row[transfer.coarse_in_fine[c]] = removals.size() + c;
    return row;
}

}  // namespace

void Transfer::prolong(const SingleField& coarse, SingleField& fine) const {
    const int free_count = coarse_free_count + removals.size();
    fine.rightCols(fine_count - free_count).setZero();  // a coarse level may lack some of the fixed vertices
    for_ranges(coarse_count(), coarse_grain, [&](int begin, int end) {
        for (int c = begin; c < end; ++c) fine.col(coarse_in_fine[c]) = coarse.col(c);
    });
    in_reverse(removals, coarse_grain, [&](int k) {
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        for (int j = removals.begin[k]; j < removals.begin[k + 1]; ++j)
            sum += removals.weights[j] * fine.col(removals.neighbours[j]);
        fine.col(removals.vertex[k]) = sum;
    });
}

void Transfer::prolong_means(const Points& coarse, int fine_free_count, Points& fine) const {
    for (std::size_t c = 0; c < coarse_in_fine.size(); ++c) {
        if (coarse_in_fine[c] < fine_free_count) fine.col(coarse_in_fine[c]) = coarse.col(static_cast<Eigen::Index>(c));
    }
    in_reverse(removals, coarse_grain, [&](int k) {
        Vector3 sum = Vector3::Zero();
        for (int j = removals.begin[k]; j < removals.begin[k + 1]; ++j)
            sum += double{removals.weights[j]} * fine.col(removals.neighbours[j]);
        fine.col(removals.vertex[k]) = sum;
    });
}

Eigen::Vector<float, 6> mean_shape(const ShapeOperators& shapes, const int* vertices, const float* weights, int count) {
    Eigen::Vector<float, 6> mean = Eigen::Vector<float, 6>::Zero();
    float sum = 0.0F;
    for (int k = 0; k < count; ++k) {
        const auto shape = shapes.col(vertices[k]);
        if (std::isnan(shape[0])) continue;
        mean += weight_of(weights, k) * shape;
        sum += weight_of(weights, k);
    }
    return mean / sum;
}

LiftedMean lifted_mean(const BentPoints& points, const int* vertices, const float* weights, int count) {
    constexpr double least_cosine = 0.9;  // rings that bend more tell noise, or too little
    Vector3 mean = Vector3::Zero();
    Vector3 normal = Vector3::Zero();
    double sum = 0.0;
    for (int k = 0; k < count; ++k) {
        const int j = vertices[k];
        mean += double{weight_of(weights, k)} * points.points.col(j);
        normal += double{weight_of(weights, k)} * points.normals.col(j);
        sum += weight_of(weights, k);
    }
    mean /= sum;
    const bool bends = std::all_of(vertices, vertices + count, [&](int j) { return points.bends(j); });
    Vector3 lift = Vector3::Zero();
    Vector3 turned = Vector3::Zero();
    for (int k = 0; k < count; ++k) {
        const int j = vertices[k];
        const auto n = points.normals.col(j);
        const Vector3 d = mean - points.points.col(j);
        lift -= double{weight_of(weights, k)} * n.dot(d) * n;
        if (bends) turned += double{weight_of(weights, k)} * turn(points.shapes, j, d.cast<float>()).cast<double>();
    }
    const double c = std::max(normal.norm() / sum, least_cosine);
    return {mean + 1.0 / (c * (1.0 + c) * sum) * lift, (normal + 0.5 * turned).normalized()};
}

void Transfer::prolong_surface(const BentPoints& coarse, int fine_free_count, BentPoints& fine) const {
    if (coarse.shapes.cols() > 0)
        fine.shapes.setConstant(6, fine.points.cols(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t c = 0; c < coarse_in_fine.size(); ++c) {
        const int v = coarse_in_fine[c];
        const auto column = static_cast<Eigen::Index>(c);
        if (coarse.shapes.cols() > 0) fine.shapes.col(v) = coarse.shapes.col(column);
        if (v >= fine_free_count) continue;
        fine.points.col(v) = coarse.points.col(column);
        fine.normals.col(v) = coarse.normals.col(column);
    }
    in_reverse(removals, fine_grain, [&](int k) {
        const int first = removals.begin[k];
        const int count = removals.begin[k + 1] - first;
        const int v = removals.vertex[k];
        const int* around = &removals.neighbours[first];
        const float* weights = &removals.weights[first];
        const LiftedMean lifted = lifted_mean(fine, around, weights, count);
        fine.points.col(v) = lifted.point;
        fine.normals.col(v) = lifted.normal;
        if (fine.shapes.cols() > 0) fine.shapes.col(v) = mean_shape(fine.shapes, around, weights, count);
    });
}

Restriction::Restriction(const Transfer& transfer) : transfer_(transfer) {
    const Removals& removals = transfer.removals;
    const Indices row = rows_of(transfer);
    begin_.assign((removals.size() + transfer.coarse_free_count) + 1, 0);
    for (const int v : removals.neighbours) {
        if (row[v] != none) ++begin_[row[v] + 1];
    }
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
    from_.resize(begin_.back());
    weights_.resize(from_.size());
    Indices cursor(begin_.begin(), begin_.end() - 1);
    for (int k = 0; k < removals.size(); ++k) {
        checkpoint(k);
        for (int j = removals.begin[k]; j < removals.begin[k + 1]; ++j) {
            const int target = row[removals.neighbours[j]];
            if (target == none) continue;
            const std::size_t place = cursor[target]++;
            from_[place] = k;
            weights_[place] = removals.weights[j];
        }
    }
}

Eigen::Vector4f Restriction::arrived(int row, const Eigen::Vector4f& own, const SingleField& sums) const {
    Eigen::Vector4f sum = own;
    for (int j = begin_[row]; j < begin_[row + 1]; ++j) sum += weights_[j] * sums.col(from_[j]);
    return sum;
}

// The shares of a removed vertex are whole once the passes before its own are done.
void Restriction::apply(const SingleField& fine, float scale, SingleField& sums, SingleField& coarse) const {
    const Removals& removals = transfer_.removals;
    for (std::size_t pass = 1; pass < removals.pass_begin.size(); ++pass) {
        const int first = removals.pass_begin[pass - 1];
        for_ranges(removals.pass_begin[pass] - first, coarse_grain, [&](int begin, int end) {
            for (int k = first + begin; k < first + end; ++k)
                sums.col(k) = arrived(k, fine.col(removals.vertex[k]), sums);
        });
    }
    const int count = transfer_.coarse_free_count;
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int c = begin; c < end; ++c) {
            const Eigen::Vector4f own = fine.col(transfer_.coarse_in_fine[c]);
            coarse.col(c) = scale * arrived(removals.size() + c, own, sums);
        }
    });
    coarse.rightCols(coarse.cols() - count).setZero();
}

}  // namespace fairing
