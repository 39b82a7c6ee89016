// Points on seams and walls, which bound the triangles of a new mesh.
#include <algorithm>
#include <cmath>
#include <set>

#include "fillet/level_line.h"
#include "geometry/angle.h"

namespace fairing {

namespace {

constexpr double straight_angle = 1e-3;  // radians: fits to planes agree to 1e-6, those to arcs turn more
constexpr double sliver = 0.1;         // of the spacing: points on both sides of lower triangles would nearly coincide
constexpr double clear_of_line = 0.3;  // of the spacing: nearer to the end of the fillet a point brings a short edge

Vector3 weights_along(int half_edge, double along) {
    Vector3 weights = Vector3::Zero();
    weights[half_edge % 3] = 1.0 - along;
    weights[(half_edge + 1) % 3] = along;
    return weights;
}

// `along` is counted from the half-edge's tail.
LinePoint point_on(const SeamMesh& mesh, int h, double along) {
    const Vector3 weights = weights_along(h, along);
    const bool upward = mesh.tail(h) < mesh.head(h);
    return {mesh.place(h / 3, weights), none, mesh.edge[h], upward ? along : 1.0 - along, h / 3, weights};
}

int parts(const SeamMesh& mesh, int h, double spacing) {
    return static_cast<int>(std::lround(mesh.length[h] / spacing));
}

}  // namespace

void part_seams(const SeamMesh& mesh, double spacing, LevelLine& line) {
    std::vector<char> at_wall(mesh.points.cols(), 0);
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.twin[h] == none) at_wall[mesh.tail(h)] = at_wall[mesh.head(h)] = 1;
    }
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none || mesh.twin[h] == none || mesh.tail(h) > mesh.head(h)) continue;
        if (std::min(mesh.apex[h][1], mesh.apex[mesh.twin[h]][1]) < sliver * spacing) continue;
        const int least = at_wall[mesh.tail(h)] != 0 && at_wall[mesh.head(h)] != 0 ? 2 : 1;
        const int count = std::max(least, parts(mesh, h, spacing));
        for (int k = 1; k < count; ++k) line.points.push_back(point_on(mesh, h, static_cast<double>(k) / count));
    }
}

void part_walls(const SeamMesh& mesh, const SeamDistance& distance, const SideNormals& sides, double spacing,
                LevelLine& line) {
    std::set<int> parted;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        const int t = h / 3;
        if (mesh.twin[h] != none || !distance.reaches(t) || parted.contains(mesh.edge[h])) continue;
        if (radians_between(sides.normal(t, weights_along(h, 0.0)), sides.normal(t, weights_along(h, 1.0))) >
            straight_angle)
            continue;
        const int count = parts(mesh, h, spacing);
        for (int k = 1; k < count; ++k) {
            const double along = static_cast<double>(k) / count;
            if (!(distance.value(t, weights_along(h, along)) < -clear_of_line * spacing)) continue;
            line.points.push_back(point_on(mesh, h, along));
            parted.insert(mesh.edge[h]);
        }
    }
}

}  // namespace fairing
