#include "fillet/row_cut.h"

#include <map>
#include <set>

#include <Eigen/Geometry>

#include "base/columns.h"
#include "fillet/row_surface.h"

namespace fairing {

namespace {

constexpr double flat = 1e-6;   // of a piece's longest side squared: as little area is none
constexpr double plane = 1e-3;  // radians: pieces that are turned by more are not in one plane

}  // namespace

ClosedPieces::ClosedPieces(const Points& vertices, SplitMesh& cut)
    : vertices_(vertices), cut_(cut), at_(vertices.cols()), dropped_(static_cast<std::size_t>(vertices.cols()), 0) {
    for (int t = 0; t < cut.triangles.cols(); ++t) {
        corners_.emplace_back(cut.triangles.col(t));
        gone_.push_back(0);
        if (cut.inside[t] != 0) continue;
        for (const int v : cut.triangles.col(t)) at_[v].push_back(t);
    }
}

bool ClosedPieces::drop(const Indices& points) {
    std::set<int> star;
    for (const int p : points) star.insert(at_[p].begin(), at_[p].end());
    if (star.empty()) return false;
    const auto normal = [&](const Piece& t) { return Vector3((at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]))); };
    Vector3 up = Vector3::Zero();
    for (const int t : star) up += normal(corners_[t]);
    for (const int t : star) {
        const Vector3 own = normal(corners_[t]);
        if (own.cross(up).norm() > plane * own.norm() * up.norm() && own.norm() > flat * up.norm()) return false;
    }
    const Indices rim = around({star.begin(), star.end()}, points);
    if (rim.size() < 3) return false;
    up.normalize();
    const std::vector<Piece> made = roundest(rim, [&](int v) { return at(v); }, [&](int) { return up; }, flat);
    if (made.empty()) return false;
    const int parent = cut_.parent[*star.begin()];
    for (const int t : star) remove(t);
    for (const Piece& piece : made) add(piece, parent);
    for (const int p : points) dropped_[p] = 1;
    return true;
}

void ClosedPieces::finish() {
    std::vector<Piece> corners;
    std::map<int, int> next;
    for (const auto& [from, to] : cut_.line) next[from] = to;
    SplitMesh made{cut_.points, {}, {}, {}, cut_.seams, {}};
    for (std::size_t t = 0; t < corners_.size(); ++t) {
        if (gone_[t] != 0) continue;
        corners.push_back(corners_[t]);
        made.parent.push_back(cut_.parent[t]);
        made.inside.push_back(cut_.inside[t]);
    }
    made.triangles = as_columns(corners);
    for (const auto& [from, to] : cut_.line) {
        if (dropped_[from] != 0) continue;
        int end = to;
        while (dropped_[end] != 0 && next.contains(end)) end = next.at(end);
        made.line.push_back({from, end});
    }
    cut_ = std::move(made);
}

void ClosedPieces::add(const Piece& piece, int parent) {
    const int t = static_cast<int>(corners_.size());
    corners_.push_back(piece);
    gone_.push_back(0);
    cut_.parent.push_back(parent);
    cut_.inside.push_back(0);
    for (const int v : piece) at_[v].push_back(t);
}

void ClosedPieces::remove(int t) {
    gone_[t] = 1;
    for (const int v : corners_[t]) std::erase(at_[v], t);
}

// The border of a star without the points that go, from the line's next point on to the one before; empty where it is
// no disc, or they are not in one piece on its border.
Indices ClosedPieces::around(const std::vector<int>& star, const Indices& group) const {
    std::map<VertexPair, int> sides;
    for (const int t : star) {
        for (int k = 0; k < 3; ++k) ++sides[{corners_[t][k], corners_[t][(k + 1) % 3]}];
    }
    std::map<int, int> border;
    std::size_t count = 0;
    for (const auto& [side, uses] : sides) {
        if (uses > 1) return {};
        if (sides.contains({side[1], side[0]})) continue;
        border[side[0]] = side[1];
        ++count;
    }
    if (border.size() != count) return {};
    const auto is_one = [&](int v) { return std::find(group.begin(), group.end(), v) != group.end(); };
    const auto begin = std::find_if(border.begin(), border.end(),
                                    [&](const auto& side) { return is_one(side.first) && !is_one(side.second); });
    if (begin == border.end()) return {};
    Indices rim{begin->second};
    std::size_t inner = 0;
    for (int v = border.at(begin->second); v != begin->second; v = border.at(v)) {
        if (is_one(v))
            ++inner;
        else if (inner > 0)
            return {};  // two ways
        else
            rim.push_back(v);
    }
    return rim.size() + inner == border.size() && inner == group.size() ? rim : Indices{};
}

}  // namespace fairing
