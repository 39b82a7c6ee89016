#include "boundary/surrounding_fit.h"

#include "base/columns.h"
#include "base/progress.h"
#include "boundary/low_passed_boundary.h"
#include "geometry/limits.h"
#include "linear/conjugate_gradients.h"
#include "mesh/twins.h"

namespace fairing {

namespace {

// The first place of each vertex in the list, `none` elsewhere.
Indices first_places(const Indices& vertices, Eigen::Index count) {
    Indices place(static_cast<std::size_t>(count), none);
    for (std::size_t k = vertices.size(); k-- > 0;) place[vertices[k]] = static_cast<int>(k);
    return place;
}

BoundaryEdges border_edges(const Triangles& triangles, const Indices& place) {
    BoundaryEdges sides;
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const int a = place[t[k]];
            const int b = place[t[(k + 1) % 3]];
            if (a != none && b != none && a != b) sides.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::sort(sides.begin(), sides.end());
    BoundaryEdges border;
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last = std::upper_bound(first, sides.end(), *first);
        if (last - first == 1) border.push_back(*first);
        first = last;
    }
    return border;
}

// Mean lengths of the edges at each vertex; an edge inside counts twice.
VectorX edge_lengths(const Points& points, const Triangles& triangles, const Indices& vertices) {
    VectorX sum = VectorX::Zero(points.cols());
    VectorX count = VectorX::Zero(points.cols());
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const double length = (points.col(t[k]) - points.col(t[(k + 1) % 3])).norm();
            for (int v : {t[k], t[(k + 1) % 3]}) {
                sum[v] += length;
                count[v] += 1.0;
            }
        }
    }
    return sum.cwiseQuotient(count.cwiseMax(1.0))(vertices);
}

constexpr double strength = 16.0;   // μ
constexpr double accuracy = 1e-12;  // of the linear solve

struct Pair {
    int i;
    int j;
    Vector3 disagreement;  // of the normals found at both ends with the predicted turn: n̂_i − n̂_j − g_ij
    double weight;         // μ σ_i σ_j/(σ_i σ_j + δ_ij²): μ where both fits predict the same turn
};

Pair make_pair(const SurroundingFit& fit, const VectorX& errors, int i, int j) {
    const SlopeFit& first = *fit.fits[i];
    const SlopeFit& second = *fit.fits[j];
    const Vector3 step = fit.centres.col(j) - fit.centres.col(i);
    const Vector3 turn_by_first = first.normal - first.normal_at(step);
    const Vector3 turn_by_second = second.normal_at(-step) - second.normal;
    const double variance = (turn_by_first - turn_by_second).squaredNorm();
    return {i, j, first.normal - second.normal - 0.5 * (turn_by_first + turn_by_second),
            strength / (1.0 + variance / (errors[i] * errors[j]))};
}

// The equations for m, n_i = n̂_i + σ_i m_i: a symmetric M-matrix with entries of moderate size whatever the σ.
class FilterSystem {
public:
    explicit FilterSystem(const SurroundingFit& fit)
        : errors_(VectorX::Ones(static_cast<Eigen::Index>(fit.fits.size()))), diagonal_(VectorX::Ones(errors_.size())) {
        for (std::size_t k = 0; k < fit.fits.size(); ++k) {
            if (fit.fits[k]) errors_[static_cast<Eigen::Index>(k)] = std::max(fit.fits[k]->error, least_error);
        }
        for (const auto& [i, j] : fit.edges) {
            if (!fit.fits[i] || !fit.fits[j]) continue;
            const Pair pair = make_pair(fit, errors_, i, j);
            pairs_.push_back(pair);
            diagonal_[i] += pair.weight * errors_[i] / errors_[j];
            diagonal_[j] += pair.weight * errors_[j] / errors_[i];
        }
    }

    // σ m, 3 × k.
    [[nodiscard]] Points turns() const {
        const Points m = conjugate_gradients(
                             right_hand_side(), accuracy, most_cycles, [&](const Points& p, Points& q) { apply(p, q); },
                             [&](const Points& r, Points& z) { z = r * diagonal_.cwiseInverse().asDiagonal(); })
                             .x;
        return m * errors_.asDiagonal();
    }

private:
    [[nodiscard]] Points right_hand_side() const {
        Points result = Points::Zero(3, errors_.size());
        for (const Pair& pair : pairs_) {
            result.col(pair.i) -= pair.weight / errors_[pair.j] * pair.disagreement;
            result.col(pair.j) += pair.weight / errors_[pair.i] * pair.disagreement;
        }
        return result;
    }

    void apply(const Points& p, Points& q) const {
        q = p * diagonal_.asDiagonal();
        for (const Pair& pair : pairs_) {
            q.col(pair.i) -= pair.weight * p.col(pair.j);
            q.col(pair.j) -= pair.weight * p.col(pair.i);
        }
    }

    VectorX errors_;
    VectorX diagonal_;
    std::vector<Pair> pairs_;
};

}  // namespace

SurroundingFit blank_fit(const Points& points, const Triangles& triangles, const Indices& vertices, double size) {
    const Indices place = first_places(vertices, points.cols());
    SurroundingFit result{{},
                          {},
                          points(Eigen::all, vertices),
                          Points(3, static_cast<Eigen::Index>(vertices.size())),
                          edge_lengths(points, triangles, vertices),
                          {},
                          border_edges(triangles, place),
                          size};
    for (const int v : vertices) result.first.push_back(place[v]);
    return result;
}

SurroundingFit fit_surroundings(const Points& given, const Triangles& triangles, const Indices& vertices,
                                const VertexPairs& creases) {
    const auto [points, size] = to_unit_size(given, triangles);
    SidedFits fits(points, triangles, vertices, creases);
    SurroundingFit result = blank_fit(points, triangles, vertices, size);
    result.hard = fits.hard();
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        checkpoint();
        result.fits.push_back(fits.at_vertex(vertices[k]));
        result.parted.push_back(fits.is_parted(vertices[k]) ? 1 : 0);
        result.averaged.col(static_cast<Eigen::Index>(k)) = fits.averaged(vertices[k]);
    }
    return result;
}

SurroundingNormals normals_of(const SurroundingFit& fit) {
    const auto count = static_cast<Eigen::Index>(fit.fits.size());
    SurroundingNormals result{filtered_normals(fit), std::vector<char>(fit.fits.size(), 0),
                              VectorX::Constant(count, std::numeric_limits<double>::infinity()),
                              VectorX::Constant(count, std::numeric_limits<double>::quiet_NaN()),
                              VectorX::Constant(count, std::numeric_limits<double>::infinity())};
    for (Eigen::Index k = 0; k < count; ++k) {
        const auto& here = fit.fits[static_cast<int>(k)];
        if (!here) continue;
        result.fitted[static_cast<int>(k)] = 1;
        result.errors[k] = here->error;
        result.curvatures[k] = here->mean_curvature / fit.size;
        result.curvature_errors[k] = here->curvature_error / fit.size;
    }
    return result;
}

SurroundingNormals surrounding_normals(const Points& points, const Triangles& triangles, const Indices& vertices,
                                       const VertexPairs& creases) {
    return normals_of(fit_surroundings(points, triangles, vertices, creases));
}

// Those within so many rings of the vertices.
Triangles triangles_near(const Triangles& triangles, const Indices& vertices, Eigen::Index count) {
    constexpr int rings = Neighbourhood::most_rings + 3;  // fits, and the usual bend around a hard edge
    std::vector<char> reached(static_cast<std::size_t>(count), 0);
    for (int v : vertices) reached[v] = 1;
    std::vector<Eigen::Index> near;
    for (int ring = 0; ring < rings; ++ring) {
        near.clear();
        for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
            const auto corners = triangles.col(t);
            if (reached[corners[0]] || reached[corners[1]] || reached[corners[2]]) near.push_back(t);
        }
        for (const Eigen::Index t : near) {
            for (int v : triangles.col(t)) reached[v] = 1;
        }
    }
    return triangles(Eigen::all, near);
}

SidedFits::SidedFits(const Points& points, const Triangles& triangles, const Indices& at, const VertexPairs& marked,
                     const VertexPairs& elsewhere)
    : points_(points),
      near_(triangles_near(without_collapsed(triangles), at, points.cols())),
      hard_(hard_edges(points_, near_, marked)),
      side_of_(static_cast<std::size_t>(points.cols()), none),
      is_parted_(side_of_.size(), 0),
      whole_(std::make_unique<SurfaceFits>(points_, near_, Centre::free)) {
    if (hard_.empty()) return;
    BrokenSurface broken = broken_along(near_, static_cast<int>(points_.cols()), hard_);
    choose_sides(broken.triangles, broken.input_vertex, at, elsewhere);
    broken_ = std::move(broken.triangles);
    copies_ = points_(Eigen::all, broken.input_vertex);
    one_side_ = std::make_unique<SurfaceFits>(copies_, broken_, Centre::free);
}

void SidedFits::choose_sides(const Triangles& broken, const Indices& input_vertex, const Indices& at,
                             const VertexPairs& elsewhere) {
    constexpr int several = none - 1;  // beside `none`: more than one side
    const auto add = [&](int copy, Indices& sides) {
        int& side = sides[input_vertex[copy]];
        side = side == none || side == copy ? copy : several;
    };
    std::vector<char> asked(side_of_.size(), 0);
    for (int v : at) asked[v] = 1;
    Indices at_border(side_of_.size(), none);
    const EdgeTable edges = make_edges(near_, static_cast<int>(points_.cols()));
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) != 1 || !asked[edges.ends[e][0]] || !asked[edges.ends[e][1]]) continue;
        if (std::binary_search(elsewhere.begin(), elsewhere.end(), edges.ends[e])) continue;
        const int side = edges.side(e, 0);
        add(side_tail(broken, side), at_border);
        add(side_head(broken, side), at_border);
    }
    for (int copy = 0; copy < static_cast<int>(input_vertex.size()); ++copy) add(copy, side_of_);
    for (std::size_t v = 0; v < side_of_.size(); ++v) {
        if (side_of_[v] != several) continue;
        is_parted_[v] = at_border[v] < 0 ? 1 : 0;
        side_of_[v] = is_parted_[v] ? none : at_border[v];
    }
}

std::optional<SlopeFit> SidedFits::at_vertex(int vertex) {
    const int side = side_of_[vertex];
    return side == none ? whole_->at_vertex(vertex) : one_side_->at_vertex(side);
}

Vector3 SidedFits::averaged(int vertex) const {
    const int side = side_of_[vertex];
    return side == none ? whole_->averaged(vertex) : one_side_->averaged(side);
}

Points filtered_normals(const SurroundingFit& fit) {
    const Points turns = FilterSystem(fit).turns();
    Points normals = fit.averaged;
    for (Eigen::Index k = 0; k < normals.cols(); ++k) {
        const auto& here = fit.fits[static_cast<int>(k)];
        if (here) normals.col(k) = direction(here->normal + turns.col(fit.first[static_cast<int>(k)]));
    }
    return normals;
}

}  // namespace fairing
