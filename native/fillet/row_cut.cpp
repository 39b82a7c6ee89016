#include "fillet/row_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>

#include "base/columns.h"

namespace fairing {

namespace {

constexpr double flat = 1e-6;  // of a piece's longest side squared: as little area is none

using Border = std::map<int, int>;  // what follows each vertex

template <typename Sides>
Border border_of(const Sides& sides) {
    const std::set<VertexPair> known(sides.begin(), sides.end());
    Border border;
    std::size_t count = 0;
    for (const auto& [a, b] : known) {
        if (known.contains({b, a})) continue;
        border[a] = b;
        ++count;
    }
    if (known.size() != sides.size() || border.size() != count) throw NoRows();  // a side or a vertex twice
    return border;
}

// Twice a piece's area over the square of its longest side, negative where it is turned over.
double roundness(const std::array<Vector3, 3>& at, const Vector3& up) {
    const double area = (at[1] - at[0]).cross(at[2] - at[0]).dot(up);
    const double longest =
        std::max({(at[1] - at[0]).squaredNorm(), (at[2] - at[1]).squaredNorm(), (at[0] - at[2]).squaredNorm()});
    return longest > 0.0 ? area / longest : 0.0;
}

class Dropping {
public:
    Dropping(const Points& vertices, const Indices& dropped, SplitMesh& cut) : vertices_(vertices), cut_(cut) {
        for (const int p : dropped) at_[p] = {};
        for (const auto& [from, to] : cut.line) {
            next_[from] = to;
            previous_[to] = from;
        }
        for (int t = 0; t < cut.triangles.cols(); ++t) {
            if (cut.inside[t] != 0) continue;
            for (const int v : cut.triangles.col(t)) {
                if (at_.contains(v)) at_[v].insert(t);
            }
        }
    }

    void drop(int p) {
        const auto before = previous_.find(p);
        const auto after = next_.find(p);
        if (before == previous_.end() || after == next_.end()) throw NoRows();
        const int a = before->second;
        const int b = after->second;
        const double to_a = worst(p, a);
        const double to_b = worst(p, b);
        if (std::max(to_a, to_b) < flat) throw NoRows();
        close(p, to_a >= to_b ? a : b);
        next_[a] = b;
        previous_[b] = a;
        next_.erase(p);
        previous_.erase(p);
    }

    void finish() {
        std::vector<Eigen::Vector3i> corners;
        SplitMesh made{cut_.points, {}, {}, {}, cut_.seams, {}};
        for (int t = 0; t < cut_.triangles.cols(); ++t) {
            if (gone_.contains(t)) continue;
            corners.emplace_back(cut_.triangles.col(t));
            made.parent.push_back(cut_.parent[t]);
            made.inside.push_back(cut_.inside[t]);
        }
        made.triangles = as_columns(corners);
        for (const auto& [from, to] : next_) made.line.push_back({from, to});
        cut_ = std::move(made);
    }

private:
    [[nodiscard]] bool has(int t, int v) const { return (cut_.triangles.col(t).array() == v).any(); }
    [[nodiscard]] std::array<Vector3, 3> places(int t, int from, int to) const {
        std::array<Vector3, 3> at;
        for (int k = 0; k < 3; ++k) {
            const int v = cut_.triangles(k, t);
            at[static_cast<std::size_t>(k)] = vertices_.col(v == from ? to : v);
        }
        return at;
    }

    [[nodiscard]] double worst(int p, int to) const {
        double least = 1.0;
        for (const int t : at_.at(p)) {
            if (has(t, to)) continue;
            const auto old = places(t, p, p);
            least = std::min(least, roundness(places(t, p, to), (old[1] - old[0]).cross(old[2] - old[0]).normalized()));
        }
        return least;
    }

    void close(int p, int to) {
        for (const int t : at_.at(p)) {
            if (has(t, to)) {
                gone_.insert(t);
                for (auto& [v, own] : at_) {
                    if (v != p) own.erase(t);
                }
                continue;
            }
            for (int k = 0; k < 3; ++k) {
                if (cut_.triangles(k, t) == p) cut_.triangles(k, t) = to;
            }
            if (at_.contains(to)) at_[to].insert(t);
        }
        at_[p].clear();
    }

    const Points& vertices_;
    SplitMesh& cut_;
    std::map<int, std::set<int>> at_;  // of each point that goes: the pieces outside
    std::map<int, int> next_, previous_;
    std::set<int> gone_;
};

}  // namespace

void check_border(const SplitMesh& cut, const Indices& dropped, const std::vector<Quad>& quads) {
    std::vector<VertexPair> sides;
    for (const Quad& quad : quads) {
        for (std::size_t k = 0; k < 4; ++k) sides.push_back({quad[k], quad[(k + 1) % 4]});
    }
    const Border own = border_of(sides);
    sides.clear();
    for (Eigen::Index t = 0; t < cut.triangles.cols(); ++t) {
        if (cut.inside[t] == 0) continue;
        for (int k = 0; k < 3; ++k) sides.push_back({cut.triangles(k, t), cut.triangles((k + 1) % 3, t)});
    }
    const Border whole = border_of(sides);
    const std::set<int> left(dropped.begin(), dropped.end());
    Border wanted;
    for (const auto& [from, to] : whole) {
        if (left.contains(from)) continue;
        int next = to;
        while (left.contains(next)) next = whole.at(next);
        wanted[from] = next;
    }
    if (own != wanted) throw NoRows();
}

void drop_points(const Points& vertices, const Indices& dropped, SplitMesh& cut) {
    if (dropped.empty()) return;
    Dropping dropping(vertices, dropped, cut);
    for (const int p : dropped) dropping.drop(p);
    dropping.finish();
}

double widest_angle(const Quad& quad, const Points& vertices) {
    const auto at = [&](std::size_t k) { return Vector3(vertices.col(quad[k % 4])); };
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
