#include "texture/graded_mesh.h"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>

#include "base/progress.h"
#include "mesh/edges.h"

namespace fairing {

namespace {

// Of a boundary value's waves as long as an edge exp(−8 π) are left at the distance where edges have that length.
constexpr double growth = 0.25;

// Of each vertex to the chosen sides, along edges; infinite where none leads there.
std::vector<double> distances(const GradedMesh& mesh, const EdgeTable& edges, const std::vector<double>& lengths) {
    const int count = static_cast<int>(mesh.points.cols());
    std::vector<double> found(count, std::numeric_limits<double>::infinity());
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    for (int side = 0; side < static_cast<int>(3 * mesh.triangles.cols()); ++side) {
        if (!mesh.chosen(side % 3, side / 3)) continue;
        for (const int v : {side_tail(mesh.triangles, side), side_head(mesh.triangles, side)}) {
            if (found[v] != 0.0) queue.emplace(0.0, v);
            found[v] = 0.0;
        }
    }
    Indices begin(count + 1, 0);
    for (const auto& ends : edges.ends) {
        ++begin[ends[0] + 1];
        ++begin[ends[1] + 1];
    }
    for (int v = 0; v < count; ++v) begin[v + 1] += begin[v];
    Indices around(begin[count]);
    Indices next(begin.begin(), begin.end() - 1);
    for (int e = 0; e < edges.size(); ++e) {
        for (const int v : edges.ends[e]) around[next[v]++] = e;
    }
    while (!queue.empty()) {
        const auto [distance, v] = queue.top();
        queue.pop();
        if (distance > found[v]) continue;
        for (int k = begin[v]; k < begin[v + 1]; ++k) {
            const int e = around[k];
            const int other = edges.ends[e][0] + edges.ends[e][1] - v;
            if (distance + lengths[e] >= found[other]) continue;
            found[other] = distance + lengths[e];
            queue.emplace(found[other], other);
        }
    }
    return found;
}

// The new vertex in the middle of each edge; `none` for those that are short enough.
Indices halved_edges(GradedMesh& mesh, const EdgeTable& edges, double finest) {
    std::vector<double> lengths(edges.size());
    for (int e = 0; e < edges.size(); ++e) {
        checkpoint(e);
        lengths[e] = (mesh.points.col(edges.ends[e][0]) - mesh.points.col(edges.ends[e][1])).norm();
    }
    const std::vector<double> away = distances(mesh, edges, lengths);
    Indices middles(edges.size(), none);
    const int before = static_cast<int>(mesh.points.cols());
    int count = before;
    for (int e = 0; e < edges.size(); ++e) {
        const double distance = std::min(away[edges.ends[e][0]], away[edges.ends[e][1]]) + 0.5 * lengths[e];
        if (lengths[e] > finest && lengths[e] > growth * distance) middles[e] = count++;
    }
    mesh.points.conservativeResize(3, count);
    for (int e = 0; e < edges.size(); ++e) {
        if (middles[e] != none)
            mesh.points.col(middles[e]) = 0.5 * (mesh.points.col(edges.ends[e][0]) + mesh.points.col(edges.ends[e][1]));
    }
    return middles;
}

// One triangle in pieces. Nodes 0 to 2 are its corners, node 3 + k is the middle of side k.
class Pieces {
public:
    Pieces(const GradedMesh& mesh, int triangle, const std::array<int, 3>& middles) : mesh_(mesh), triangle_(triangle) {
        for (int k = 0; k < 3; ++k) {
            vertices_[k] = mesh.triangles(k, triangle);
            vertices_[3 + k] = middles[k];
            weights_.col(k) = mesh.weights.col(3 * triangle + k);
        }
        for (int k = 0; k < 3; ++k) weights_.col(3 + k) = 0.5 * (weights_.col(k) + weights_.col((k + 1) % 3));
    }

    [[nodiscard]] std::vector<std::array<int, 3>> nodes() const {
        const int marked = static_cast<int>(std::count_if(vertices_.begin() + 3, vertices_.end(), is_there));
        if (marked == 0) return {{0, 1, 2}};
        if (marked == 3) return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
        int k = 0;  // the only side that is halved; or the first of two, the other one being next
        while (vertices_[3 + k] == none || (marked == 2 && vertices_[3 + (k + 1) % 3] == none)) ++k;
        const int b = (k + 1) % 3;
        const int c = (k + 2) % 3;
        if (marked == 1) return {{k, 3 + k, c}, {3 + k, b, c}};
        if (distance(k, 3 + b) <= distance(3 + k, c)) return {{3 + k, b, 3 + b}, {k, 3 + k, 3 + b}, {k, 3 + b, c}};
        return {{3 + k, b, 3 + b}, {k, 3 + k, c}, {3 + k, 3 + b, c}};
    }

    void write(const std::array<int, 3>& nodes, int to, GradedMesh& result) const {
        result.parent[to] = mesh_.parent[triangle_];
        for (int k = 0; k < 3; ++k) {
            result.triangles(k, to) = vertices_[nodes[k]];
            result.weights.col(3 * to + k) = weights_.col(nodes[k]);
            result.chosen(k, to) = is_chosen(nodes[k], nodes[(k + 1) % 3]);
        }
    }

private:
    static bool is_there(int vertex) { return vertex != none; }
    [[nodiscard]] double distance(int i, int j) const {
        return (mesh_.points.col(vertices_[i]) - mesh_.points.col(vertices_[j])).norm();
    }
    // Whether the line between two nodes lies on a chosen side.
    [[nodiscard]] bool is_chosen(int i, int j) const {
        for (int k = 0; k < 3; ++k) {
            const auto on = [k](int node) { return node == k || node == (k + 1) % 3 || node == 3 + k; };
            if (on(i) && on(j)) return mesh_.chosen(k, triangle_);
        }
        return false;
    }

    const GradedMesh& mesh_;
    int triangle_;
    std::array<int, 6> vertices_{};
    Eigen::Matrix<double, 3, 6> weights_;
};

GradedMesh halved(const GradedMesh& mesh, const EdgeTable& edges, const Indices& middles) {
    std::vector<std::array<int, 4>> pieces;  // the triangle, and the nodes of each piece
    std::vector<Pieces> of;
    for (int t = 0; t < static_cast<int>(mesh.triangles.cols()); ++t) {
        checkpoint(t);
        std::array<int, 3> own{};
        for (int k = 0; k < 3; ++k) own[k] = middles[edges.edge_of_side[3 * t + k]];
        of.emplace_back(mesh, t, own);
        for (const auto& nodes : of.back().nodes()) pieces.push_back({t, nodes[0], nodes[1], nodes[2]});
    }
    const auto count = static_cast<Eigen::Index>(pieces.size());
    GradedMesh result{mesh.points, Triangles(3, count), Indices(pieces.size()), Points(3, 3 * count),
                      ChosenSides(3, count)};
    for (int piece = 0; piece < static_cast<int>(count); ++piece) {
        const auto& [t, a, b, c] = pieces[piece];
        of[t].write({a, b, c}, piece, result);
    }
    return result;
}

}  // namespace

GradedMesh graded_mesh(const Points& points, const Triangles& triangles, const ChosenSides& chosen, double finest) {
    GradedMesh mesh{points, triangles, Indices(triangles.cols()), Points(3, 3 * triangles.cols()), chosen};
    for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) {
        mesh.parent[t] = t;
        mesh.weights.middleCols(3 * t, 3).setIdentity();
    }
    while (true) {
        const EdgeTable edges = make_edges(mesh.triangles, static_cast<int>(mesh.points.cols()));
        const Eigen::Index before = mesh.points.cols();
        const Indices middles = halved_edges(mesh, edges, finest);
        if (mesh.points.cols() == before) return mesh;
        mesh = halved(mesh, edges, middles);
    }
}

}  // namespace fairing
