// How much the normal curvatures of a sheet vary, and how far its normals are from the boundary's.
#pragma once

#include "linear/tree_solve.h"
#include "problem/problem.h"
#include "variation/element.h"
#include "variation/unknowns.h"

namespace fairing {

// The unknowns: the free vertices and all normals that are not given exactly, or the normals alone.
enum class Moving { points_and_normals, normals };

// With V = ∫ ⟨(dκ/ds)²⟩ dA and A the area: V A, which no scaling changes; or V alone, in units of D⁻², which is lower
// on larger surfaces and easier to descend from far away: there V A would shrink the area of a rough initial surface.
enum class Measure { scale_free, plain };

// Sums over one sheet.
struct SheetMerit {
    ElementSums sums;
    double merit = 0.0;
};

// A merit near a sheet, by the unknown motions of its vertices.
struct QuadraticModel {
    double merit = 0.0;
    VectorX gradient;
    SparseMatrix bending;  // second derivatives, lower triangle: bending + stretching − area_factor · area areaᵀ
    VectorX stretching;    // positive semidefinite; values on the same pattern
    VectorX area;          // gradient of the area
    double area_factor = 0.0;
};

// Merit: V A (or V) + Σ_boundary w_i |n_i − n̂_i|².
class VariationEnergy {
public:
    // `problem` must outlive this.
    VariationEnergy(const Problem& problem, Moving moving, Measure measure);

    [[nodiscard]] SheetMerit measured(const Sheet& sheet) const;
    // `present`: of the same sheet, here and below. Into a model of the same energy, or an empty one.
    void update(const Sheet& sheet, const SheetMerit& present, QuadraticModel& model) const;
    // By the unknown motions.
    [[nodiscard]] VectorX gradient(const Sheet& sheet, const SheetMerit& present) const;
    // By how much the residuals leave their tangent along motions (element.h), measured over a share of these. The
    // geodesic acceleration compensates it (Transtrum & Sethna 2012).
    [[nodiscard]] VectorX acceleration_load(const Sheet& sheet, const SheetMerit& present, const VectorX& motions,
                                            double share) const;
    // The sheet with its vertices moved by `share` of the motions (unknowns in their order).
    [[nodiscard]] Sheet moved(const Sheet& sheet, const VectorX& motions, double share) const;

    [[nodiscard]] const Unknowns& unknowns() const { return unknowns_; }
    [[nodiscard]] const Patch& patch() const { return problem_.patch; }

private:
    struct Entry {
        int slot;   // among the matrix's values
        int place;  // among an ElementMatrix's
    };
    using ElementUnknowns = std::array<int, 3UL * stencil_size>;  // `none` where a motion is not sought

    void find_entries(int element);
    [[nodiscard]] ElementUnknowns unknowns_of(int element) const;
    [[nodiscard]] ElementSums sums(const Sheet& sheet) const;
    void add_elements(const Sheet& sheet, const ElementSums& factors, QuadraticModel& model) const;
    void add(const ElementTerms& terms, int element, QuadraticModel& model) const;
    [[nodiscard]] ElementSums factors(const SheetMerit& present) const;
    // Sum over all elements, `factor` times.
    void add_up(const std::vector<ElementVector>& parts, double factor, VectorX& result) const;
    // visit(unknown, derivative, second derivative) of the boundary's normals.
    template <typename Visit>
    void for_boundary(const Sheet& sheet, const Visit& visit) const;
    void add_boundary(const Sheet& sheet, QuadraticModel& model) const;
    [[nodiscard]] double boundary_energy(const Sheet& sheet) const;

    const Problem& problem_;
    Measure measure_;
    std::vector<Stencil> stencils_;
    Unknowns unknowns_;
    std::vector<Entry> entries_;              // of the matrix's lower triangle, element by element
    std::vector<std::size_t> entries_begin_;  // of each element; one more at the end
};

}  // namespace fairing
