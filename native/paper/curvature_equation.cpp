#include "paper/curvature_equation.h"

#include <algorithm>

namespace fairing {

void CurvatureEquation::assemble(const Stiffness& stiffness) {
    stiffness_ = &stiffness;
    diagonal_.resize(patch_.free_count);
    for (int i = 0; i < patch_.free_count; ++i) {
        double sum = 0.0;
        for (int edge : patch_.ring(i).spokes) sum += stiffness.weights[edge];
        diagonal_[i] = sum;
    }
    // Positive unless a whole 1-disk has collapsed.
    diagonal_ = diagonal_.cwiseMax(1e-9);
}

double CurvatureEquation::neighbour_sum(int i, const VectorX& f) const {
    const RingView ring = patch_.ring(i);
    double sum = 0.0;
    for (std::size_t k = 0; k < ring.valence(); ++k) sum += stiffness_->weights[ring.spokes[k]] * f[ring.vertices[k]];
    return sum;
}

void CurvatureEquation::sweep(const VectorX& rhs, int sweeps, VectorX& H) const {
    for (int s = 0; s < sweeps; ++s) {
        for (int i = 0; i < patch_.free_count; ++i) H[i] = (rhs[i] + neighbour_sum(i, H)) / diagonal_[i];
    }
}

VectorX CurvatureEquation::defect(const VectorX& rhs, const VectorX& H) const {
    VectorX result(patch_.free_count);
    for (int i = 0; i < patch_.free_count; ++i) result[i] = rhs[i] + neighbour_sum(i, H) - diagonal_[i] * H[i];
    return result;
}

void CurvatureEquation::multiply(const VectorX& p, VectorX& Sp) const {
    for (int i = 0; i < patch_.free_count; ++i) Sp[i] = diagonal_[i] * p[i] - neighbour_sum(i, p);
}

void CurvatureEquation::conjugate_gradients(const VectorX& rhs, int steps, VectorX& H) {
    const int n = patch_.free_count;
    VectorX r = defect(rhs, H);
    VectorX z = r.cwiseQuotient(diagonal_);
    VectorX p = VectorX::Zero(patch_.vertex_count());  // stays zero at the fixed vertices
    p.head(n) = z;
    VectorX Sp(n);
    double rz = r.dot(z);
    const double negligible = 1e-24 * rz;
    for (int k = 0; k < steps && rz > negligible; ++k) {
        multiply(p, Sp);
        const double curvature = p.head(n).dot(Sp);
        if (!(curvature > 0.0)) return;
        const double alpha = rz / curvature;
        H.head(n) += alpha * p.head(n);
        r -= alpha * Sp;
        z = r.cwiseQuotient(diagonal_);
        const double next = r.dot(z);
        p.head(n) = z + (next / rz) * p.head(n);
        rz = next;
    }
}

}  // namespace fairing
