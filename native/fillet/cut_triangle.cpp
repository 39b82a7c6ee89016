#include "fillet/cut_triangle.h"

namespace fairing {

namespace {

// Share of an area, and of an edge's length squared: points on a line come within some 1e-14 of it.
constexpr double straight = 1e-12;

std::array<int, 2> sorted_pair(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

CutTriangle::CutTriangle(const Vector2& a, const Vector2& b, const Vector2& c)
    : places_{a, b, c}, flat_(straight * cross2(b - a, c - a)) {
    put(0, {0, 1, 2});
}

double CutTriangle::area(int a, int b, int c) const { return cross2(places_[b] - places_[a], places_[c] - places_[a]); }

int CutTriangle::at(int from, int to) const {
    const auto found = sides_.find({from, to});
    return found == sides_.end() ? none : found->second;
}

bool CutTriangle::is_held(int a, int b) const { return held_.contains(sorted_pair(a, b)); }

int CutTriangle::opposite(int triangle, int a, int b) const {
    for (const int corner : triangles_[triangle]) {
        if (corner != a && corner != b) return corner;
    }
    return none;
}

void CutTriangle::remove_sides(int triangle) {
    const Corners& corners = triangles_[triangle];
    for (std::size_t k = 0; k < 3; ++k) sides_.erase({corners[k], corners[(k + 1) % 3]});
}

// A triangle, in place of the one with that number if there is one.
void CutTriangle::put(int triangle, const Corners& corners) {
    if (triangle == static_cast<int>(triangles_.size()))
        triangles_.push_back(corners);
    else
        triangles_[triangle] = corners;
    for (std::size_t k = 0; k < 3; ++k) sides_[{corners[k], corners[(k + 1) % 3]}] = triangle;
}

int CutTriangle::add_on_side(int k, const Vector2& place) {
    const int point = static_cast<int>(places_.size());
    places_.push_back(place);
    const int before = last_on_side_[k];
    const int after = (k + 1) % 3;
    const int whole = at(before, after);
    const int apex = opposite(whole, before, after);
    remove_sides(whole);
    put(whole, {before, point, apex});
    put(static_cast<int>(triangles_.size()), {point, after, apex});
    last_on_side_[k] = point;
    return point;
}

// Between the ends of an edge: in a triangle without area a point may be on the lines of all sides.
bool CutTriangle::is_on(int a, int b, int point) const {
    const Vector2 chord = places_[b] - places_[a];
    const double along = chord.dot(places_[point] - places_[a]);
    return area(a, b, point) <= flat_ && along > 0.0 && along < chord.squaredNorm();
}

int CutTriangle::add_inside(const Vector2& place) {
    const int point = static_cast<int>(places_.size());
    places_.push_back(place);
    int best = 0;
    double widest = -std::numeric_limits<double>::infinity();
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
        const auto [a, b, c] = triangles_[t];
        const double least = std::min({area(a, b, point), area(b, c, point), area(c, a, point)});
        if (least > widest) {
            widest = least;
            best = t;
        }
    }
    const Corners whole = triangles_[best];
    remove_sides(best);
    bool first = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const int a = whole[k];
        const int b = whole[(k + 1) % 3];
        const int beyond = at(b, a);
        if (beyond != none && is_on(a, b, point)) {  // the triangle there is parted, too
            const int apex = opposite(beyond, a, b);
            remove_sides(beyond);
            put(beyond, {b, point, apex});
            sides_.erase({b, a});
            put(static_cast<int>(triangles_.size()), {point, a, apex});
            continue;
        }
        put(first ? best : static_cast<int>(triangles_.size()), {a, b, point});
        first = false;
    }
    return point;
}

bool CutTriangle::is_in_circle(int a, int b, int c, int d) const {
    const auto row = [&](int k) { return Vector2(places_[k] - places_[d]); };
    const Vector2 u = row(a);
    const Vector2 v = row(b);
    const Vector2 w = row(c);
    const double determinant =
        u.squaredNorm() * cross2(v, w) - v.squaredNorm() * cross2(u, w) + w.squaredNorm() * cross2(u, v);
    const double size = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
    return determinant > straight * size * size;
}

// The diagonal of the two triangles beside an edge becomes the other one, where both stay triangles.
bool CutTriangle::flip(int a, int b) {
    const int one = at(a, b);
    const int other = at(b, a);
    if (one == none || other == none || is_held(a, b)) return false;
    const int c = opposite(one, a, b);
    const int d = opposite(other, a, b);
    if (area(c, d, b) <= flat_ || area(d, c, a) <= flat_) return false;
    remove_sides(one);
    remove_sides(other);
    put(one, {c, d, b});
    put(other, {d, c, a});
    return true;
}

void CutTriangle::make_delaunay() {
    bool changed = true;
    for (std::size_t sweep = 0; changed && sweep < places_.size(); ++sweep) {
        changed = false;
        std::vector<std::array<int, 2>> edges;
        for (const auto& [side, triangle] : sides_) {
            if (side[0] < side[1]) edges.push_back(side);
        }
        for (const auto& [a, b] : edges) {
            const int one = at(a, b);
            const int other = at(b, a);
            if (one == none || other == none) continue;
            if (is_in_circle(a, b, opposite(one, a, b), opposite(other, a, b)) && flip(a, b)) changed = true;
        }
    }
}

// A point on the straight line between two others, the nearest to the first; `none` without.
int CutTriangle::point_between(int a, int b) const {
    const Vector2 chord = places_[b] - places_[a];
    const double size = chord.squaredNorm();
    int found = none;
    double nearest = 1.0;
    for (int p = 0; p < static_cast<int>(places_.size()); ++p) {
        if (p == a || p == b) continue;
        const Vector2 to = places_[p] - places_[a];
        const double share = to.dot(chord) / size;
        if (share <= 0.0 || share >= nearest || std::abs(cross2(chord, to)) > straight * size) continue;
        nearest = share;
        found = p;
    }
    return found;
}

// Point by point, and no more often than there are points: roundoff may put two that coincide each before the other.
bool CutTriangle::add_edge(int a, int b) {
    for (std::size_t step = 0; step < places_.size(); ++step) {
        const int between = point_between(a, b);
        if (!join(a, between == none ? b : between)) return false;
        if (between == none) return true;
        a = between;
    }
    return false;
}

// What the line crosses is meshed anew on both of its sides (Anglada 1997).
bool CutTriangle::join(int a, int b) {
    if (at(a, b) == none && at(b, a) == none) {
        const std::optional<Passage> passed = passage(a, b);
        if (!passed) return false;
        std::vector<Corners> made;
        if (!cover(a, b, passed->left, made) || !cover(b, a, {passed->right.rbegin(), passed->right.rend()}, made))
            return false;
        for (const int t : passed->triangles) remove_sides(t);
        for (std::size_t k = 0; k < made.size(); ++k) put(passed->triangles[k], made[k]);
    }
    held_[sorted_pair(a, b)] = 1;
    return true;
}

// Nothing where the line touches a point between, or an edge that is held.
std::optional<CutTriangle::Passage> CutTriangle::passage(int a, int b) const {
    Passage found;
    int right = none;
    int left = none;
    for (int t = 0; t < static_cast<int>(triangles_.size()) && found.triangles.empty(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            right = triangles_[t][(k + 1) % 3];
            left = triangles_[t][(k + 2) % 3];
            if (triangles_[t][k] != a || !(area(a, b, right) < 0.0) || !(area(a, b, left) > 0.0)) continue;
            found = {{t}, {left}, {right}};
            break;
        }
    }
    while (!found.triangles.empty() && found.triangles.size() < triangles_.size()) {
        right = found.right.back();
        left = found.left.back();
        const int t = at(left, right);
        if (t == none || is_held(left, right)) return std::nullopt;
        found.triangles.push_back(t);
        const int next = opposite(t, left, right);
        if (next == b) return found;
        const double side = area(a, b, next);
        if (side == 0.0) return std::nullopt;
        (side > 0.0 ? found.left : found.right).push_back(next);
    }
    return std::nullopt;
}

// The polygon on the left of the line from a to b, by triangles whose circles hold none of its points. Around an edge
// that hangs into it a point comes twice: only one of both parts it well.
bool CutTriangle::cover(int a, int b, const Indices& chain, std::vector<Corners>& made) const {
    if (chain.empty()) return true;
    int best = chain.front();
    for (const int each : chain) best = is_in_circle(a, b, best, each) ? each : best;
    if (!(area(a, b, best) > flat_)) return false;
    const std::size_t before = made.size();
    for (auto at = chain.begin(); at != chain.end(); ++at) {
        if (*at != best) continue;
        made.push_back({a, b, best});
        if (cover(a, best, {chain.begin(), at}, made) && cover(best, b, {at + 1, chain.end()}, made)) return true;
        made.resize(before);
    }
    return false;
}

}  // namespace fairing
