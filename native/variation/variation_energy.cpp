#include "variation/variation_energy.h"

#include <cmath>

namespace fairing {

namespace {

double normal_weight(const Problem& problem, Eigen::Index fixed) {
    if (problem.patch.pin[at(problem.patch.free_count) + static_cast<std::size_t>(fixed)]) return 0.0;
    return problem.normal_weights.size() == 0 ? HUGE_VAL : problem.normal_weights[fixed];
}

Freedom freedom_of(const Problem& problem, Moving moving) {
    const Patch& patch = problem.patch;
    Freedom freedom{std::vector<char>(at(patch.vertex_count()), 0), std::vector<char>(at(patch.vertex_count()), 1)};
    for (int v = 0; v < patch.free_count; ++v) freedom.rises[at(v)] = moving == Moving::points_and_normals;
    for (Eigen::Index k = 0; k < problem.fixed_points.cols(); ++k)
        freedom.turns[at(patch.free_count) + static_cast<std::size_t>(k)] = std::isfinite(normal_weight(problem, k));
    return freedom;
}

}  // namespace

VariationEnergy::VariationEnergy(const Problem& problem, Moving moving)
    : problem_(problem), stencils_(stencils(problem.patch)), unknowns_(freedom_of(problem, moving), stencils_) {
    blocks_.reserve(stencils_.size());
    for (const Stencil& stencil : stencils_) {
        Blocks blocks{};
        for (std::size_t p = 0; p < stencil_size; ++p) {
            for (std::size_t q = 0; q < stencil_size; ++q) {
                if (stencil[p] == none || stencil[q] == none) continue;
                blocks[stencil_size * p + q] = unknowns_.block_of(stencil[p], stencil[q]);
            }
        }
        blocks_.push_back(blocks);
    }
}

double VariationEnergy::value(const Sheet& sheet) const {
    const double elements =
        sum_over_ranges(static_cast<int>(stencils_.size()), fine_grain, [&](int begin, int end) {
            double sum = 0.0;
            for (int k = begin; k < end; ++k) sum += element_energy(sheet, stencils_[at(k)]);
            return sum;
        });
    return elements + outline_energy(sheet);
}

void VariationEnergy::update(const Sheet& sheet, QuadraticModel& model) const {
    if (model.hessian.nonZeros() == 0) model.hessian = unknowns_.pattern();
    std::fill_n(model.hessian.valuePtr(), model.hessian.nonZeros(), 0.0);
    model.stretching = VectorX::Zero(model.hessian.nonZeros());
    model.gradient = VectorX::Zero(unknowns_.count());
    model.energy = 0.0;
    add_elements(sheet, model);
    add_outline(sheet, model);
}

// Elements are measured on all threads, some thousand at once, and added up in their order.
void VariationEnergy::add_elements(const Sheet& sheet, QuadraticModel& model) const {
    constexpr int at_once = 2048;
    const int count = static_cast<int>(stencils_.size());
    std::vector<ElementTerms> terms(at(std::min(at_once, count)));
    for (int first = 0; first < count; first += at_once) {
        const int some = std::min(at_once, count - first);
        for_ranges(some, fine_grain, [&](int begin, int end) {
            for (int k = begin; k < end; ++k) terms[at(k)] = element_terms(sheet, stencils_[at(first + k)]);
        });
        for (int k = 0; k < some; ++k) add(terms[at(k)], first + k, model);
    }
}

void VariationEnergy::add(const ElementTerms& terms, int element, QuadraticModel& model) const {
    const Stencil& stencil = stencils_[at(element)];
    model.energy += terms.energy;
    std::array<int, 3 * stencil_size> unknown{};
    for (int k = 0; k < 3 * stencil_size; ++k) {
        const int vertex = stencil[at(k / 3)];
        unknown[at(k)] = vertex == none ? none : unknowns_.of(vertex, k % 3);
        if (unknown[at(k)] != none) model.gradient[unknown[at(k)]] += terms.gradient[k];
    }
    double* values = model.hessian.valuePtr();
    for (int c = 0; c < 3 * stencil_size; ++c) {
        const int column = unknown[at(c)];
        if (column == none) continue;
        for (int r = 0; r < 3 * stencil_size; ++r) {
            const int row = unknown[at(r)];
            if (row < column) continue;
            const int block = blocks_[at(element)][at(stencil_size * (r / 3) + c / 3)];
            const int slot = unknowns_.slot(row, column, block);
            values[slot] += terms.bending(r, c);
            model.stretching[slot] += terms.hessian(r, c);
        }
    }
}

double VariationEnergy::outline_energy(const Sheet& sheet) const {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < problem_.fixed_points.cols(); ++k) {
        const double weight = normal_weight(problem_, k);
        if (weight == 0.0 || !std::isfinite(weight)) continue;
        sum += weight * (sheet.normals.col(problem_.patch.free_count + k) - problem_.fixed_normals.col(k)).squaredNorm();
    }
    return sum;
}

// |n − n̂|² = 2 − 2 ⟨n, n̂⟩ with n turned by (a, b).
void VariationEnergy::add_outline(const Sheet& sheet, QuadraticModel& model) const {
    model.energy += outline_energy(sheet);
    for (Eigen::Index k = 0; k < problem_.fixed_points.cols(); ++k) {
        const double weight = normal_weight(problem_, k);
        if (weight == 0.0 || !std::isfinite(weight)) continue;
        const int v = problem_.patch.free_count + static_cast<int>(k);
        const Vector3 wanted = problem_.fixed_normals.col(k);
        const Vector3 normal = sheet.normals.col(v);
        const Frame frame(normal);
        const std::array<double, 2> slope{frame.u.dot(wanted), frame.v.dot(wanted)};
        for (int m = 0; m < 2; ++m) {
            const int unknown = unknowns_.of(v, m + 1);
            model.gradient[unknown] -= 2.0 * weight * slope[at(m)];
            model.stretching[unknowns_.slot(unknown, unknown, 0)] +=
                2.0 * weight * std::max(normal.dot(wanted), 0.0);
        }
    }
}

Sheet VariationEnergy::moved(const Sheet& sheet, const VectorX& motions, double share) const {
    Sheet result = sheet;
    for (int v = 0; v < patch().vertex_count(); ++v) {
        Motion motion = Motion::Zero();
        for (int k = 0; k < 3; ++k) {
            if (const int unknown = unknowns_.of(v, k); unknown != none) motion[k] = share * motions[unknown];
        }
        if (motion != Motion::Zero()) move(result, v, motion);
    }
    return result;
}

}  // namespace fairing
