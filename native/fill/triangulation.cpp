#include "fill/triangulation.h"

#include <map>

#include <Eigen/Geometry>

#include "base/progress.h"

namespace fairing {

namespace {

constexpr std::size_t largest_exact = 400;  // corners: n³ operations, n² of memory
constexpr double share_of_edges = 1e-3;     // beside areas, which don't choose on flat polygons

// Chord (i, k) of n corners, i < k.
class Chords {
public:
    explicit Chords(int n) : n_(n), cost_(place(n, 0), 0.0), apex_(place(n, 0), none) {}
    [[nodiscard]] double& cost(int i, int k) { return cost_[place(i, k)]; }
    [[nodiscard]] int& apex(int i, int k) { return apex_[place(i, k)]; }

private:
    [[nodiscard]] std::size_t place(int i, int k) const { return static_cast<std::size_t>(i) * n_ + k; }

    int n_;
    std::vector<double> cost_;  // of the cheapest triangulation beyond the chord
    Indices apex_;              // of its triangle at the chord
};

void cut_exactly(const Indices& polygon, const TriangleCost& cost, std::vector<Eigen::Vector3i>& triangles) {
    const int n = static_cast<int>(polygon.size());
    if (n < 3) return;
    Chords chords(n);
    for (int width = 2; width < n; ++width) {
        checkpoint();
        for (int i = 0; i + width < n; ++i) {
            const int k = i + width;
            double least = std::numeric_limits<double>::infinity();
            chords.apex(i, k) = i + 1;  // where a corner is not finite, no cost is less
            for (int j = i + 1; j < k; ++j) {
                const double sum = chords.cost(i, j) + chords.cost(j, k);
                if (sum >= least) continue;
                const double whole = sum + cost(polygon[i], polygon[j], polygon[k]);
                if (whole >= least) continue;
                least = whole;
                chords.apex(i, k) = j;
            }
            chords.cost(i, k) = least;
        }
    }
    std::vector<std::pair<int, int>> open{{0, n - 1}};
    while (!open.empty()) {
        const auto [i, k] = open.back();
        open.pop_back();
        if (k - i < 2) continue;
        const int j = chords.apex(i, k);
        triangles.emplace_back(polygon[i], polygon[j], polygon[k]);
        open.emplace_back(i, j);
        open.emplace_back(j, k);
    }
}

// Places of the corners that are kept, ascending.
Indices kept_places(const Indices& polygon) {
    std::map<int, int> passes;
    for (const int v : polygon) ++passes[v];
    const std::size_t n = polygon.size();
    Indices kept;
    std::size_t next = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const bool due = k * (largest_exact / 2) >= next * n;
        if (due) ++next;
        if (due || passes[polygon[k]] > 1) kept.push_back(static_cast<int>(k));
    }
    return kept;
}

void cut(const Indices& polygon, const TriangleCost& cost, std::vector<Eigen::Vector3i>& triangles) {
    if (polygon.size() <= largest_exact) return cut_exactly(polygon, cost, triangles);
    const Indices kept = kept_places(polygon);
    if (kept.size() == polygon.size()) return cut_exactly(polygon, cost, triangles);
    Indices coarse;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        coarse.push_back(polygon[kept[k]]);
        Indices between;
        const std::size_t end = k + 1 < kept.size() ? (kept[k + 1]) : polygon.size() + kept[0];
        for (std::size_t place = kept[k]; place <= end; ++place) between.push_back(polygon[place % polygon.size()]);
        cut(between, cost, triangles);
    }
    cut(coarse, cost, triangles);
}

}  // namespace

TriangleCost::TriangleCost(const Points& points, Points directions, double outward)
    : points_(points), directions_(std::move(directions)), outward_(outward) {
    const Vector3 size = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
    dear_ = static_cast<double>(points.cols() + 8) * size.squaredNorm();
}

TriangleCost TriangleCost::along(const Points& normals) const {
    TriangleCost result(*this);
    result.normals_ = &normals;
    return result;
}

// How much a triangle's area counts more than where it faces as its corners do.
double TriangleCost::lean(const Vector3& area, int a, int b, int c) const {
    if (normals_ == nullptr) return 0.0;
    constexpr double weight = 10.0;  // times the area, at a right angle
    const Vector3 sum = normals_->col(a) + normals_->col(b) + normals_->col(c);
    return weight * (area.norm() - area.dot(sum) / 3.0);
}

double TriangleCost::operator()(int a, int b, int c) const {
    const Vector3 ab = points_.col(b) - points_.col(a);
    const Vector3 ac = points_.col(c) - points_.col(a);
    const double edges = ab.squaredNorm() + ac.squaredNorm() + (ac - ab).squaredNorm();
    const Vector3 area = 0.5 * ab.cross(ac);
    double cost = area.norm() + lean(area, a, b, c) + share_of_edges * edges;
    if (directions_.cols() == 0) return cost;
    if (a == b || b == c || c == a) return cost + 2.0 * dear_;
    const double volume = directions_.col(a).dot(directions_.col(b).cross(directions_.col(c)));
    if (outward_ * volume <= 0.0) cost += dear_;
    return cost;
}

std::vector<Eigen::Vector3i> cheapest_triangulation(const Indices& polygon, const TriangleCost& cost) {
    std::vector<Eigen::Vector3i> triangles;
    triangles.reserve(polygon.size());
    cut(polygon, cost, triangles);
    return triangles;
}

}  // namespace fairing
