#include "fill/wire_network.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <set>

#include "base/errors.h"
#include "fill/loop_sides.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

using Neighbours = std::map<int, Indices>;

constexpr double direction_reach = 0.1;  // of an arc: one crooked edge at a node does not decide its direction there
constexpr double least_gap = std::numbers::pi / 36.0;  // nearer arcs lie on each other, or on different sheets
constexpr double clear_sides = 0.5;  // cosine by which a normal, carried along an arc, says how the other end's lies

Neighbours neighbours_of(const VertexPairs& edges) {
    Neighbours joined;
    for (const auto& [a, b] : edges) {
        joined[a].push_back(b);
        joined[b].push_back(a);
    }
    Indices ends;
    for (const auto& [v, others] : joined)
        if (others.size() == 1) ends.push_back(v);
    if (!ends.empty())
        refuse_wires(Code::wires_end, "wires end at " + listed(ends) + ": join each end to another wire, or remove it",
                     ends);
    return joined;
}

// From node to node, or around a loop without nodes.
std::vector<Indices> arcs_of(const Neighbours& joined) {
    std::vector<Indices> found;
    std::set<std::pair<int, int>> seen;
    const auto follow = [&](int begin) {
        for (const int first : joined.at(begin)) {
            if (seen.contains({begin, first})) continue;
            Indices path{begin, first};
            while (joined.at(path.back()).size() == 2 && path.back() != begin) {
                const Indices& both = joined.at(path.back());
                path.push_back(both[0] == path[path.size() - 2] ? both[1] : both[0]);
            }
            for (std::size_t k = 1; k < path.size(); ++k) {
                seen.emplace(path[k - 1], path[k]);
                seen.emplace(path[k], path[k - 1]);
            }
            found.push_back(path);
        }
    };
    for (const auto& [v, others] : joined)
        if (others.size() > 2) follow(v);
    for (const auto& [v, others] : joined) follow(v);
    return found;
}

Vector3 direction_along(const View<Points>& points, const Indices& path) {
    std::vector<double> along(1, 0.0);
    for (std::size_t k = 1; k < path.size(); ++k)
        along.push_back(along.back() + (points.col(path[k]) - points.col(path[k - 1])).norm());
    const auto beyond = std::ranges::upper_bound(along, direction_reach * along.back());
    const auto at = std::max<std::ptrdiff_t>(1, beyond - along.begin() - 1);
    return (points.col(path[static_cast<std::size_t>(at)]) - points.col(path[0])).normalized();
}

// Turns the normals so that those which arcs join agree: the clearest arcs first.
void turn_to_one_side(WireNetwork& network, const View<Points>& points) {
    std::vector<double> agreement;
    for (int k = 0; k < static_cast<int>(network.arcs.size()); ++k) {
        const Points here = carried(network.from(2 * k).normal, points, network.path(2 * k));
        const Points there = carried(network.from(2 * k + 1).normal, points, network.path(2 * k + 1));
        agreement.push_back(here.rightCols<1>().col(0).dot(there.col(0)));
    }
    Indices order(agreement.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater<>(), [&](int k) { return std::abs(agreement[k]); });
    UnionFind sides(static_cast<int>(points.cols()));
    for (const int k : order) {
        Indices where = network.arcs[k];
        const bool agree = sides.join(where.front(), where.back(), agreement[k] < 0.0);
        if (agree || std::abs(agreement[k]) <= clear_sides) continue;
        std::ranges::sort(where);
        where.erase(std::ranges::unique(where).begin(), where.end());
        refuse_wires(Code::unclear_cells,
                     "a surface along the wire at " + listed(where) + " would be a Möbius strip: remove it", where,
                     "one_sided");
    }
    for (auto& [v, node] : network.nodes)
        if (sides.find(v).second) node.normal = -node.normal;
}

// Counter-clockwise about the normal.
void put_in_order(int vertex, WireNode& node, const Points& directions) {
    const Points flat = directions - node.normal * (node.normal.transpose() * directions);
    Eigen::Index longest = 0;
    flat.colwise().norm().maxCoeff(&longest);
    const Vector3 x = flat.col(longest).normalized();
    const Vector3 y = node.normal.cross(x);
    std::vector<std::pair<double, int>> by_angle;
    for (std::size_t k = 0; k < node.darts.size(); ++k) {
        const Vector3 tangent = flat.col(static_cast<Eigen::Index>(k));
        by_angle.emplace_back(std::atan2(tangent.dot(y), tangent.dot(x)), node.darts[k]);
    }
    std::ranges::sort(by_angle);
    node.darts.clear();
    double before = by_angle.back().first - 2.0 * std::numbers::pi;
    for (const auto& [angle, dart] : by_angle) {
        if (angle - before < least_gap)
            refuse_wires(Code::unclear_cells,
                         "wires overlap at " + listed({vertex}) +
                             ", so that their order is unclear: move them apart, or remove one",
                         {vertex});
        before = angle;
        node.darts.push_back(dart);
        node.angles.push_back(angle);
    }
}

WireNetwork network_of(std::vector<Indices> arcs, const View<Points>& points) {
    WireNetwork network{std::move(arcs), {}};
    const auto count = 2 * static_cast<int>(network.arcs.size());
    Points directions(3, count);
    for (int dart = 0; dart < count; ++dart) {
        const Indices path = network.path(dart);
        directions.col(dart) = direction_along(points, path);
        network.nodes[path[0]].darts.push_back(dart);
    }
    for (auto& [v, node] : network.nodes) node.normal = nearest_plane(directions(Eigen::all, node.darts));
    turn_to_one_side(network, points);
    for (auto& [v, node] : network.nodes) put_in_order(v, node, directions(Eigen::all, node.darts));
    return network;
}

}  // namespace

Indices WireNetwork::path(int dart) const {
    const Indices& arc = arcs[dart / 2];
    return dart % 2 == 0 ? arc : Indices(arc.rbegin(), arc.rend());
}

const WireNode& WireNetwork::from(int dart) const {
    const Indices& arc = arcs[dart / 2];
    return nodes.at(dart % 2 == 0 ? arc.front() : arc.back());
}

Wires parted_wires(const VertexPairs& edges, const View<Points>& points) {
    const Neighbours joined = neighbours_of(edges);
    UnionFind sets(static_cast<int>(points.cols()));
    for (const auto& [a, b] : edges) sets.join(a, b);
    Wires result;
    std::map<int, std::vector<Indices>> between;
    for (Indices& arc : arcs_of(joined)) {
        const bool is_loop = joined.at(arc[0]).size() == 2;
        if (is_loop) arc.pop_back();
        (is_loop ? result.loops : between[sets.root(arc[0])]).push_back(std::move(arc));
    }
    for (auto& [first, arcs] : between) result.networks.push_back(network_of(std::move(arcs), points));
    return result;
}

Points carried(const Vector3& normal, const View<Points>& points, const Indices& path) {
    constexpr double straight = 1e-9;  // sine of the angle to an edge below which a normal says nothing
    Points found(3, static_cast<Eigen::Index>(path.size()) - 1);
    Vector3 here = normal;
    for (Eigen::Index k = 0; k < found.cols(); ++k) {
        const Vector3 tangent = (points.col(path[k + 1]) - points.col(path[k])).normalized();
        const Vector3 across = here - here.dot(tangent) * tangent;
        if (across.norm() > straight) here = across.normalized();
        found.col(k) = here;
    }
    return found;
}

Vector3 nearest_plane(const Points& columns) {
    const Points around = columns.colwise() - columns.rowwise().mean();
    const Vector3 normal = Eigen::JacobiSVD<Eigen::Matrix3Xd>(around, Eigen::ComputeFullU).matrixU().col(2);
    Eigen::Index largest = 0;
    normal.cwiseAbs().maxCoeff(&largest);
    return normal[largest] < 0.0 ? Vector3(-normal) : normal;
}

void refuse_wires(Code code, const std::string& text, const Indices& where, const char* which) {
    Figures figures{{"vertices", size_of(where)}};
    if (*which != '\0') figures[which] = 1.0;
    throw MeshError({code, text, where, ElementKind::vertex, figures});
}

}  // namespace fairing
