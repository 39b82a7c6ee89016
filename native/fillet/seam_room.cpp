#include "fillet/seam_room.h"

#include <map>

#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();  // no seam, no limit
constexpr double share = 0.2;                                         // of a side: what modellers begin with
constexpr double taken = 0.9;   // of the room: what is left of a face is wider than the new mesh's needles
constexpr double corner = 0.8;  // radians: where seams turn by more another piece begins

struct Way {
    double length;
    int end;  // the half-edge on a seam at which it comes out, or `none`
};

// From the middle of a half-edge straight on until the surface ends.
Way way_across(const SeamMesh& mesh, int h) {
    Vector2 from(0.5 * mesh.length[h], 0.0);
    Vector2 way = Vector2::UnitY();
    double length = 0.0;
    for (Eigen::Index crossed = 0; crossed < mesh.triangles.cols(); ++crossed) {
        const bool through_next = cross2(way, mesh.apex[h] - from) > 0.0;
        const int out = through_next ? SeamMesh::next(h) : SeamMesh::previous(h);
        const Vector2 tail = through_next ? Vector2(mesh.length[h], 0.0) : mesh.apex[h];
        const Vector2 head = through_next ? mesh.apex[h] : Vector2::Zero();
        const double speed = cross2(way, head - tail);
        if (!(speed > 0.0)) break;
        const double step = cross2(tail - from, head - tail) / speed;
        length += step;
        if (mesh.seam[out] != none) return {length, out};
        if (mesh.twin[out] == none) break;
        const Vector2 x = (tail - head).normalized();
        from = {(from + step * way - head).dot(x), 0.0};
        way = {way.dot(x), cross2(x, way)};
        h = mesh.twin[out];
    }
    return {length, none};
}

// Seams that go on into each other without a corner, by the half-edges on them.
UnionFind pieces_of(const SeamMesh& mesh) {
    std::map<int, Indices> at;  // half-edges on seams that begin at a vertex
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] != none) at[mesh.tail(h)].push_back(h);
    }
    UnionFind pieces(mesh.half_edge_count());
    const auto along = [&](int h) { return Vector3(mesh.points.col(mesh.head(h)) - mesh.points.col(mesh.tail(h))); };
    for (const auto& [vertex, out] : at) {
        if (out.size() != 2 || radians_between(-along(out[0]), along(out[1])) > corner) continue;
        pieces.join(mesh.twin[out[0]], out[1]);
        pieces.join(mesh.twin[out[1]], out[0]);
    }
    return pieces;
}

}  // namespace

SeamRoom seam_room(const SeamMesh& mesh) {
    UnionFind pieces = pieces_of(mesh);
    std::map<int, std::vector<double>> ways;
    std::map<int, double> widest;
    const auto limit = [&](int h, double width) {
        double& known = widest.try_emplace(pieces.root(h), infinite).first->second;
        known = std::min(known, width);
    };
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none || !(mesh.length[h] > 0.0)) continue;
        const Way way = way_across(mesh, h);
        ways[pieces.root(h)].push_back(way.length);
        limit(h, taken * (way.end == none ? 1.0 : 0.5) * way.length);
        if (way.end != none) limit(way.end, 0.5 * taken * way.length);
    }
    SeamRoom room{0.0, VectorX::Constant(mesh.points.cols(), infinite)};
    for (auto& [piece, each] : ways) {
        const auto middle = each.begin() + std::ssize(each) / 2;
        std::nth_element(each.begin(), middle, each.end());
        room.usual = room.usual > 0.0 ? std::min(room.usual, share * *middle) : share * *middle;
    }
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none || !widest.contains(pieces.root(h))) continue;
        for (const int v : {mesh.tail(h), mesh.head(h)})
            room.widest[v] = std::min(room.widest[v], widest.at(pieces.root(h)));
    }
    return room;
}

}  // namespace fairing
