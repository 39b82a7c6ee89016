#include "boundary/walls.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/direction.h"
#include "boundary/closing.h"
#include "geometry/angle.h"
#include "geometry/area_vector.h"
#include "mesh/edges.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

// With one triangle on either side: sides 3 t + k of the two lists.
struct Meeting {
    std::array<int, 2> ends;
    int inside;
    int outside;
};

std::vector<Meeting> meetings(const PatchInMesh& mesh) {
    const auto count = static_cast<int>(mesh.points.cols());
    const EdgeTable inside = make_edges(mesh.inside, count);
    const EdgeTable outside = make_edges(mesh.outside, count);
    std::vector<Meeting> found;
    for (int i = 0, o = 0; i < inside.size() && o < outside.size();) {
        if (inside.ends[i] < outside.ends[o]) {
            ++i;
        } else if (outside.ends[o] < inside.ends[i]) {
            ++o;
        } else {
            if (inside.side_count(i) == 1 && outside.side_count(o) == 1)
                found.push_back({inside.ends[i], inside.side(i, 0), outside.side(o, 0)});
            ++i, ++o;
        }
    }
    return found;
}

Vector3 normal_of(const Points& points, const Triangles& triangles, int side) {
    return direction(area_vector(points, triangles.col(side / 3)));
}

// Means over a part of the boundary, by length. Angles lie across the edges, in degrees from the tangent of the
// surroundings towards their back.
struct Means {
    Eigen::Vector2d patch = Eigen::Vector2d::Zero();  // cosine and sine of the angle of its own triangles
    Eigen::Vector2d film = Eigen::Vector2d::Zero();   // likewise
    double bend = 0.0;                                // curvature across the edges times distance to the loop's middle
    double length = 0.0;
};

double angle_of(const Eigen::Vector2d& sum) { return std::atan2(sum.y(), sum.x()) / degree; }

constexpr double explained = 0.25;   // of the dip: balls .8 to 1.1, ellipsoids .35 to 2, boxes and cans 0 to .05
constexpr double rounder = 1.25;     // bend of which there is no ball: it has 1 at most
constexpr double far_rounder = 3.0;  // times the dip
// Of a loop: real meshes have single edges like walls everywhere.
constexpr double shortest_row = 0.125;

// A film can be nearer to the patch than to the surroundings by no more than these are apart.
bool may_be_wall(const Means& part) {
    const double own = std::abs(angle_of(part.patch));
    return own > fading_bend || (own > 1.0 && std::abs(part.bend) > rounder * part.length);
}

bool is_wall(const Means& part) {
    const double film = angle_of(part.film);
    const double nearer = std::abs(film) - std::abs(film - angle_of(part.patch));
    const double dip = part.film.y();
    if (part.bend * dip < explained * dip * dip) return nearer > fading_bend;
    const bool is_bevel = std::abs(part.bend) > std::max(rounder * part.length, far_rounder * std::abs(dip));
    return is_bevel && nearer > 0.5 * std::abs(film);
}

class Rim {
public:
    Rim(const PatchInMesh& mesh, const RimFits& rim)
        : mesh_(mesh),
          rim_(rim),
          edges_(meetings(mesh)),
          place_(static_cast<std::size_t>(mesh.points.cols()), none),
          parts_(place_.size(), 0) {
        for (std::size_t k = 0; k < rim.vertices.size(); ++k) place_[rim.vertices[k]] = static_cast<int>(k);
        for (const auto& ends : rim.hard) parts_[ends[0]] = parts_[ends[1]] = 1;
    }

    [[nodiscard]] Walls walls() const {
        UnionFind loops = joined([](int) { return true; });
        UnionFind parts = joined([&](int v) { return parts_[v] == 0; });
        const std::vector<Vector3> middles = middles_of(loops);
        std::vector<Means> means(edges_.size());
        for (int k = 0; k < size(); ++k) add(edges_[k], middles[loops.root(k)], means[parts.root(k)]);
        if (std::none_of(means.begin(), means.end(), may_be_wall)) return {};
        std::vector<char> held(place_.size(), 0);
        for (int v : rim_.vertices) held[v] = 1;
        Walls result{{}, closing_surface(mesh_.points, mesh_.whole, held)};
        for (int k = 0; k < size(); ++k) means[parts.root(k)].film += turn(edges_[k], result.film);
        std::vector<char> marks(edges_.size(), 0);
        for (int k = 0; k < size(); ++k) marks[k] = is_wall(means[parts.root(k)]) ? 1 : 0;
        UnionFind rows = joined([](int) { return true; }, marks);
        const std::vector<double> of_loops = lengths_of(loops);
        const std::vector<double> of_rows = lengths_of(rows);
        for (int k = 0; k < size(); ++k) {
            const bool is_long = of_rows[rows.root(k)] > shortest_row * of_loops[loops.root(k)];
            if (marks[k] != 0 && is_long) result.edges.push_back(edges_[k].ends);
        }
        return result;
    }

private:
    [[nodiscard]] int size() const { return static_cast<int>(edges_.size()); }

    // Edges that meet at vertices that join them; all edges, or those that are marked.
    template <typename Joins>
    [[nodiscard]] UnionFind joined(const Joins& joins, const std::vector<char>& marks = {}) const {
        std::map<int, int> at_vertex;
        UnionFind sets(size());
        for (int k = 0; k < size(); ++k) {
            if (!marks.empty() && marks[k] == 0) continue;
            for (int v : edges_[k].ends) {
                const auto [place, is_first] = at_vertex.try_emplace(v, k);
                if (!is_first && joins(v)) sets.join(place->second, k);
            }
        }
        return sets;
    }

    [[nodiscard]] Vector3 between(const Meeting& edge) const {
        return mesh_.points.col(edge.ends[1]) - mesh_.points.col(edge.ends[0]);
    }
    [[nodiscard]] Vector3 middle(const Meeting& edge) const {
        return mesh_.points(Eigen::all, edge.ends).rowwise().mean();
    }

    // Of each set of edges, at its root.
    [[nodiscard]] std::vector<double> lengths_of(UnionFind& sets) const {
        std::vector<double> lengths(edges_.size(), 0.0);
        for (int k = 0; k < size(); ++k) lengths[sets.root(k)] += between(edges_[k]).norm();
        return lengths;
    }

    // Likewise.
    [[nodiscard]] std::vector<Vector3> middles_of(UnionFind& loops) const {
        std::vector<Vector3> middles(edges_.size(), Vector3::Zero());
        const std::vector<double> lengths = lengths_of(loops);
        for (int k = 0; k < size(); ++k) {
            const int loop = loops.root(k);
            middles[loop] += between(edges_[k]).norm() / lengths[loop] * middle(edges_[k]);
        }
        return middles;
    }

    // Not where hard edges end, as a fit there sees both of their sides, nor where it knows little.
    [[nodiscard]] const SlopeFit* fit_at(int v) const {
        constexpr double most_uncertain = 0.1;  // radians
        if (parts_[v] != 0 || place_[v] == none) return nullptr;
        const auto& fit = rim_.fits[place_[v]];
        return fit && fit->error < most_uncertain ? &*fit : nullptr;
    }

    // 1, or -1 where the triangles outside are wound against those inside.
    [[nodiscard]] double winding(const Meeting& edge) const {
        return side_tail(mesh_.inside, edge.inside) == side_tail(mesh_.outside, edge.outside) ? -1.0 : 1.0;
    }

    // Along the edge, with the patch on its left.
    [[nodiscard]] Vector3 along(const Meeting& edge) const {
        const bool turned = side_tail(mesh_.inside, edge.inside) != edge.ends[0];
        return (turned ? -1.0 : 1.0) * direction(between(edge));
    }

    // Of the surroundings at the edge, wound as the patch.
    [[nodiscard]] Vector3 normal_at(const Meeting& edge) const {
        Vector3 sum = Vector3::Zero();
        for (int v : edge.ends) {
            if (const SlopeFit* fit = fit_at(v)) sum += fit->normal;
        }
        if (sum.isZero()) sum = normal_of(mesh_.points, mesh_.outside, edge.outside);
        const Vector3 t = along(edge);
        return winding(edge) * direction(sum - sum.dot(t) * t);
    }

    // Cosine and sine of the angle of the patch's triangle with these points, times the edge's length.
    [[nodiscard]] Eigen::Vector2d turn(const Meeting& edge, const Points& points) const {
        const Vector3 t = along(edge);
        const Vector3 normal = normal_at(edge);
        const Vector3 inwards = normal_of(points, mesh_.inside, edge.inside).cross(t);
        return between(edge).norm() * Eigen::Vector2d(inwards.dot(normal.cross(t)), -inwards.dot(normal));
    }

    void add(const Meeting& edge, const Vector3& loop_middle, Means& means) const {
        const double length = between(edge).norm();
        const Vector3 t = along(edge);
        const Vector3 onwards = normal_at(edge).cross(t);
        const Vector3 reach = loop_middle - middle(edge);
        double curvature = 0.0;
        int count = 0;
        for (int v : edge.ends) {
            const SlopeFit* fit = fit_at(v);
            if (!fit) continue;
            curvature -= winding(edge) * onwards.dot(fit->bending * onwards);
            ++count;
        }
        means.patch += turn(edge, mesh_.points);
        means.bend += length * curvature / std::max(count, 1) * (reach - reach.dot(t) * t).norm();
        means.length += length;
    }

    const PatchInMesh& mesh_;
    const RimFits& rim_;
    std::vector<Meeting> edges_;
    Indices place_;            // of each vertex in rim_.vertices
    std::vector<char> parts_;  // vertices at which a hard edge outside ends
};

}  // namespace

VertexPairs outline_edges(const PatchInMesh& mesh) {
    VertexPairs result;
    for (const Meeting& edge : meetings(mesh)) result.push_back(edge.ends);
    return result;
}

Walls walls_of(const PatchInMesh& mesh, const RimFits& rim) { return Rim(mesh, rim).walls(); }

}  // namespace fairing
