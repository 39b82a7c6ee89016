#include "variation/variation_energy.h"

namespace fairing {

namespace {

// With a misfit of 10 three irregular meshes of elbows differ 2.7 times as much. The rough energy of starts is content
// with little, and its normals lean.
ElementWeights element_weights(Measure measure) {
    constexpr double misfit = 3.0;  // see above
    if (measure == Measure::plain) return {0.04, 1.0};
    return {misfit, 3.0 * misfit / (3.0 * misfit - 2.0)};
}

double normal_weight(const Problem& problem, Eigen::Index fixed) {
    if (problem.patch.pin[problem.patch.free_count + static_cast<std::size_t>(fixed)]) return 0.0;
    return problem.normal_weights.size() == 0 ? HUGE_VAL : problem.normal_weights[fixed];
}

Freedom freedom_of(const Problem& problem, Moving moving) {
    const Patch& patch = problem.patch;
    Freedom freedom{std::vector<char>(patch.vertex_count(), 0), std::vector<char>(patch.vertex_count(), 1)};
    for (int v = 0; v < patch.free_count; ++v) freedom.rises[v] = moving == Moving::points_and_normals;
    for (Eigen::Index k = 0; k < problem.fixed_points.cols(); ++k) {
        freedom.rises[patch.free_count + static_cast<std::size_t>(k)] = moving == Moving::points_and_normals &&
                                                                        !problem.free_edge.empty() &&
                                                                        problem.free_edge[static_cast<std::size_t>(k)];
        freedom.turns[patch.free_count + static_cast<std::size_t>(k)] = std::isfinite(normal_weight(problem, k));
    }
    return freedom;
}

}  // namespace

VariationEnergy::VariationEnergy(const Problem& problem, Moving moving, Measure measure)
    : problem_(problem),
      measure_(measure),
      stencils_(stencils(problem.patch)),
      unknowns_(freedom_of(problem, moving), stencils_) {
    for (int e = 0; e < static_cast<int>(stencils_.size()); ++e) {
        entries_begin_.push_back(entries_.size());
        find_entries(e);
    }
    entries_begin_.push_back(entries_.size());
}

// Looked up once: each step adds to all of them.
void VariationEnergy::find_entries(int element) {
    const Stencil& stencil = stencils_[element];
    const ElementUnknowns unknown = unknowns_of(element);
    for (int c = 0; c < 3 * stencil_size; ++c) {
        for (int r = 0; r < 3 * stencil_size; ++r) {
            const int row = unknown[r];
            const int column = unknown[c];
            if (column == none || row < column) continue;
            const int block = unknowns_.block_of(stencil[r / 3], stencil[c / 3]);
            entries_.push_back({unknowns_.slot(row, column, block), 3 * stencil_size * c + r});
        }
    }
}

VariationEnergy::ElementUnknowns VariationEnergy::unknowns_of(int element) const {
    ElementUnknowns unknown{};
    for (int k = 0; k < 3 * stencil_size; ++k) {
        const int vertex = stencils_[element][k / 3];
        unknown[k] = vertex == none ? none : unknowns_.of(vertex, k % 3);
    }
    return unknown;
}

ElementSums VariationEnergy::sums(const Sheet& sheet) const {
    std::vector<ElementSums> parts(stencils_.size());
    for_ranges(static_cast<int>(stencils_.size()), fine_grain, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) parts[k] = element_sums(sheet, stencils_[k], element_weights(measure_));
    });
    ElementSums total;
    for (const ElementSums& part : parts) {
        total.variation += part.variation;
        total.area += part.area;
    }
    return total;
}

SheetMerit VariationEnergy::measured(const Sheet& sheet) const {
    const ElementSums present = sums(sheet);
    const double factor = measure_ == Measure::plain ? 1.0 : present.area;
    return {present, factor * present.variation + boundary_energy(sheet)};
}

// d(V A) = A dV + V dA
ElementSums VariationEnergy::factors(const SheetMerit& present) const {
    if (measure_ == Measure::plain) return {1.0, 0.0};
    return {present.sums.area, present.sums.variation};
}

void VariationEnergy::update(const Sheet& sheet, const SheetMerit& present, QuadraticModel& model) const {
    if (model.bending.nonZeros() == 0) model.bending = unknowns_.pattern();
    std::fill_n(model.bending.valuePtr(), model.bending.nonZeros(), 0.0);
    model.stretching = VectorX::Zero(model.bending.nonZeros());
    model.gradient = VectorX::Zero(unknowns_.count());
    model.area = VectorX::Zero(unknowns_.count());
    model.merit = present.merit;
    // d²(V A) = A d²V + V d²A + dV dA + dA dV, where dV ≈ −(V / A) dA near the minimum.
    const bool plain = measure_ == Measure::plain;
    model.area_factor = plain ? 0.0 : 2.0 * present.sums.variation / present.sums.area;
    add_elements(sheet, factors(present), model);
    add_boundary(sheet, model);
}

VectorX VariationEnergy::gradient(const Sheet& sheet, const SheetMerit& present) const {
    const int count = static_cast<int>(stencils_.size());
    std::vector<ElementVector> slopes(stencils_.size());
    for_ranges(count, fine_grain, [&](int begin, int end) {
        for (int e = begin; e < end; ++e)
            slopes[e] = element_gradient(sheet, stencils_[e], element_weights(measure_), factors(present));
    });
    VectorX result = VectorX::Zero(unknowns_.count());
    add_up(slopes, 1.0, result);
    for_boundary(sheet, [&](int unknown, double slope, double) { result[unknown] += slope; });
    return result;
}

// Elements are measured on all threads, some thousand at once, and added up in their order.
void VariationEnergy::add_elements(const Sheet& sheet, const ElementSums& factors, QuadraticModel& model) const {
    constexpr int at_once = 2048;  // elements: their terms fit into the cache
    const int count = static_cast<int>(stencils_.size());
    std::vector<ElementTerms> terms(std::min(at_once, count));
    for (int first = 0; first < count; first += at_once) {
        const int some = std::min(at_once, count - first);
        for_ranges(some, fine_grain, [&](int begin, int end) {
            for (int k = begin; k < end; ++k)
                terms[k] = element_terms(sheet, stencils_[first + k], element_weights(measure_), factors);
        });
        for (int k = 0; k < some; ++k) add(terms[k], first + k, model);
    }
}

void VariationEnergy::add(const ElementTerms& terms, int element, QuadraticModel& model) const {
    const ElementUnknowns unknown = unknowns_of(element);
    for (int k = 0; k < 3 * stencil_size; ++k) {
        if (unknown[k] == none) continue;
        model.gradient[unknown[k]] += terms.gradient[k];
        model.area[unknown[k]] += terms.area_gradient[k];
    }
    double* bending = model.bending.valuePtr();
    double* stretching = model.stretching.data();
    for (std::size_t k = entries_begin_[element]; k < entries_begin_[element + 1]; ++k) {
        const auto [slot, place] = entries_[k];
        bending[slot] += terms.bending.data()[place];
        stretching[slot] += terms.stretching.data()[place];
    }
}

double VariationEnergy::boundary_energy(const Sheet& sheet) const {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < problem_.fixed_points.cols(); ++k) {
        const double weight = normal_weight(problem_, k);
        if (weight == 0.0 || !std::isfinite(weight)) continue;
        sum +=
            weight * (sheet.normals.col(problem_.patch.free_count + k) - problem_.fixed_normals.col(k)).squaredNorm();
    }
    return sum;
}

// |n − n̂|² = 2 − 2 ⟨n, n̂⟩ with n turned by (a, b).
template <typename Visit>
void VariationEnergy::for_boundary(const Sheet& sheet, const Visit& visit) const {
    for (Eigen::Index k = 0; k < problem_.fixed_points.cols(); ++k) {
        const double weight = normal_weight(problem_, k);
        if (weight == 0.0 || !std::isfinite(weight)) continue;
        const int v = problem_.patch.free_count + static_cast<int>(k);
        const Vector3 wanted = problem_.fixed_normals.col(k);
        const Vector3 normal = sheet.normals.col(v);
        const Frame frame(normal);
        const std::array<double, 2> slope{frame.u.dot(wanted), frame.v.dot(wanted)};
        for (int m = 0; m < 2; ++m)
            visit(unknowns_.of(v, m + 1), -2.0 * weight * slope[m], 2.0 * weight * std::max(normal.dot(wanted), 0.0));
    }
}

void VariationEnergy::add_boundary(const Sheet& sheet, QuadraticModel& model) const {
    for_boundary(sheet, [&](int unknown, double slope, double bend) {
        model.gradient[unknown] += slope;
        model.stretching[unknowns_.slot(unknown, unknown, 0)] += bend;
    });
}

void VariationEnergy::add_up(const std::vector<ElementVector>& parts, double factor, VectorX& result) const {
    for (int e = 0; e < static_cast<int>(parts.size()); ++e) {
        const ElementUnknowns unknown = unknowns_of(e);
        for (int k = 0; k < 3 * stencil_size; ++k) {
            if (unknown[k] != none) result[unknown[k]] += factor * parts[e][k];
        }
    }
}

VectorX VariationEnergy::acceleration_load(const Sheet& sheet, const SheetMerit& present, const VectorX& motions,
                                           double share) const {
    const Sheet there = moved(sheet, motions, share);
    const int count = static_cast<int>(stencils_.size());
    std::vector<ElementVector> loads(stencils_.size());
    for_ranges(count, fine_grain, [&](int begin, int end) {
        for (int e = begin; e < end; ++e) {
            const ElementUnknowns unknown = unknowns_of(e);
            ElementVector own = ElementVector::Zero();
            for (int k = 0; k < 3 * stencil_size; ++k) {
                if (unknown[k] != none) own[k] = motions[unknown[k]];
            }
            loads[e] = element_acceleration(sheet, there, stencils_[e], element_weights(measure_), own, share);
        }
    });
    VectorX result = VectorX::Zero(unknowns_.count());
    add_up(loads, factors(present).variation, result);
    return result;
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
