// Directed inner-fairness weights λ_ij, Σ_j λ_ij = 1 (paper §7.3).
#pragma once

#include <variant>

#include "fairness/inner_weights.h"
#include "geometry/vertex_normal.h"

namespace fairing {

// One row for each free vertex of a patch. Non-negative: every target Σ λ_ij q_j is a convex combination.
struct RowWeights {
    Indices begin{0};
    Indices columns;  // local vertices
    std::vector<double> values;

    [[nodiscard]] std::span<const int> columns_of(int row) const;
    [[nodiscard]] std::span<const double> values_of(int row) const;
    // Σ_j λ_ij q_j.
    [[nodiscard]] Vector3 mean(int row, const Points& points) const;
};

// λ_ij of symmetric weights. Throws std::invalid_argument, naming `what`, where a row has no positive weight.
RowWeights row_weights(const Patch& patch, const InnerWeights& weights, const char* what);

// λ = 1 on the edges of the patch, listed only on demand: they would take too much memory on a large patch.
struct UniformWeights {};

// λ of a patch: symmetric where the kind allows it, else by rows.
using Lambda = std::variant<InnerWeights, RowWeights, UniformWeights>;

// use(edges) of symmetric λ.
template <typename Use>
auto with_edges(const Patch& patch, const Lambda& symmetric, const Use& use) {
    if (std::holds_alternative<UniformWeights>(symmetric)) return use(uniform_weights(patch));
    return use(std::get<InnerWeights>(symmetric));
}

// Whether all edges have the same weight.
bool is_uniform(const Lambda& weights);

// A directed weight; rows are normalised.
struct DirectedWeight {
    int i;
    int j;
    double weight;
};
// `weights`: local vertices; those of fixed i are left out. Throws as above, and where a chain of positive weights
// leads from a free vertex to no fixed one: its place would be undetermined.
RowWeights row_weights(const Patch& patch, const std::vector<DirectedWeight>& weights, const char* what);

// Floater 1997, "Parametrization and smooth approximation of surface triangulations", on the positions of M0 (3 × local
// vertices). Each ring is laid out in the plane with its lengths kept and its angles scaled to sum to 2π. Every point,
// with the edge of the ring opposite to it, gives barycentric coordinates of the centre. These are averaged. Exact on
// planar rings: Σ λ_j q_j = q_i.
RowWeights shape_preserving_weights(const Patch& patch, const Points& reference);

// λ_ij + λ_ji over the edges (rows of fixed vertices count as zero): close to the rows where these are nearly
// symmetric.
InnerWeights symmetrised(const RowWeights& rows);

}  // namespace fairing
