// Which half-edge collapses of a CollapseMesh are legal, and what they cost.

#include "multigrid/collapse_mesh.h"

namespace fairing {

namespace {

constexpr int largest_valence = 9;  // that a collapse may make
constexpr int least_valence = 4;    // inside; three triangles around a vertex carry no curvature
constexpr double weak = 3.0;        // what a collapse along an edge without weight costs, in units of (valence − 6)²
constexpr double straight = 0.8;    // cosine of the turn that a thinned boundary or its normals may make at a vertex

}  // namespace

double CollapseMesh::valence_penalty(int v, int valence) const {
    const double excess = valence - (border_[v] ? 4 : 6);
    return excess * excess;
}

// What the collapse of the star's centre onto neighbour k does to the valences, and how weakly the two are tied.
double CollapseMesh::cost(const Star& star, std::size_t k, double largest) const {
    const int kept = star.vertices[k];
    const int valence = valence_[kept] + static_cast<int>(star.size()) - (star.closed ? 4 : 3);
    if (valence > largest_valence && valence >= valence_[kept]) return HUGE_VAL;
    double change = valence_penalty(kept, valence) - valence_penalty(kept, valence_[kept]) -
                    valence_penalty(star.centre, static_cast<int>(star.size()));
    const auto lose_one = [&](std::size_t j) {
        const int u = star.vertices[j];
        const int left = valence_[u] - 1;
        if (left < (border_[u] ? 3 : least_valence)) change = HUGE_VAL;
        change += valence_penalty(u, left) - valence_penalty(u, left + 1);
    };
    if (star.has_triangle(k)) lose_one(star.after(k));
    if (star.has_triangle(star.before(k))) lose_one(star.before(k));
    if (is_fixed(star.centre)) return change;
    return change + weak * (1.0 - star.weights[k] / largest);
}

bool CollapseMesh::may_thin(const Star& star, std::size_t k) const {
    const int v = star.centre;
    if (star.closed || loop_size_[loop_[v]] <= least_loop_size_[loop_[v]]) return false;
    const int a = star.vertices.front();
    const int b = star.vertices.back();
    const int kept = star.vertices[k];
    if (kept != a && kept != b) return false;
    const auto& points = boundary_.points;
    const Vector3 to = points.col(a) - points.col(v);
    const Vector3 from = points.col(v) - points.col(b);
    if (to.dot(from) < straight * to.norm() * from.norm()) return false;
    const auto& normals = boundary_.normals;
    return normals.col(a).dot(normals.col(b)) >= straight;
}

// The link condition, and no chord from a fixed vertex to another one.
bool CollapseMesh::is_legal(Star& star, std::size_t k) const {
    const int kept = star.vertices[k];
    if (is_fixed(star.centre) && !may_thin(star, k)) return false;
    star.around.clear();
    int s = first_side_[kept];
    const int start = s;
    do {
        star.around.push_back(sides_[next_side(s)].corner);
        const int last = previous_side(s);
        s = sides_[last].twin;
        if (s == none) star.around.push_back(sides_[last].corner);
    } while (s != none && s != start);
    const bool left = star.has_triangle(k);
    const bool right = star.has_triangle(star.before(k));
    for (std::size_t j = 0; j < star.size(); ++j) {
        if (j == k || (left && j == star.after(k)) || (right && j == star.before(k))) continue;
        if (std::find(star.around.begin(), star.around.end(), star.vertices[j]) != star.around.end()) return false;
        const bool along_boundary = !star.closed && (j == 0 || j + 1 == star.size());
        if (is_fixed(kept) && is_fixed(star.vertices[j]) && !along_boundary) return false;
    }
    return true;
}

}  // namespace fairing
