#include "fillet/row_cut.h"

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
            corners_.emplace_back(cut.triangles.col(t));
            if (cut.inside[t] != 0) continue;
            for (const int v : cut.triangles.col(t)) {
                if (at_.contains(v)) at_[v].insert(t);
            }
        }
    }

    // A point, and those that go right after it, with all pieces at them: what they cover is meshed anew.
    void drop(int first) {
        if (!next_.contains(first)) return;  // with one before
        for (std::size_t step = 0; at_.contains(previous(first)); ++step) {
            if (step == at_.size()) throw NoRows();  // the line's last points would go
            first = previous(first);
        }
        std::set<int> star;
        const int before = previous(first);
        int after = first;
        std::set<int> group;
        for (; at_.contains(after); after = next(after)) {
            star.insert(at_[after].begin(), at_[after].end());
            group.insert(after);
        }
        const Indices rim = around(star, group);
        const int parent = cut_.parent[*star.begin()];
        for (const int t : star) remove(t);
        for (const auto& piece : meshed(rim)) add(piece, parent);
        for (int p = first; p != after;) {
            const int following = next(p);
            next_.erase(p);
            previous_.erase(p);
            p = following;
        }
        next_[before] = after;
        previous_[after] = before;
    }

    void finish() {
        std::vector<Eigen::Vector3i> corners;
        SplitMesh made{cut_.points, {}, {}, {}, cut_.seams, {}};
        for (std::size_t t = 0; t < corners_.size(); ++t) {
            if (gone_.contains(static_cast<int>(t))) continue;
            corners.push_back(corners_[t]);
            made.parent.push_back(cut_.parent[t]);
            made.inside.push_back(cut_.inside[t]);
        }
        made.triangles = as_columns(corners);
        for (const auto& [from, to] : next_) made.line.push_back({from, to});
        cut_ = std::move(made);
    }

private:
    [[nodiscard]] int next(int p) const { return follower(next_, p); }
    [[nodiscard]] int previous(int p) const { return follower(previous_, p); }
    static int follower(const std::map<int, int>& of, int p) {
        const auto found = of.find(p);
        if (found == of.end()) throw NoRows();
        return found->second;
    }

    void add(const Eigen::Vector3i& piece, int parent) {
        const int t = static_cast<int>(corners_.size());
        corners_.push_back(piece);
        cut_.parent.push_back(parent);
        cut_.inside.push_back(0);
        for (const int v : piece) {
            if (at_.contains(v)) at_[v].insert(t);
        }
    }
    void remove(int t) {
        gone_.insert(t);
        for (const int v : corners_[t]) {
            if (at_.contains(v)) at_[v].erase(t);
        }
    }

    // The border of a star without the points that go, from the line's next point on to the one before.
    [[nodiscard]] Indices around(const std::set<int>& star, const std::set<int>& group) const {
        std::vector<VertexPair> sides;
        for (const int t : star) {
            for (int k = 0; k < 3; ++k) sides.push_back({corners_[t][k], corners_[t][(k + 1) % 3]});
        }
        const Border border = border_of(sides);
        const auto begin = std::find_if(border.begin(), border.end(), [&](const auto& side) {
            return group.contains(side.first) && !group.contains(side.second);
        });
        if (begin == border.end()) throw NoRows();
        Indices rim{begin->second};
        std::size_t inner = 0;
        for (int v = border.at(begin->second); v != begin->second; v = border.at(v)) {
            if (group.contains(v))
                ++inner;
            else if (inner > 0)
                throw NoRows();  // two ways
            else
                rim.push_back(v);
        }
        if (rim.size() + inner != border.size()) throw NoRows();
        return rim;
    }

    // Of all ways to cut a polygon into triangles that whose flattest one is roundest.
    [[nodiscard]] std::vector<Eigen::Vector3i> meshed(const Indices& rim) const {
        const int count = static_cast<int>(rim.size());
        Vector3 up = Vector3::Zero();
        for (int k = 1; k + 1 < count; ++k) up += (at(rim[k]) - at(rim[0])).cross(at(rim[k + 1]) - at(rim[0]));
        up.normalize();
        struct Best {
            double roundness;
            int middle;
        };
        std::vector<std::vector<Best>> best(count, std::vector<Best>(count, {2.0, none}));
        for (int width = 2; width < count; ++width) {
            for (int i = 0; i + width < count; ++i) {
                Best& own = best[i][i + width] = {-2.0, none};
                for (int k = i + 1; k < i + width; ++k) {
                    const double found = std::min({best[i][k].roundness, best[k][i + width].roundness,
                                                   roundness({at(rim[i]), at(rim[k]), at(rim[i + width])}, up)});
                    if (found > own.roundness) own = {found, k};
                }
            }
        }
        if (best.front().back().roundness < flat) throw NoRows();
        std::vector<Eigen::Vector3i> found;
        std::vector<VertexPair> open{{0, count - 1}};
        while (!open.empty()) {
            const auto [i, j] = open.back();
            open.pop_back();
            const int k = best[i][j].middle;
            if (k == none) continue;
            found.emplace_back(rim[i], rim[k], rim[j]);
            open.push_back({i, k});
            open.push_back({k, j});
        }
        return found;
    }
    [[nodiscard]] Vector3 at(int v) const { return vertices_.col(v); }

    const Points& vertices_;
    SplitMesh& cut_;
    std::map<int, std::set<int>> at_;  // of each point that goes: the pieces outside
    std::map<int, int> next_, previous_;
    std::vector<Eigen::Vector3i> corners_;
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
    std::size_t passed = 0;
    for (const auto& [from, to] : whole) {
        if (left.contains(from)) continue;
        int next = to;
        for (++passed; left.contains(next); ++passed) next = whole.at(next);
        wanted[from] = next;
    }
    if (own != wanted || passed != whole.size()) throw NoRows();  // or a loop of dropped points alone
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
