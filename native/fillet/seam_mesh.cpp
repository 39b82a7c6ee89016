#include "fillet/seam_mesh.h"

#include <Eigen/Geometry>

namespace fairing {

namespace {

VertexPair sorted_pair(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

SeamMesh::SeamMesh(const Points& given_points, const Triangles& given_triangles, const std::vector<VertexPair>& seams,
                   const std::vector<VertexPair>& walls)
    : points(given_points), triangles(given_triangles) {
    const EdgeTable table = make_edges(triangles, static_cast<int>(points.cols()));
    pair_up(table, walls);
    mark(table, seams);
    measure();
    number_sheets();
}

void SeamMesh::pair_up(const EdgeTable& table, const std::vector<VertexPair>& walls) {
    edge = table.edge_of_side;
    twin.assign(edge.size(), none);
    std::vector<VertexPair> closed = walls;
    for (VertexPair& pair : closed) pair = sorted_pair(pair[0], pair[1]);
    std::sort(closed.begin(), closed.end());
    for (int e = 0; e < table.size(); ++e) {
        if (table.side_count(e) != 2 || std::binary_search(closed.begin(), closed.end(), table.ends[e])) continue;
        const int a = table.side(e, 0);
        const int b = table.side(e, 1);
        if (tail(a) == tail(b)) continue;  // wound against each other: no surface goes on there
        twin[a] = b;
        twin[b] = a;
    }
}

void SeamMesh::mark(const EdgeTable& table, const std::vector<VertexPair>& seams) {
    seam.assign(edge.size(), none);
    left.assign(edge.size(), 0);
    for (int s = 0; s < static_cast<int>(seams.size()); ++s) {
        const VertexPair wanted = sorted_pair(seams[s][0], seams[s][1]);
        const auto found = std::lower_bound(table.ends.begin(), table.ends.end(), wanted);
        if (found == table.ends.end() || *found != wanted) continue;
        const int e = static_cast<int>(found - table.ends.begin());
        if (table.side_count(e) != 2 || twin[table.side(e, 0)] == none) continue;
        for (const int h : {table.side(e, 0), table.side(e, 1)}) seam[h] = s;
    }
    redirect(seams);
}

void SeamMesh::redirect(const std::vector<VertexPair>& seams) {
    for (int h = 0; h < half_edge_count(); ++h) {
        if (seam[h] != none) left[h] = tail(h) == seams[seam[h]][0] ? 1 : 0;
    }
}

void SeamMesh::measure() {
    for (int h = 0; h < half_edge_count(); ++h) {
        const Vector3 along = points.col(head(h)) - points.col(tail(h));
        const Vector3 to_apex = points.col(tail(previous(h))) - points.col(tail(h));
        const double size = along.norm();
        const Vector3 x = size > 0.0 ? Vector3(along / size) : Vector3::Zero();
        const Vector3 above = to_apex - to_apex.dot(x) * x;
        length.push_back(size);
        apex.emplace_back(to_apex.dot(x), above.norm());
        opening.push_back(std::atan2(along.cross(to_apex).norm(), along.dot(to_apex)));
    }
}

// Corners that hang together across half-edges with a twin share a vertex.
void SeamMesh::number_sheets() {
    UnionFind corners(half_edge_count());
    for (int h = 0; h < half_edge_count(); ++h) {
        if (twin[h] != none) corners.join(h, next(twin[h]));
    }
    sheet.assign(edge.size(), none);
    for (int h = 0; h < half_edge_count(); ++h) {
        const int top = corners.root(h);
        if (sheet[top] == none) sheet[top] = sheet_count++;
        sheet[h] = sheet[top];
    }
}

UnionFind SeamMesh::parts() const {
    UnionFind found(static_cast<int>(triangles.cols()));
    for (int h = 0; h < half_edge_count(); ++h) {
        if (twin[h] != none && seam[h] == none) found.join(h / 3, twin[h] / 3);
    }
    return found;
}

Vector2 SeamMesh::in_frame(int h, const Vector3& weights) const {
    const int k = h % 3;
    return {weights[(k + 1) % 3] * length[h] + weights[(k + 2) % 3] * apex[h][0], weights[(k + 2) % 3] * apex[h][1]};
}

Vector3 SeamMesh::weights_at(int h, const Vector2& in_frame) const {
    const double up = apex[h][1] > 0.0 ? in_frame[1] / apex[h][1] : 0.0;
    const double along = (in_frame[0] - up * apex[h][0]) / length[h];
    return {1.0 - up - along, along, up};
}

Vector3 SeamMesh::place(int triangle, const Vector3& weights) const {
    return points.col(triangles(0, triangle)) * weights[0] + points.col(triangles(1, triangle)) * weights[1] +
           points.col(triangles(2, triangle)) * weights[2];
}

Vector3 barycentric(const Points& points, const Triangles& triangles, int triangle, const Vector3& place) {
    const Vector3 start = points.col(triangles(0, triangle));
    const Vector3 along = Vector3(points.col(triangles(1, triangle))) - start;
    const Vector3 to_apex = Vector3(points.col(triangles(2, triangle))) - start;
    const double length = along.norm();
    if (!(length > 0.0)) return Vector3::Constant(1.0 / 3.0);
    const Vector3 x = along / length;
    const Vector3 above = to_apex - to_apex.dot(x) * x;
    const double height = above.norm();
    const double apex = height > 0.0 ? (place - start).dot(above) / (height * height) : 0.0;
    const double head = ((place - start).dot(x) - apex * to_apex.dot(x)) / length;
    return {1.0 - apex - head, head, apex};
}

}  // namespace fairing
