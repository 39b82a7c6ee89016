#include "boundary/walls.h"

#include <map>

#include "base/columns.h"
#include "boundary/low_passed_boundary.h"
#include "geometry/dihedral_bands.h"
#include "geometry/triangle.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

Vector3 normal_of(const Points& points, const Triangles& triangles, int side) {
    return direction(area_vector(points, triangles.col(side / 3)));
}

// Means over a part of the boundary, by length. Angles lie across the edges, in degrees from the first row
// outside towards its back.
struct Means {
    Eigen::Vector2d patch = Eigen::Vector2d::Zero();  // cosine and sine of the angle of its own triangles
    Eigen::Vector2d film = Eigen::Vector2d::Zero();   // likewise; between loops the path to the next one
    Eigen::Vector2d rows = Eigen::Vector2d::Zero();   // likewise, of the arc that the first two rows outside lie on
    double rows_bend = 0.0;                           // its curvature times distance to the loop's middle
    Eigen::Vector2d cut = Eigen::Vector2d::Zero();    // likewise, of an arc over half of that distance
    double cut_bend = 0.0;                            // likewise, its curvature
    double cut_length = 0.0;                          // of the edges that have one
    Vector3 rulings = Vector3::Zero();                // of edges with a single row outside: its direction
    double length = 0.0;
    double least = fading_bend;  // degrees off the surroundings from which on it is a wall
};

double angle_of(const Eigen::Vector2d& sum) { return std::atan2(sum.y(), sum.x()) / degree; }

constexpr double flat = 1.0;          // degrees: the two triangles of a quad
constexpr double explained = 0.25;    // least share of the film's bend that curvature explains where there is no wall:
                                      // balls .8 to 1.1, boxes 0 to .05
constexpr double noise_margin = 3.0;  // as for hard edges: bends the other way come from noise
constexpr double parallel = 0.996;    // cosine: 5 degrees, the tilt of a draft; more is a ball's row
constexpr double rounder = 1.25;      // curvature times distance to the middle: balls have at most 1
constexpr double far_rounder = 3.0;   // times the sine of off_rows
// Share of a loop: real meshes have single wall-like edges everywhere.
constexpr double shortest_row = 0.125;

// Degrees between a direction and the continued cross-section outside.
double off_cut(const Means& part, const Eigen::Vector2d& sum) { return angle_of(sum) - angle_of(part.cut); }

bool may_be_wall(const Means& part) {
    return std::abs(off_cut(part, part.patch)) > fading_bend || part.rows_bend > rounder * part.length;
}

// Whether the arc through the first two rows curves more than any ball, and the film continues it.
bool is_bevel(const Means& part) {
    const double off_rows = std::abs(angle_of(part.film) - angle_of(part.rows));
    const double least = std::max(rounder, far_rounder * std::sin(off_rows * degree));
    return part.rows_bend > least * part.length && off_rows < 0.5 * std::abs(off_cut(part, part.film));
}

bool is_wall(const Means& part) {
    const double film = off_cut(part, part.film);
    const double patch = off_cut(part, part.patch);
    const double dip = std::sin(film * degree);
    const double row = part.rulings.norm() < parallel * part.length ? dip : 0.0;
    const double bend = part.cut_length > 0.0 ? part.cut_bend / part.cut_length : row;
    const bool is_unexplained = bend * dip < explained * dip * dip;
    const bool bends_away = std::min(film, patch) > part.least;
    const bool bends_back = std::max(film, patch) < -part.least;
    return (is_unexplained && (bends_away || bends_back)) || is_bevel(part);
}

class Rim {
public:
    Rim(const PatchInMesh& mesh, const VertexPairs& hard)
        : mesh_(mesh),
          outside_(make_edges(mesh.outside, static_cast<int>(mesh.points.cols()))),
          edges_(meetings(make_edges(mesh.inside, static_cast<int>(mesh.points.cols())), outside_)),
          parts_(static_cast<std::size_t>(mesh.points.cols()), 0) {
        for (const auto& ends : hard) parts_[ends[0]] = parts_[ends[1]] = 1;
    }

    [[nodiscard]] Walls walls(const Indices& still) const {
        UnionFind loops = joined([](int) { return true; });
        UnionFind parts = joined([&](int v) { return parts_[v] == 0; });
        const std::vector<Vector3> middles = middles_of(loops);
        std::vector<Means> means(edges_.size());
        for (int k = 0; k < size(); ++k) add(edges_[k], middles[loops.root(k)], means[parts.root(k)]);
        if (std::none_of(means.begin(), means.end(), may_be_wall)) return {};
        std::vector<char> held(parts_.size(), 0);
        for (int v : still) held[v] = 1;
        Walls result{{}, closing_surface(mesh_.points, mesh_.whole, held)};
        const std::vector<Place> places = places_of(loops);
        for (int k = 0; k < size(); ++k)
            add_film(edges_[k], path_to_next_loop(places, k), result.film, means[parts.root(k)]);
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

    // Sets of edges, joined at vertices where `joins` is true; of the marked edges only, where marks are given.
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

    // For each set of edges, at its root.
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

    // 1, or -1 where the triangles outside are wound against those inside.
    [[nodiscard]] double winding(const Meeting& edge) const {
        return side_tail(mesh_.inside, edge.inside) == side_tail(mesh_.outside, edge.outside) ? -1.0 : 1.0;
    }

    // Along the edge, with the patch on its left.
    [[nodiscard]] Vector3 along(const Meeting& edge) const {
        const bool turned = side_tail(mesh_.inside, edge.inside) != edge.ends[0];
        return (turned ? -1.0 : 1.0) * direction(between(edge));
    }

    // The normal of the triangle outside, turned to the patch's winding.
    [[nodiscard]] Vector3 normal_at(const Meeting& edge) const {
        return winding(edge) * normal_of(mesh_.points, mesh_.outside, edge.outside);
    }

    // Cosine and sine of the angle of the patch's triangle with these points, times the edge's length.
    [[nodiscard]] Eigen::Vector2d turn(const Meeting& edge, const Points& points) const {
        return turn(edge, normal_of(points, mesh_.inside, edge.inside).cross(along(edge)));
    }

    // The same for a direction `inwards`, square to the edge.
    [[nodiscard]] Eigen::Vector2d turn(const Meeting& edge, const Vector3& inwards) const {
        const Vector3 normal = normal_at(edge);
        return between(edge).norm() * Eigen::Vector2d(inwards.dot(normal.cross(along(edge))), -inwards.dot(normal));
    }

    // A film between loops has a waist, also where a tube goes on: there the direction to the next loop says where it
    // goes.
    void add_film(const Meeting& edge, const std::optional<Vector3>& onward, const Points& film, Means& means) const {
        if (!onward) {
            means.film += turn(edge, film);
            return;
        }
        const Vector3 t = along(edge);
        means.film += turn(edge, direction(*onward - onward->dot(t) * t));
        means.least = hard_bend;
    }

    // Where an edge is: its loop, its piece of the patch, its middle.
    struct Place {
        int loop;
        int piece;
        Vector3 middle;
    };

    [[nodiscard]] std::vector<Place> places_of(UnionFind& loops) const {
        UnionFind pieces(static_cast<int>(parts_.size()));
        for (const auto& corners : mesh_.whole.colwise()) {
            for (int c : {1, 2}) pieces.join(corners[0], corners[c]);
        }
        std::vector<Place> places;
        places.reserve(edges_.size());
        for (int k = 0; k < size(); ++k)
            places.push_back({loops.root(k), pieces.root(edges_[k].ends[0]), middle(edges_[k])});
        return places;
    }

    // From the edge to the nearest one of another loop of its piece, if there is one.
    static std::optional<Vector3> path_to_next_loop(const std::vector<Place>& places, int k) {
        std::optional<Vector3> onward;
        for (const Place& other : places) {
            if (other.piece != places[k].piece || other.loop == places[k].loop) continue;
            const Vector3 there = other.middle - places[k].middle;
            if (!onward || there.squaredNorm() < onward->squaredNorm()) onward = there;
        }
        return onward;
    }

    // The cross-section of the surroundings from the edge's middle: crossed edges, and which of them end a row
    // (coplanar faces are one row). `near`: count of crossings up to the first beyond `reach` or at a hard edge.
    struct Cut {
        std::vector<Vector3> ends;
        std::vector<std::size_t> rows;
        std::size_t near = 0;
    };

    [[nodiscard]] Cut cut_beyond(const Meeting& edge, double reach) const {
        constexpr int most_faces = 40;  // two rows of quads have four, fans beside an undivided row many
        const Triangles& all = mesh_.outside;
        const Vector3 from = middle(edge);
        const Vector3 t = direction(between(edge));
        const auto height = [&](int v) { return t.dot(mesh_.points.col(v) - from); };
        double most_up = 0.0;
        double most_down = 0.0;
        Cut cut;
        for (int side = edge.outside, k = 0; k < most_faces; ++k) {
            const int corner = side % 3;
            const int tip = all((corner + 2) % 3, side / 3);
            const bool by_head = (height(tip) > 0.0) != (height(side_head(all, side)) > 0.0);
            const int exit = side - corner + (corner + (by_head ? 1 : 2)) % 3;
            const int e = outside_.edge_of_side[exit];
            if (outside_.side_count(e) != 2) break;
            const int other = outside_.side(e, outside_.side(e, 0) == exit ? 1 : 0);
            const int beyond = all((other % 3 + 2) % 3, other / 3);
            const double angle = dihedral_angle(normal_of(mesh_.points, all, exit), normal_of(mesh_.points, all, other),
                                                mesh_.points.col(side_tail(all, exit)), mesh_.points.col(beyond));
            const double bend = std::abs(angle);
            double& most = angle > 0.0 ? most_up : most_down;
            most = std::max(most, bend);
            const bool is_hard = bend - noise_margin * std::min(most_up, most_down) > hard_bend;
            const double a = height(side_tail(all, exit));
            const double b = height(side_head(all, exit));
            const Vector3 tail = mesh_.points.col(side_tail(all, exit));
            cut.ends.emplace_back(tail + a / (a - b) * (mesh_.points.col(side_head(all, exit)) - tail) - from);
            if (bend > flat) cut.rows.push_back(cut.ends.size() - 1);
            const bool is_far = cut.rows.size() > 1 && cut.ends.back().norm() > reach;
            if (cut.near == 0 && (is_hard || is_far)) cut.near = cut.ends.size();
            if (cut.near > 0 && cut.rows.size() > 1) break;
            side = other;
        }
        if (cut.near == 0) cut.near = cut.ends.size();
        return cut;
    }

    // Adds the arcs through the edge's middle and the crossings outside, seen along the edge.
    void add_rows(const Meeting& edge, double reach, Means& means) const {
        const Cut cut = cut_beyond(edge, 0.5 * reach);
        const Vector3 normal = normal_at(edge);
        const Vector3 onwards = normal.cross(along(edge));
        const auto plane = [&](std::size_t k) {
            return Eigen::Vector2d(onwards.dot(cut.ends[k]), -normal.dot(cut.ends[k]));
        };
        // Curvature, and where the arc goes on inside.
        const auto arc = [&](std::size_t near, std::size_t far) -> std::pair<double, Eigen::Vector2d> {
            const Eigen::Vector2d last = -plane(near);
            const Eigen::Vector2d first = -plane(far) - last;
            const double turn = first.x() * last.y() - first.y() * last.x();
            const double found = 2.0 * turn / (first.norm() * last.norm() * (first + last).norm());
            const double bend = std::isfinite(found) ? found : 0.0;
            const double rest = std::asin(std::clamp(0.5 * bend * last.norm(), -1.0, 1.0));
            return {bend, Eigen::Rotation2Dd(rest) * last.normalized()};
        };
        const double length = between(edge).norm();
        if (cut.near > 1) {
            const auto [bend, onward] = arc(cut.near / 2 - 1, cut.near - 1);
            means.cut += length * onward;
            means.cut_bend += length * reach * bend;
            means.cut_length += length;
        } else if (cut.near == 1) {
            means.rulings += length * direction(cut.ends[0]);
        }
        if (cut.rows.size() < 2) return;
        const auto [bend, onward] = arc(cut.rows[0], cut.rows[1]);
        means.rows += length * onward;
        means.rows_bend += length * bend * reach;
    }

    void add(const Meeting& edge, const Vector3& loop_middle, Means& means) const {
        const Vector3 t = along(edge);
        const Vector3 reach = loop_middle - middle(edge);
        means.patch += turn(edge, mesh_.points);
        add_rows(edge, (reach - reach.dot(t) * t).norm(), means);
        means.length += between(edge).norm();
    }

    const PatchInMesh& mesh_;
    EdgeTable outside_;
    std::vector<Meeting> edges_;
    std::vector<char> parts_;  // vertices at which a hard edge outside ends
};

}  // namespace

VertexPairs boundary_edges(const PatchInMesh& mesh) {
    VertexPairs result;
    const auto count = static_cast<int>(mesh.points.cols());
    for (const Meeting& edge : meetings(make_edges(mesh.inside, count), make_edges(mesh.outside, count)))
        result.push_back(edge.ends);
    return result;
}

Walls walls_of(const PatchInMesh& mesh, const Indices& still, const VertexPairs& hard) {
    return Rim(mesh, hard).walls(still);
}

}  // namespace fairing
