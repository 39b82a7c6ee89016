// Points on seams and walls, which bound the triangles of a new mesh.
#include <set>

#include "fillet/level_line.h"
#include "fillet/limits.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double sliver = 0.1;         // of the spacing: points on both sides of lower triangles would nearly coincide
constexpr double equal = 1e-6;         // relative: widths that are one but for roundoff
constexpr double clear_of_line = 0.3;  // of the spacing: nearer to each other, or to the line, points bring short edges

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

// Parts a half-edge into edges whose lengths change with the widths along it.
struct Parts {
    Parts(const SeamMesh& mesh, const SeamDistance& distance, int h, double spacing) {
        const double first = distance.relative_width(h / 3, weights_along(h, 0.0));
        const double last = distance.relative_width(h / 3, weights_along(h, 1.0));
        growth = std::log(last / first);
        wanted = mesh.length[h] / spacing * (std::abs(growth) > equal ? growth / (last - first) : 1.0 / first);
    }
    // Where part k of so many begins, as a share of the length.
    [[nodiscard]] double begin(int k, int count) const {
        const double share = static_cast<double>(k) / count;
        return std::abs(growth) > equal ? std::expm1(growth * share) / std::expm1(growth) : share;
    }
    double growth, wanted;
};

// The number that each point becomes where those on both sides of a wall that are next to each other come together in
// their mean.
Indices joined_numbers(const SeamMesh& mesh, const SeamDistance& distance, double near, LevelLine& line) {
    Indices wall(mesh.edge.size(), none);  // of each edge: a half-edge on it
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.twin[h] == none) wall[mesh.edge[h]] = h;
    }
    Indices order;
    Indices number(line.points.size());
    for (int p = 0; p < static_cast<int>(line.points.size()); ++p) {
        number[p] = p;
        const int edge = line.points[p].edge;
        if (edge != none && wall[edge] != none) order.push_back(p);
    }
    const auto key = [&](int p) { return std::pair(line.points[p].edge, line.points[p].along); };
    std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
    for (std::size_t k = 1; k < order.size(); ++k) {
        const LinePoint& before = line.points[order[k - 1]];
        const int h = wall[before.edge];
        const LinePoint& after = line.points[order[k]];
        if (before.edge != after.edge || before.triangle == after.triangle || number[order[k - 1]] != order[k - 1])
            continue;
        const double middle = 0.5 * (before.along + after.along);
        const double size = distance.relative_width(before.triangle, before.weights);
        if (2.0 * (middle - before.along) * mesh.length[h] > near * size) continue;
        number[order[k]] = order[k - 1];
        line.points[order[k - 1]] = point_on(mesh, h, mesh.tail(h) < mesh.head(h) ? middle : 1.0 - middle);
    }
    return number;
}

}  // namespace

void join_at_walls(const SeamMesh& mesh, const SeamDistance& distance, double spacing, LevelLine& line) {
    const Indices number = joined_numbers(mesh, distance, clear_of_line * spacing, line);
    Indices place(number.size(), none);
    std::vector<LinePoint> kept;
    for (std::size_t p = 0; p < number.size(); ++p) {
        if (number[p] != static_cast<int>(p)) continue;
        place[p] = static_cast<int>(kept.size());
        kept.push_back(line.points[p]);
    }
    for (LineSegment& segment : line.segments)
        segment = {place[number[segment.from]], place[number[segment.to]], segment.triangle};
    line.points = std::move(kept);
}

void part_seams(const SeamMesh& mesh, const SeamDistance& distance, double spacing, LevelLine& line) {
    std::vector<char> at_wall(mesh.points.cols(), 0);
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.twin[h] == none) at_wall[mesh.tail(h)] = at_wall[mesh.head(h)] = 1;
    }
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.twin[h] == none || mesh.tail(h) > mesh.head(h)) continue;
        const bool between_walls = at_wall[mesh.tail(h)] != 0 && at_wall[mesh.head(h)] != 0;
        if (mesh.seam[h] == none) {
            const bool within =
                between_walls && distance.reaches(h / 3) && distance.value(h / 3, weights_along(h, 0.5)) <= 0.0;
            if (within) line.points.push_back(point_on(mesh, h, 0.5));  // an edge between fixed vertices would be held
            continue;
        }
        const double size = distance.relative_width(h / 3, weights_along(h, 0.5));
        if (std::min(mesh.apex[h][1], mesh.apex[mesh.twin[h]][1]) < sliver * size * spacing) continue;
        const Parts parts(mesh, distance, h, spacing);
        const int count = std::max(between_walls ? 2 : 1, static_cast<int>(std::lround(parts.wanted)));
        for (int k = 1; k < count; ++k) line.points.push_back(point_on(mesh, h, parts.begin(k, count)));
    }
}

void part_walls(const SeamMesh& mesh, const SeamDistance& distance, const SideNormals& sides, double spacing,
                LevelLine& line) {
    std::set<int> parted;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        const int t = h / 3;
        if (mesh.twin[h] != none || !distance.reaches(t) || parted.contains(mesh.edge[h])) continue;
        const bool is_straight = radians_between(sides.normal(t, weights_along(h, 0.0)),
                                                 sides.normal(t, weights_along(h, 1.0))) < straight_angle;
        const Parts parts(mesh, distance, h, spacing);
        const auto count = static_cast<int>(is_straight ? std::round(parts.wanted) : parts.wanted / longest_edge);
        for (int k = 1; k < count; ++k) {
            const double along = parts.begin(k, count);
            const Vector3 weights = weights_along(h, along);
            if (!(distance.value(t, weights) < -clear_of_line * spacing * distance.relative_width(t, weights)))
                continue;
            line.points.push_back(point_on(mesh, h, along));
            parted.insert(mesh.edge[h]);
        }
    }
}

}  // namespace fairing
