#include "fillet/row_surface.h"

#include <Eigen/Geometry>

#include "mesh/nearest_first.h"

namespace fairing {

namespace {

constexpr int samples = 4;            // for each edge: lengths on the fillet are measured in so many chords
constexpr double least_round = 1e-4;  // twice the area over the longest side squared: lower triangles are none
constexpr double most_wide = 170.0;   // degrees: short of a quad that is not convex

Indices all(Eigen::Index count) {
    Indices numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

}  // namespace

RowSurface::RowSurface(const Points& vertices, const Triangles& triangles, const Points& before,
                       const std::vector<Indices>& loops, const Carried& carried)
    : vertices_(vertices),
      triangles_(triangles),
      before_(before),
      carried_(carried),
      beneath_(vertices, triangles, all(triangles.cols())),
      beside_(vertices.cols()),
      normals_(Points::Zero(3, vertices.cols())) {
    for (const Indices& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int after = loop[(k + 1) % loop.size()];
            next_[loop[k]] = after;
            previous_[after] = loop[k];
        }
    }
    for (int t = 0; t < triangles.cols(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int a = triangles(k, t);
            const int b = triangles((k + 1) % 3, t);
            beside_[a].insert(b);
            beside_[b].insert(a);
            normals_.col(a) += area(t);
        }
    }
    normals_.colwise().normalize();
}

Vector3 RowSurface::area(int triangle) const {
    const auto t = triangles_.col(triangle);
    return (place(t[1]) - place(t[0])).cross(place(t[2]) - place(t[0]));
}

Vector3 RowSurface::normal(int v) const {
    return v < count() ? Vector3(normals_.col(v)) : area(made_[v - count()].under.triangle).normalized();
}

int RowSurface::add(const Vector3& near) {
    const NearestPlace under = beneath_.to(near);
    made_.push_back({under, carried_(under), none, {}});
    return count() + static_cast<int>(made_.size()) - 1;
}

void RowSurface::lift(int vertex, int half_edge, const Vector3& before) {
    made_[vertex - count()].half_edge = half_edge;
    made_[vertex - count()].before = before;
}

Indices RowSurface::along(const std::function<Vector3(double)>& curve, int parts) {
    const int steps = samples * parts;
    std::vector<double> lengths{0.0};
    for (int k = 1; k <= steps; ++k)
        lengths.push_back(lengths.back() + (curve(static_cast<double>(k) / steps) - curve((k - 1.0) / steps)).norm());
    Indices found;
    for (int k = 1, at = 0; k < parts; ++k) {
        const double wanted = lengths.back() * k / parts;
        while (at + 1 < steps && lengths[at + 1] < wanted) ++at;
        const double step = lengths[at + 1] - lengths[at];
        found.push_back(add(curve((at + (step > 0.0 ? (wanted - lengths[at]) / step : 0.0)) / steps)));
    }
    return found;
}

Indices RowSurface::between(int from, int to, int parts) {
    const Vector3 begin = place(from);
    const Vector3 end = place(to);
    return along([&](double t) { return Vector3((1.0 - t) * begin + t * end); }, parts);
}

Indices RowSurface::path_within(int from, int to) const {
    NearestFirst reached(VectorX::Constant(count(), std::numeric_limits<double>::infinity()));
    Indices come(static_cast<std::size_t>(count()), none);
    reached.lower(from, 0.0);
    for (int v = reached.next(); v != to; v = reached.next()) {
        if (v == none) throw NoRows();
        for (const int other : beside_[v]) {
            if (other == to ? v == from : !is_passable(other)) continue;
            if (reached.lower(other, reached[v] + (place(other) - place(v)).norm())) come[other] = v;
        }
    }
    Indices path{to};
    while (path.back() != from) path.push_back(come[path.back()]);
    std::reverse(path.begin(), path.end());
    return path;
}

void RowSurface::take(const Indices& path, int owner) {
    for (std::size_t k = 1; k + 1 < path.size(); ++k) taken_[path[k]] = owner;
}

void RowSurface::leave(int owner) {
    std::erase_if(taken_, [&](const auto& each) { return each.second == owner; });
}

bool RowSurface::are_good(const std::vector<Quad>& quads) const {
    return std::ranges::all_of(quads, [&](const Quad& quad) {
        const std::array<Vector3, 4> at{place(quad[0]), place(quad[1]), place(quad[2]), place(quad[3])};
        const Vector3 up = (at[2] - at[0]).cross(at[3] - at[1]);
        return widest_angle(at) <= most_wide &&
               std::ranges::all_of(quad, [&](int v) { return v < count() || up.dot(normal(v)) > 0.0; });
    });
}

std::vector<Eigen::Vector3i> RowSurface::zip(const Indices& from, const Indices& to) const {
    Indices polygon = from;
    polygon.insert(polygon.end(), to.rbegin(), to.rend());
    polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
    if (polygon.front() == polygon.back()) polygon.pop_back();
    return roundest(polygon, [&](int v) { return place(v); }, [&](int v) { return normal(v); }, least_round);
}

std::vector<Eigen::Vector3i> roundest(const Indices& polygon, const VertexVector& place, const VertexVector& normal,
                                      double least) {
    const auto count = static_cast<int>(polygon.size());
    std::vector<Vector3> at;
    std::vector<Vector3> up;
    for (const int v : polygon) {
        at.push_back(place(v));
        up.push_back(normal(v));
    }
    const auto roundness = [&](int i, int j, int k) {
        const double longest =
            std::max({(at[j] - at[i]).squaredNorm(), (at[k] - at[j]).squaredNorm(), (at[i] - at[k]).squaredNorm()});
        const double area = (at[j] - at[i]).cross(at[k] - at[i]).dot((up[i] + up[j] + up[k]).normalized());
        return longest > 0.0 ? area / longest : 0.0;
    };
    struct Best {
        double roundness;
        int middle;
    };
    std::vector<std::vector<Best>> best(count, std::vector<Best>(count, {2.0, none}));
    for (int width = 2; width < count; ++width) {
        for (int i = 0; i + width < count; ++i) {
            Best& own = best[i][i + width] = {-2.0, none};
            for (int k = i + 1; k < i + width; ++k) {
                const double known = std::min(best[i][k].roundness, best[k][i + width].roundness);
                if (known <= own.roundness) continue;
                const double found = std::min(known, roundness(i, k, i + width));
                if (found > own.roundness) own = {found, k};
            }
        }
    }
    std::vector<Eigen::Vector3i> made;
    if (best.front().back().roundness < least) return made;
    std::vector<std::array<int, 2>> open{{0, count - 1}};
    while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        const int k = best[i][j].middle;
        if (k == none) continue;
        made.emplace_back(polygon[i], polygon[k], polygon[j]);
        open.push_back({i, k});
        open.push_back({k, j});
    }
    return made;
}

double widest_angle(const std::array<Vector3, 4>& corners) {
    const auto at = [&](std::size_t k) { return corners[k % 4]; };
    const Vector3 normal = (at(2) - at(0)).cross(at(3) - at(1));
    double widest = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vector3 ahead = at(k + 1) - at(k);
        const Vector3 back = at(k + 3) - at(k);
        const Vector3 turn = ahead.cross(back);
        const double angle = std::atan2(turn.norm(), ahead.dot(back)) * 180.0 / std::numbers::pi;
        widest = std::max(widest, turn.dot(normal) > 0.0 ? angle : 360.0 - angle);
    }
    return widest;
}

}  // namespace fairing
