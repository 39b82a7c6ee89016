#include "fillet/seam_room.h"

#include <set>

#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();  // no seam, no limit
constexpr double share = 0.2;                                         // of a side: what modellers begin with
constexpr double most = 0.9;     // of the seams has longer sides than the one that counts: a narrow place is no measure
constexpr double taken = 0.9;    // of the room: what is left of a face is no narrower than the new edges are long
constexpr double grazing = 0.3;  // cosine: sides that a path hardly meets are measured by their own paths
constexpr double corner = 0.8;   // radians: where seams turn by more another piece begins

struct Ray {
    double length;
    int end;       // the half-edge on a seam, wall or border at which it comes out, or `none`,
    double slope;  // and the cosine of the angle to the path square to that one
};

// From a place on a half-edge, square to it straight on until the face ends.
Ray ray_across(const SeamMesh& mesh, int h, double along) {
    Vector2 from(along * mesh.length[h], 0.0);
    Vector2 ray = Vector2::UnitY();
    double length = 0.0;
    for (Eigen::Index crossed = 0; crossed < mesh.triangles.cols(); ++crossed) {
        const bool through_next = cross2(ray, mesh.apex[h] - from) > 0.0;
        const int out = through_next ? SeamMesh::next(h) : SeamMesh::previous(h);
        const Vector2 tail = through_next ? Vector2(mesh.length[h], 0.0) : mesh.apex[h];
        const Vector2 head = through_next ? mesh.apex[h] : Vector2::Zero();
        const double speed = cross2(ray, head - tail);
        if (!(speed > 0.0)) break;
        const double step = cross2(tail - from, head - tail) / speed;
        length += step;
        if (mesh.seam[out] != none || mesh.twin[out] == none) return {length, out, speed / (head - tail).norm()};
        const Vector2 x = (tail - head).normalized();
        from = {(from + step * ray - head).dot(x), 0.0};
        ray = {ray.dot(x), cross2(x, ray)};
        h = mesh.twin[out];
    }
    return {length, none, 0.0};
}

// The sides of faces, from corner to corner: half-edges on seams, walls and borders that go on into each other.
struct Sides {
    explicit Sides(const SeamMesh& mesh) : of(mesh.half_edge_count()) {
        const auto is_hard = [&](int h) { return mesh.seam[h] != none || mesh.twin[h] == none; };
        const auto ray = [&](int h) { return Vector3(mesh.points.col(mesh.head(h)) - mesh.points.col(mesh.tail(h))); };
        std::vector<VertexPair> turns;
        for (int h = 0; h < mesh.half_edge_count(); ++h) {
            if (!is_hard(h)) continue;
            int next = SeamMesh::next(h);
            while (!is_hard(next)) next = SeamMesh::next(mesh.twin[next]);
            if (radians_between(ray(h), ray(next)) > corner)
                turns.push_back({h, next});
            else
                of.join(h, next);
        }
        for (const auto& [before, after] : turns) corners.insert(std::minmax(of.root(before), of.root(after)));
    }
    // Near the corner in which they meet they are as near to each other as one likes.
    [[nodiscard]] bool meet(int a, int b) { return corners.contains(std::minmax(of.root(a), of.root(b))); }
    UnionFind of;
    std::set<std::pair<int, int>> corners;
};

double usual_width(std::vector<std::pair<double, double>>& sides) {
    std::sort(sides.begin(), sides.end());
    double sum = 0.0;
    for (const auto& [side, weight] : sides) sum += weight;
    for (const auto& [side, weight] : sides) {
        sum -= weight / (1.0 - most);
        if (sum <= 0.0) return share * side;
    }
    return 0.0;
}

}  // namespace

SeamRoom seam_room(const SeamMesh& mesh) {
    Sides of(mesh);
    std::vector<std::pair<double, double>> sides;  // and for how much of the seams
    SeamRoom room{0.0, VectorX::Constant(mesh.points.cols(), infinite)};
    const auto limit = [&](int h, double width) {
        for (const int v : {mesh.tail(h), mesh.head(h)}) room.widest[v] = std::min(room.widest[v], taken * width);
    };
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none || !(mesh.length[h] > 0.0)) continue;
        for (const double along : {0.1, 0.3, 0.5, 0.7, 0.9}) {
            const Ray ray = ray_across(mesh, h, along);
            if (ray.end == none || ray.slope < grazing || of.meet(h, ray.end)) continue;
            sides.emplace_back(ray.length, mesh.length[h]);
            const bool meets = mesh.seam[ray.end] != none;
            const double width = meets ? ray.slope / (1.0 + ray.slope) * ray.length : ray.length;
            limit(h, width);
            if (meets) limit(ray.end, width);
        }
    }
    room.usual = usual_width(sides);
    return room;
}

}  // namespace fairing
