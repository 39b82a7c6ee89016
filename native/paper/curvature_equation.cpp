#include "paper/curvature_equation.h"

namespace fairing {

CurvatureEquation::CurvatureEquation(const Patch& patch) : free_count_(patch.free_count), begin_{0} {
    for (int i = 0; i < free_count_; ++i) {
        const RingView ring = patch.ring(i);
        columns_.insert(columns_.end(), ring.vertices.begin(), ring.vertices.end());
        edges_.insert(edges_.end(), ring.spokes.begin(), ring.spokes.end());
        begin_.push_back(static_cast<int>(columns_.size()));
    }
    weights_.resize(columns_.size());
}

void CurvatureEquation::assemble(const Stiffness& stiffness) {
    diagonal_.setZero(free_count_);
    for (int i = 0; i < free_count_; ++i) {
        for (int k = begin_[i]; k < begin_[i + 1]; ++k) {
            weights_[k] = stiffness.weights[edges_[k]];
            diagonal_[i] += weights_[k];
        }
    }
    // Positive unless a whole 1-disk has collapsed.
    diagonal_ = diagonal_.cwiseMax(1e-9);
}

double CurvatureEquation::neighbour_sum(int i, const VectorX& f) const {
    double sum = 0.0;
    for (int k = begin_[i]; k < begin_[i + 1]; ++k) sum += weights_[k] * f[columns_[k]];
    return sum;
}

void CurvatureEquation::sweep(const VectorX& rhs, int sweeps, VectorX& H) const {
    for (int s = 0; s < sweeps; ++s) {
        for (int i = 0; i < free_count_; ++i) H[i] = (rhs[i] + neighbour_sum(i, H)) / diagonal_[i];
    }
}

VectorX CurvatureEquation::defect(const VectorX& rhs, const VectorX& H) const {
    VectorX result(free_count_);
    for (int i = 0; i < free_count_; ++i) result[i] = rhs[i] + neighbour_sum(i, H) - diagonal_[i] * H[i];
    return result;
}

void CurvatureEquation::conjugate_gradients(const VectorX& rhs, int steps, VectorX& H) const {
    const int n = free_count_;
    const VectorX inverse = diagonal_.cwiseInverse();
    VectorX r = defect(rhs, H);
    VectorX z = inverse.cwiseProduct(r);
    VectorX p = VectorX::Zero(H.size());  // stays zero at the fixed vertices
    p.head(n) = z;
    VectorX Sp(n);
    double rz = r.dot(z);
    const double enough = 1e-24 * rz;
    for (int k = 0; k < steps && rz > enough; ++k) {
        for (int i = 0; i < n; ++i) Sp[i] = diagonal_[i] * p[i] - neighbour_sum(i, p);
        const double curvature = p.head(n).dot(Sp);
        if (!(curvature > 0.0)) return;
        const double alpha = rz / curvature;
        H.head(n) += alpha * p.head(n);
        r -= alpha * Sp;
        z = inverse.cwiseProduct(r);
        const double next = r.dot(z);
        p.head(n) = z + (next / rz) * p.head(n);
        rz = next;
    }
}

}  // namespace fairing
