#include "fillet/row_surface.h"

#include <Eigen/Geometry>

namespace fairing {

namespace {

constexpr int samples = 4;            // for each edge: ways on the fillet are measured in so many chords
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
    std::vector<double> ways{0.0};
    for (int k = 1; k <= steps; ++k)
        ways.push_back(ways.back() + (curve(static_cast<double>(k) / steps) - curve((k - 1.0) / steps)).norm());
    Indices found;
    for (int k = 1, at = 0; k < parts; ++k) {
        const double wanted = ways.back() * k / parts;
        while (at + 1 < steps && ways[at + 1] < wanted) ++at;
        const double step = ways[at + 1] - ways[at];
        found.push_back(add(curve((at + (step > 0.0 ? (wanted - ways[at]) / step : 0.0)) / steps)));
    }
    return found;
}

Indices RowSurface::between(int from, int to, int parts) {
    const Vector3 begin = place(from);
    const Vector3 end = place(to);
    return along([&](double t) { return Vector3((1.0 - t) * begin + t * end); }, parts);
}

Indices RowSurface::way_within(int from, int to) const {
    std::map<int, double> reached{{from, 0.0}};
    std::map<int, int> come;
    std::set<std::pair<double, int>> open{{0.0, from}};
    while (!open.empty() && open.begin()->second != to) {
        const auto [length, v] = *open.begin();
        open.erase(open.begin());
        for (const int other : beside_[v]) {
            if (other == to ? v == from : !is_passable(other)) continue;
            const double more = length + (place(other) - place(v)).norm();
            const auto known = reached.find(other);
            if (known != reached.end() && known->second <= more) continue;
            if (known != reached.end()) open.erase({known->second, other});
            reached[other] = more;
            come[other] = v;
            open.insert({more, other});
        }
    }
    if (open.empty()) throw NoRows();
    Indices way{to};
    while (way.back() != from) way.push_back(come.at(way.back()));
    std::reverse(way.begin(), way.end());
    return way;
}

void RowSurface::take(const Indices& way, int owner) {
    for (std::size_t k = 1; k + 1 < way.size(); ++k) taken_[way[k]] = owner;
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
    return zipped(from, to, [&](int v) { return place(v); }, [&](int v) { return normal(v); }, least_round);
}

std::vector<Eigen::Vector3i> zipped(const Indices& from, const Indices& to, const VertexVector& place,
                                    const VertexVector& normal, double least) {
    const std::size_t n = from.size();
    const std::size_t m = to.size();
    const auto corners = [&](std::size_t i, std::size_t j, bool steps) {
        return steps ? Eigen::Vector3i(from[i], from[i + 1], to[j]) : Eigen::Vector3i(from[i], to[j + 1], to[j]);
    };
    const auto is_none = [](const Eigen::Vector3i& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
    const auto roundness = [&](const Eigen::Vector3i& t) {
        if (is_none(t)) return 2.0;
        const Vector3 a = place(t[0]);
        const Vector3 b = place(t[1]);
        const Vector3 c = place(t[2]);
        const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
        return (b - a).cross(c - a).dot((normal(t[0]) + normal(t[1]) + normal(t[2])).normalized()) / longest;
    };
    struct Best {
        double roundness = -2.0;
        bool steps = false;  // with which it was reached
    };
    std::vector<std::vector<Best>> best(n, std::vector<Best>(m));
    best[0][0] = {2.0, false};
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < m; ++j) {
            for (const bool steps : {true, false}) {
                if (steps ? i == 0 : j == 0) continue;
                const Best& before = steps ? best[i - 1][j] : best[i][j - 1];
                const double found =
                    std::min(before.roundness, roundness(steps ? corners(i - 1, j, true) : corners(i, j - 1, false)));
                if (found > best[i][j].roundness) best[i][j] = {found, steps};
            }
        }
    }
    std::vector<Eigen::Vector3i> made;
    if (best[n - 1][m - 1].roundness < least) return made;
    for (std::size_t i = n - 1, j = m - 1; i + j > 0;) {
        const bool steps = best[i][j].steps;
        steps ? --i : --j;
        if (const Eigen::Vector3i t = corners(i, j, steps); !is_none(t)) made.push_back(t);
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
