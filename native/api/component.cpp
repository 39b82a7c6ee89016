#include "api/component.h"

#include <map>

#include <Eigen/Geometry>

#include "mesh/union_find.h"

namespace fairing {

namespace {

// Input vertex → local vertex. A vertex on a cut has several copies at the same place, any of which will do.
class LocalNumbers {
public:
    explicit LocalNumbers(const Patch& patch)
        : local_((*std::max_element(patch.to_input.begin(), patch.to_input.end())) + 1, none) {
        for (int v = 0; v < patch.vertex_count(); ++v) local_[patch.to_input[v]] = v;
    }
    [[nodiscard]] int operator()(int input) const {
        return static_cast<std::size_t>(input) < local_.size() ? local_[input] : none;
    }

private:
    Indices local_;
};

// The caller's edges within one patch, in local numbers. Throws std::invalid_argument, naming `what`, where a free
// vertex is tied to no fixed one: its place would be undetermined.
InnerWeights local_weights(const Patch& patch, const InnerWeights& edges, const char* what) {
    const LocalNumbers find(patch);
    InnerWeights result;
    UnionFind tied(patch.vertex_count());
    for (int v = patch.free_count; v < patch.vertex_count(); ++v) tied.join(v, patch.free_count);
    for (const auto& [a, b, weight] : edges) {
        const int i = find(a);
        const int j = find(b);
        if (i == none || j == none || i == j || !(weight > 0.0)) continue;
        result.push_back({i, j, weight});
        tied.join(i, j);
    }
    for (int v = 0; v < patch.free_count; ++v) {
        if (tied.root(v) == tied.root(patch.free_count)) continue;
        throw std::invalid_argument(std::string(what) + ": no chain of positive weights leads from free vertex " +
                                    std::to_string(patch.to_input[v]) + " to a fixed one");
    }
    return result;
}

// λ = 1/|q_i − q_j| on the reference (3 × local vertices, units of D).
void weigh_by_distance(InnerWeights& weights, const Points& reference) {
    constexpr double shortest = 1e-12;  // so that edges without length have a weight
    for (auto& [i, j, weight] : weights) {
        weight = 1.0 / std::max((reference.col(i) - reference.col(j)).norm(), shortest);
    }
}

// Columns of the fixed points, one for each input vertex. An edge along a slit, with the component on both sides, has
// two copies on the border.
Indices boundary_vertices(const Patch& patch) {
    std::map<std::array<int, 2>, int> copies;
    const auto in_input = [&](int e) {
        const auto [a, b] = patch.edge_ends[e];
        return std::array{std::min(patch.to_input[a], patch.to_input[b]),
                          std::max(patch.to_input[a], patch.to_input[b])};
    };
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[e][1] == none) ++copies[in_input(e)];
    }
    std::map<int, int> column_of;  // by input vertex
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[e][1] != none || copies[in_input(e)] != 1) continue;
        for (int v : patch.edge_ends[e]) column_of.emplace(patch.to_input[v], v - patch.free_count);
    }
    Indices columns;
    for (const auto& [vertex, column] : column_of) columns.push_back(column);
    return columns;
}

}  // namespace

Points gather(const Eigen::Ref<const Points>& points, std::span<const int> vertices) {
    Points result(3, static_cast<Eigen::Index>(vertices.size()));
    for (std::size_t k = 0; k < vertices.size(); ++k)
        result.col(static_cast<Eigen::Index>(k)) = points.col(vertices[k]);
    return result;
}

Normalisation normalise(const Points& fixed_points) {
    const Vector3 centre = fixed_points.rowwise().mean();
    double farthest = 0.0;  // squares of coordinates may be out of range
    for (const auto point : fixed_points.colwise()) farthest = std::max(farthest, (point - centre).stableNorm());
    return {centre, 2.0 * farthest};
}

double boundary_radius(const Patch& patch, const Points& fixed_points) {
    const Indices boundary = boundary_vertices(patch);
    const Points points = boundary.empty() ? fixed_points : fixed_points(Eigen::all, boundary);
    const Vector3 centre = points.rowwise().mean();
    return std::sqrt((points.colwise() - centre).colwise().squaredNorm().mean());
}

std::span<const int> free_vertices(const Patch& patch) { return std::span(patch.to_input).first(patch.free_count); }

std::span<const int> fixed_vertices(const Patch& patch) { return std::span(patch.to_input).subspan(patch.free_count); }

Lambda make_lambda(const Patch& patch, const Points& reference, InnerFairness kind, const FairOptions& options) {
    if (kind == InnerFairness::custom) return local_weights(patch, options.custom, "inner_fairness");
    if (kind == InnerFairness::conformal) return conformal_weights(patch, reference);
    if (kind == InnerFairness::uniform && !options.neighbours) return {};
    InnerWeights weights = options.neighbours ? local_weights(patch, uniform_weights(*options.neighbours), "neighbours")
                                              : uniform_weights(patch);
    if (kind == InnerFairness::inverse_distance) weigh_by_distance(weights, reference);
    return weights;
}

}  // namespace fairing
