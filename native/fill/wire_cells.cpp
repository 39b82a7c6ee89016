#include "fill/wire_cells.h"

#include <Eigen/Geometry>
#include <set>

#include "base/columns.h"
#include "fill/loop_sides.h"
#include "geometry/segments.h"
#include "mesh/edges.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

constexpr double pi = std::numbers::pi;  // half a turn, in radians
// By how much a cell's boundary turns to the left within the surface, at least. By Gauss and Bonnet it is 2π − ∫K: 2π
// if it is flat, π in each quarter of a sphere, and 0 around a half sphere, at the end of a tube or at the rim of a
// hull, where the wires go around an opening; −2π around the outside of a sheet.
constexpr double least_turn = 0.5 * pi;
constexpr double most_outside = -pi;             // the boundary of a sheet turns by less: no opening on its other side
constexpr double straight = pi * 150.0 / 180.0;  // corners from which on other wires end at the boundary

// What lies on the left of some darts, one after the other.
class Face {
public:
    Face(const WireNetwork& network, const View<Points>& points, Indices darts)
        : network_(&network), points_(&points), darts_(std::move(darts)) {}

    [[nodiscard]] const Indices& darts() const { return darts_; }

    [[nodiscard]] Indices loop() const {
        Indices found;
        for (const int dart : darts_) {
            const Indices path = network_->path(dart);
            found.insert(found.end(), path.begin(), path.end() - 1);
        }
        return found;
    }

    [[nodiscard]] Vector3 normal() const {
        constexpr double least = 1e-6;  // of a sum of unit normals: they cancel
        Vector3 sum = Vector3::Zero();
        for (const int dart : darts_) sum += network_->from(dart).normal;
        return sum.norm() > least ? Vector3(sum.normalized()) : network_->from(darts_[0]).normal;
    }

    // Whether a surface is wanted there: around an opening most wires end, or it lies outside.
    [[nodiscard]] bool is_cell() const {
        const std::vector<double> angles = corners();
        const auto turning = std::ranges::count_if(angles, [](double angle) { return angle < straight; });
        return 2 * turning > static_cast<std::ptrdiff_t>(angles.size()) && turn() > least_turn;
    }

    // By how much the boundary turns to the left within the surface, corners included.
    [[nodiscard]] double turn() const {
        double sum = 0.0;
        for (const int dart : darts_) sum += turn_along(dart);
        for (const double angle : corners()) sum += pi - angle;
        return sum;
    }

    // The direction in which most of the normals look, seen from there.
    [[nodiscard]] double volume(const Vector3& middle) const {
        double sum = 0.0;
        for (const int dart : darts_)
            sum += network_->from(dart).normal.dot(points_->col(network_->path(dart)[0]) - middle);
        return sum;
    }

private:
    // Angles within the face at the end of each dart, above 0.
    [[nodiscard]] std::vector<double> corners() const {
        std::vector<double> found;
        for (std::size_t k = 0; k < darts_.size(); ++k) {
            const WireNode& node = network_->from(opposite(darts_[k]));
            const auto angle = [&](int dart) {
                return node.angles[static_cast<std::size_t>(std::ranges::find(node.darts, dart) - node.darts.begin())];
            };
            const double corner = angle(opposite(darts_[k])) - angle(darts_[(k + 1) % darts_.size()]);
            found.push_back(corner > 0.0 ? corner : corner + 2.0 * pi);
        }
        return found;
    }

    // The normals along an arc pass from those at one end to those at the other.
    [[nodiscard]] double turn_along(int dart) const {
        const Indices path = network_->path(dart);
        const Points here = carried(network_->from(dart).normal, *points_, path);
        const Points there =
            carried(network_->from(opposite(dart)).normal, *points_, Indices(path.rbegin(), path.rend()));
        const auto count = here.cols();
        const auto normal = [&](Eigen::Index k) -> Vector3 {
            const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
            return (1.0 - share) * here.col(k) + share * there.col(count - 1 - k);
        };
        double sum = 0.0;
        for (Eigen::Index k = 1; k < count; ++k) {
            const Vector3 before = (points_->col(path[k]) - points_->col(path[k - 1])).normalized();
            const Vector3 after = (points_->col(path[k + 1]) - points_->col(path[k])).normalized();
            const Vector3 at = (normal(k) + normal(k - 1)).normalized();
            sum += std::atan2(before.cross(after).dot(at), before.dot(after));
        }
        return sum;
    }

    const WireNetwork* network_;
    const View<Points>* points_;
    Indices darts_;
};

// At a node the next dart clockwise leads on.
std::vector<Face> faces_of(const WireNetwork& network, const View<Points>& points) {
    Indices after(2 * network.arcs.size(), none);
    for (const auto& [v, node] : network.nodes)
        for (std::size_t k = 0; k < node.darts.size(); ++k)
            after[opposite(node.darts[k])] = node.darts[(k + node.darts.size() - 1) % node.darts.size()];
    std::vector<Face> faces;
    std::vector<char> seen(after.size(), 0);
    for (int begin = 0; begin < static_cast<int>(after.size()); ++begin) {
        Indices darts;
        for (int dart = begin; seen[dart] == 0; dart = after[dart]) {
            seen[dart] = 1;
            darts.push_back(dart);
        }
        if (!darts.empty()) faces.emplace_back(network, points, std::move(darts));
    }
    return faces;
}

// Throws NO_CELL where both darts of an arc are among these.
void refuse_both_sides(const WireNetwork& network, const Indices& darts, const char* text, const char* which) {
    std::set<int> vertices;
    for (const int dart : darts)
        if (std::ranges::find(darts, opposite(dart)) != darts.end())
            vertices.insert(network.arcs[dart / 2].begin(), network.arcs[dart / 2].end());
    const Indices where(vertices.begin(), vertices.end());
    if (!where.empty()) refuse_wires(Code::no_cell, "the wires at " + listed(where) + text, where, which);
}

void refuse_pinched(const Indices& loop) {
    std::set<int> once;
    std::set<int> twice;
    for (const int v : loop)
        if (!once.insert(v).second) twice.insert(v);
    const Indices where(twice.begin(), twice.end());
    if (!where.empty())
        refuse_wires(Code::no_cell, "an area touches " + listed(where) + " twice: add a wire that divides it", where,
                     "pinched");
}

Vector3 middle_of(const WireNetwork& network, const View<Points>& points) {
    std::set<int> used;
    for (const Indices& arc : network.arcs) used.insert(arc.begin(), arc.end());
    return points(Eigen::all, Indices(used.begin(), used.end())).rowwise().mean();
}

// Direction of a polygon's vector area, or normal of the plane nearest to it where it has none.
Vector3 normal_of_loop(const View<Points>& points, const Indices& loop) {
    constexpr double least = 1e-6;  // of the sum of squares: there is no area
    const Points corners = points(Eigen::all, loop);
    const Points around = corners.colwise() - corners.rowwise().mean();
    Vector3 area = Vector3::Zero();
    for (Eigen::Index k = 0; k < around.cols(); ++k) {
        const Vector3 next = around.col((k + 1) % around.cols());
        area += around.col(k).cross(next);
    }
    return area.norm() < least * around.squaredNorm() ? nearest_plane(corners) : Vector3(area.normalized());
}

void add_cells(WireCells& cells, std::vector<Vector3>& normals, const WireNetwork& network, const View<Points>& points,
               bool closed) {
    const std::vector<Face> faces = faces_of(network, points);
    for (const Face& face : faces)
        refuse_both_sides(network, face.darts(),
                          " have the same area on both sides: remove them, or add wires that divide it", "both_sides");
    std::vector<const Face*> filled;
    std::vector<const Face*> lids;
    std::vector<const Face*> outside;
    for (const Face& face : faces)
        (face.is_cell() ? filled : closed && face.turn() > most_outside ? lids : outside).push_back(&face);
    Indices loose;
    for (const Face* face : outside) loose.insert(loose.end(), face->darts().begin(), face->darts().end());
    refuse_both_sides(network, loose, " bound only openings: add wires across these, or pass `closed=True`",
                      "openings");
    const Vector3 middle = middle_of(network, points);
    double volume = 0.0;
    for (const Face* face : filled) volume += face->volume(middle);
    for (const Face* face : lids) {
        const VertexPairs edges = edges_around(face->loop());
        cells.rims.insert(cells.rims.end(), edges.begin(), edges.end());
    }
    filled.insert(filled.end(), lids.begin(), lids.end());
    for (const Face* face : filled) {
        Indices loop = face->loop();
        if (volume < 0.0) std::ranges::reverse(loop);
        refuse_pinched(loop);
        cells.loops.push_back(std::move(loop));
        normals.push_back(volume < 0.0 ? Vector3(-face->normal()) : face->normal());
    }
    for (const Face* face : outside) cells.left_open.push_back(face->loop());
}

}  // namespace

WireCells cells_of(const VertexPairs& wires, const View<Points>& points, bool closed) {
    Wires parts = parted_wires(wires, points);
    WireCells cells{std::move(parts.loops), {}, {}, {}};
    std::vector<Vector3> normals;
    normals.reserve(cells.loops.size());
    for (const Indices& loop : cells.loops) normals.push_back(normal_of_loop(points, loop));
    for (const WireNetwork& network : parts.networks) add_cells(cells, normals, network, points, closed);
    cells.normals = as_columns(normals);
    return cells;
}

Indices cells_of_triangles(const Triangles& triangles, const std::vector<Indices>& loops, int vertex_count) {
    std::map<std::array<int, 2>, int> along;
    for (std::size_t k = 0; k < loops.size(); ++k)
        for (const auto& side : edges_around(loops[k])) along.emplace(side, static_cast<int>(k));
    const EdgeTable edges = make_edges(triangles, vertex_count);
    UnionFind pieces(static_cast<int>(triangles.cols()));
    for (int e = 0; e < edges.size(); ++e) {
        const auto& [a, b] = edges.ends[e];
        if (edges.side_count(e) == 2 && !along.contains({a, b}) && !along.contains({b, a}))
            pieces.join(edges.side(e, 0) / 3, edges.side(e, 1) / 3);
    }
    Indices of_piece(static_cast<std::size_t>(triangles.cols()), none);
    for (int side = 0; side < static_cast<int>(triangles.size()); ++side) {
        const auto found = along.find({side_tail(triangles, side), side_head(triangles, side)});
        if (found != along.end()) of_piece[pieces.root(side / 3)] = found->second;
    }
    Indices result(of_piece.size());
    for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) result[t] = of_piece[pieces.root(t)];
    return result;
}

}  // namespace fairing
