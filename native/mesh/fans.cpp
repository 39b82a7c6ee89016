#include "mesh/fans.h"

#include "base/progress.h"

namespace fairing {

namespace {

// Corners around a vertex of the mesh, one after the other across its twins. Corner 3 t + k has side 3 t + k on
// one hand and side 3 t + (k + 2) % 3 on the other.
class FanWalk {
public:
    FanWalk(const Triangles& triangles, const Twins& twins) : triangles_(triangles), twins_(twins) {}

    // visit(corner) for the corners of a fan, from this one to either end, for as long as it returns true.
    template <typename Visit>
    void around(int corner, const Visit& visit) const {
        visit(corner);
        for (const int first : {corner, corner - corner % 3 + (corner + 2) % 3}) {
            for (int twin = twins_[first]; twin != none;) {
                const int triangle = twin - twin % 3;
                const bool starts_here = vertex(twin) == vertex(corner);
                const int next = starts_here ? twin : triangle + (twin + 1) % 3;
                if (!visit(next)) break;
                twin = twins_[starts_here ? triangle + (twin + 2) % 3 : next];
            }
        }
    }

private:
    [[nodiscard]] int vertex(int corner) const { return triangles_.data()[corner]; }

    const Triangles& triangles_;
    const Twins& twins_;
};

std::array<int, 3> sorted_fans(const Fans& fans, int triangle) {
    std::array<int, 3> result{};
    for (int k = 0; k < 3; ++k) result[k] = fans.of_corner[3 * triangle + k];
    std::sort(result.begin(), result.end());
    return result;
}

void sort_once(Indices& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

Fans join_corners(const Triangles& triangles, const Twins& twins) {
    Fans fans;
    const int corner_count = 3 * static_cast<int>(triangles.cols());
    fans.of_corner.assign(corner_count, none);
    const FanWalk walk(triangles, twins);
    for (int c = 0; c < corner_count; ++c) {
        checkpoint(c);
        if (fans.of_corner[c] != none) continue;
        const auto fan = static_cast<int>(fans.input_vertex.size());
        fans.input_vertex.push_back(triangles(c % 3, c / 3));
        walk.around(c, [&](int corner) {
            if (fans.of_corner[corner] != none) return false;
            fans.of_corner[corner] = fan;
            return true;
        });
    }
    return fans;
}

Indices doubled_triangles(const Triangles& triangles, const EdgeTable& edges, const Fans& fans) {
    // A pocket has an edge that joins it, since its corners are joined: the two sides of that one are looked at.
    Indices result;
    for (int e = 0; e < edges.size(); ++e) {
        checkpoint(e);
        if (edges.side_count(e) != 2) continue;
        const int a = edges.side(e, 0) / 3;
        const int b = edges.side(e, 1) / 3;
        if (triangles.col(a).sum() != triangles.col(b).sum() || sorted_fans(fans, a) != sorted_fans(fans, b)) continue;
        result.insert(result.end(), {a, b});
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

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
                     const Indices& chosen, const Indices& first)
    : triangles(mesh_triangles(Eigen::all, chosen)) {
    const auto number = [&](int vertex) {
        const auto [found, is_new] = numbers_.emplace(vertex, static_cast<int>(to_mesh.size()));
        if (is_new) to_mesh.push_back(vertex);
        return found->second;
    };
    for (const int v : first) number(v);
    for (int& v : triangles.reshaped()) v = number(v);
    points = mesh_points(Eigen::all, to_mesh);
}

int LocalMesh::local(int vertex) const {
    const auto found = numbers_.find(vertex);
    return found == numbers_.end() ? none : found->second;
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
