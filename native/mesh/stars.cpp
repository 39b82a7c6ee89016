#include "mesh/stars.h"

#include <algorithm>

namespace fairing {

namespace {

void sort_once(Indices& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

Stars::Stars(const Triangles& triangles, int vertex_count)
    : triangles_(triangles),
      begin_(static_cast<std::size_t>(vertex_count) + 1, 0),
      triangle_(static_cast<std::size_t>(triangles.size())) {
    for (const int v : triangles.reshaped()) ++begin_[v + 1];
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    Indices next(begin_.begin(), begin_.end() - 1);
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        for (const int v : triangles.col(t)) triangle_[next[v]++] = static_cast<int>(t);
    }
}

std::span<const int> Stars::at(int vertex) const {
    return std::span(triangle_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
}

Indices Stars::around(const Indices& vertices, int rings) const {
    Indices found;
    Indices reached = vertices;
    Indices front = vertices;
    for (int ring = 0; ring < rings && !front.empty(); ++ring) {
        sort_once(front);
        Indices near;
        for (const int v : front) near.insert(near.end(), at(v).begin(), at(v).end());
        sort_once(near);
        Indices corners;
        for (const int t : near) corners.insert(corners.end(), triangles_.col(t).begin(), triangles_.col(t).end());
        found.insert(found.end(), near.begin(), near.end());
        sort_once(corners);
        sort_once(reached);
        front.clear();
        std::set_difference(corners.begin(), corners.end(), reached.begin(), reached.end(), std::back_inserter(front));
        reached.insert(reached.end(), front.begin(), front.end());
    }
    sort_once(found);
    return found;
}

LocalMesh::LocalMesh(const Eigen::Ref<const Points>& mesh_points, const Triangles& mesh_triangles,
                     const Indices& chosen, const Indices& also)
    : triangles(mesh_triangles(Eigen::all, chosen)), to_mesh(also) {
    to_mesh.insert(to_mesh.end(), triangles.reshaped().begin(), triangles.reshaped().end());
    sort_once(to_mesh);
    points = mesh_points(Eigen::all, to_mesh);
    for (int& v : triangles.reshaped()) v = local(v);
}

int LocalMesh::local(int vertex) const {
    const auto found = std::lower_bound(to_mesh.begin(), to_mesh.end(), vertex);
    return found != to_mesh.end() && *found == vertex ? static_cast<int>(found - to_mesh.begin()) : none;
}

Indices LocalMesh::local(Indices vertices) const {
    for (int& v : vertices) v = local(v);
    return vertices;
}

std::vector<std::array<int, 2>> LocalMesh::local(const std::vector<std::array<int, 2>>& pairs) const {
    std::vector<std::array<int, 2>> found;
    for (const auto& [a, b] : pairs) {
        if (local(a) != none && local(b) != none) found.push_back({local(a), local(b)});
    }
    return found;
}

}  // namespace fairing
