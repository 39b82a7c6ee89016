#include "mesh/hole_loops.h"

#include <map>

#include <Eigen/Geometry>

#include "mesh/edges.h"
#include "mesh/twins.h"

namespace fairing {

namespace {

using Pair = std::array<int, 2>;

// The first and the last spoke of each open fan, counter-clockwise; nothing where two triangles lie on one side of an
// edge. `spokes`: those of each triangle.
std::vector<Pair> open_fans(const std::vector<Pair>& spokes) {
    std::map<int, int> after;
    std::map<int, int> before;
    for (const auto& [one, other] : spokes) {
        if (!after.emplace(one, other).second || !before.emplace(other, one).second) return {};
    }
    std::vector<Pair> fans;
    for (const auto& [first, next] : after) {
        if (before.contains(first)) continue;
        int last = next;
        for (auto found = after.find(last); found != after.end(); found = after.find(last)) last = found->second;
        fans.push_back({first, last});
    }
    return fans;
}

// The fans counter-clockwise around the vertex. With two fans, each follows the other.
std::vector<Pair> in_order(int vertex, std::vector<Pair> fans, const View<Points>& points,
                           const std::vector<Pair>& spokes) {
    if (fans.size() < 3) return fans;
    const Vector3 here = points.col(vertex);
    Vector3 normal = Vector3::Zero();
    for (const auto& [a, b] : spokes) normal += (points.col(a) - here).cross(points.col(b) - here);
    int flattest = 0;
    normal.cwiseAbs().minCoeff(&flattest);
    const Vector3 first = Vector3::Unit(flattest).cross(normal);
    const Vector3 second = normal.cross(first) / std::max(normal.norm(), std::numeric_limits<double>::min());
    const auto angle = [&](const Pair& fan) {
        const Vector3 away = points.col(fan[0]) - here;
        return std::atan2(away.dot(second), away.dot(first));
    };
    std::stable_sort(fans.begin(), fans.end(), [&](const Pair& a, const Pair& b) { return angle(a) < angle(b); });
    return fans;
}

// The open sectors around some vertices: where the loop through each comes from, and where it goes.
class Sectors {
public:
    Sectors(const View<Points>& points, const Triangles& triangles, const Indices& vertices) : points_(points) {
        for (const int v : vertices) spokes_[v];
        for (const auto corners : triangles.colwise()) {
            if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
            for (int k = 0; k < 3; ++k) {
                const auto star = spokes_.find(corners[k]);
                if (star != spokes_.end()) star->second.push_back({corners[(k + 1) % 3], corners[(k + 2) % 3]});
            }
        }
    }

    [[nodiscard]] std::vector<Pair> around(int vertex) const {
        const std::vector<Pair>& spokes = spokes_.at(vertex);
        const std::vector<Pair> fans = in_order(vertex, open_fans(spokes), points_, spokes);
        std::vector<Pair> sectors;
        sectors.reserve(fans.size());
        // Counter-clockwise a sector begins at the last spoke of a fan, along which its loop leaves.
        for (std::size_t k = 0; k < fans.size(); ++k)
            sectors.push_back({fans[k][0], fans[(k + fans.size() - 1) % fans.size()][1]});
        return sectors;
    }

private:
    const View<Points> points_;
    std::map<int, std::vector<Pair>> spokes_;
};

// The number of the border side that follows each; `none` where the chain ends.
class Walk {
public:
    Walk(const BorderSides& sides, int vertex_count) : sides_(sides), after_(sides.size(), none) {
        leaving_.resize(static_cast<std::size_t>(vertex_count) + 1, 0);
        coming_ = leaving_;
        for (const auto& [tail, head] : sides) {
            ++leaving_[tail];
            ++coming_[head];
        }
    }

    void follow(std::size_t side, int next) { after_[side] = next; }

    void join(const View<Points>& points, const Triangles& triangles) {
        Indices out(leaving_.size(), none);
        for (std::size_t k = 0; k < sides_.size(); ++k) out[sides_[k][0]] = static_cast<int>(k);
        Indices several;
        for (std::size_t k = 0; k < sides_.size(); ++k) {
            const int v = sides_[k][1];
            if (coming_[v] != leaving_[v]) continue;
            if (coming_[v] == 1) after_[k] = out[v];
            if (coming_[v] > 1) several.push_back(v);
        }
        if (several.empty()) return;
        std::sort(several.begin(), several.end());
        several.erase(std::unique(several.begin(), several.end()), several.end());
        join_at_pinches(several, Sectors(points, triangles, several));
    }

    [[nodiscard]] HoleLoops walked() const {
        HoleLoops result;
        std::vector<char> seen(sides_.size(), 0);
        std::vector<char> follows(sides_.size(), 0);
        for (const int next : after_) {
            if (next != none) follows[next] = 1;
        }
        for (const bool closed : {false, true}) {
            for (std::size_t start = 0; start < sides_.size(); ++start) {
                if (seen[start] || (!closed && follows[start])) continue;
                Indices chain{sides_[start][0]};
                for (int side = static_cast<int>(start); side != none && !seen[side]; side = after_[side]) {
                    seen[side] = 1;
                    chain.push_back(sides_[side][1]);
                }
                if (closed) chain.pop_back();
                (closed ? result.loops : result.torn).push_back(std::move(chain));
            }
        }
        for (Indices& loop : result.loops)
            std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
        std::sort(result.loops.begin(), result.loops.end());
        return result;
    }

private:
    void join_at_pinches(const Indices& vertices, const Sectors& sectors) {
        std::map<Pair, int> numbers;
        for (std::size_t k = 0; k < sides_.size(); ++k) {
            if (coming_[sides_[k][0]] > 1 || coming_[sides_[k][1]] > 1) numbers[sides_[k]] = static_cast<int>(k);
        }
        for (const int v : vertices) {
            std::vector<Pair> passes;
            for (const auto& [from, to] : sectors.around(v)) {
                const auto in = numbers.find({from, v});
                const auto out = numbers.find({v, to});
                if (in == numbers.end() || out == numbers.end()) {
                    passes.clear();
                    break;
                }
                passes.push_back({in->second, out->second});
            }
            if (static_cast<int>(passes.size()) != leaving_[v]) continue;
            for (const auto& [in, out] : passes) after_[in] = out;
        }
    }

    const BorderSides& sides_;
    Indices after_;
    Indices leaving_;  // of each vertex, how many sides
    Indices coming_;
};

}  // namespace

BorderSides border_sides(const Triangles& given, int vertex_count) {
    const Triangles triangles = without_collapsed(given);
    const EdgeTable edges = make_edges(triangles, vertex_count);
    Indices sides;
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) == 1) sides.push_back(edges.side(e, 0));
    }
    std::sort(sides.begin(), sides.end());
    BorderSides result;
    for (const int side : sides) result.push_back({side_head(triangles, side), side_tail(triangles, side)});
    return result;
}

HoleLoops hole_loops(const View<Points>& points, const Triangles& triangles, const BorderSides& border) {
    Walk walk(border, static_cast<int>(points.cols()));
    walk.join(points, triangles);
    return walk.walked();
}

std::vector<Indices> parted_loop(const Indices& loop, const View<Points>& points, const Triangles& triangles) {
    BorderSides sides;
    for (std::size_t k = 0; k < loop.size(); ++k) sides.push_back({loop[k], loop[(k + 1) % loop.size()]});
    Walk walk(sides, static_cast<int>(points.cols()));
    for (std::size_t k = 0; k < loop.size(); ++k) walk.follow(k, static_cast<int>((k + 1) % loop.size()));
    walk.join(points, triangles);
    return walk.walked().loops;
}

}  // namespace fairing
