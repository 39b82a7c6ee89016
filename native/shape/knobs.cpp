#include "shape/knobs.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "base/parallel.h"
#include "geometry/neighbourhood.h"
#include "geometry/triangle.h"
#include "shape/limits.h"

namespace fairing {

namespace {

double angle_around(const Patch& patch, const Points& points, int vertex) {
    const RingView ring = patch.ring(vertex);
    const Vector3 here = points.col(vertex);
    double sum = 0.0;
    for (std::size_t k = 0; k < ring.rim.size(); ++k) {
        const int next = ring.vertices[k + 1 == ring.valence() ? 0 : k + 1];
        sum += radians_between(points.col(ring.vertices[k]) - here, points.col(next) - here);
    }
    return sum;
}

// 2π minus the angles around each free vertex: the integral of its Gaussian curvature.
VectorX angle_defects(const Patch& patch, const Points& points) {
    VectorX defects(patch.free_count);
    for_ranges(patch.free_count, fine_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) defects[v] = full_turn - angle_around(patch, points, v);
    });
    return defects;
}

// The most bent vertices, until their sum is reached.
Indices most_bent(const VectorX& defects, double sum) {
    Indices order(static_cast<std::size_t>(defects.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return defects[a] > defects[b]; });
    std::size_t count = 0;
    for (double reached = 0.0; reached < sum && count < order.size(); ++count) reached += defects[order[count]];
    order.resize(count);
    return order;
}

constexpr std::size_t most_places = 64;  // on the boundary: some 2000 lines
constexpr int most_vertices = 2000;      // that lines are compared with
constexpr double across = 0.6;           // of the longest distance on the boundary: shorter lines run along it
constexpr double straight = 0.8;         // cosine of the angle between a line and the tangent planes at its ends
constexpr double same_side = 0.5;        // cosine between the normals at both ends
constexpr double faces_it = 0.3;         // cosine between a line's normal and the surface's
constexpr int corrections = 4;           // of a middle's foot on the surface
constexpr std::size_t fewest = 10;       // lines across: fewer say nothing

// A line's middle, and which way is up there.
struct Middle {
    Vector3 place;
    Vector3 up;
    double length;
};

Indices spread(const Indices& from, std::size_t most) {
    Indices found;
    for (std::size_t k = 0; k < from.size(); k += from.size() / most + 1) found.push_back(from[k]);
    return found;
}

std::vector<Middle> middles(const Patch& patch, const Points& points, const Points& normals) {
    const Indices places = spread(patch.loops().front(), most_places);
    double longest = 0.0;
    for (const int a : places) {
        for (const int b : places) longest = std::max(longest, (points.col(b) - points.col(a)).norm());
    }
    std::vector<Middle> found;
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t j = i + 1; j < places.size(); ++j) {
            const Vector3 a = points.col(places[i]);
            const Vector3 b = points.col(places[j]);
            const double length = (b - a).norm();
            if (!(length > across * longest)) continue;
            const Vector3 way = (b - a) / length;
            const Vector3 first = normals.col(places[i] - patch.free_count);
            const Vector3 second = normals.col(places[j] - patch.free_count);
            const Vector3 leaving = way - way.dot(first) * first;
            const Vector3 arriving = way - way.dot(second) * second;
            if (std::min(leaving.norm(), arriving.norm()) < straight || first.dot(second) < same_side) continue;
            const Vector3 lift = length / 8.0 * (direction(leaving) - direction(arriving));
            found.push_back({0.5 * (a + b) + lift, direction(Vector3(first + second)), length});
        }
    }
    return found;
}

struct Below {
    double depth;  // of a line's length
    int vertex;    // nearest to where the surface is
};

Below below(const Middle& middle, const Points& points, const Points& normals, const Indices& vertices) {
    double height = 0.0;
    int nearest = vertices.front();
    for (int step = 0; step < corrections; ++step) {
        const Vector3 here = middle.place + height * middle.up;
        double least = std::numeric_limits<double>::infinity();
        for (const int v : vertices) {
            const double squared = (points.col(v) - here).squaredNorm();
            if (squared < least) {
                least = squared;
                nearest = v;
            }
        }
        const double facing = middle.up.dot(normals.col(nearest));
        const Vector3 up = facing > faces_it ? Vector3(normals.col(nearest) / facing) : middle.up;
        height += (points.col(nearest) - here).dot(up);
    }
    return {-height / middle.length, nearest};
}

}  // namespace

bool is_plain_disc(const Patch& patch) {
    return !patch.has_pins() && patch.vertex_count() - patch.edge_count() + patch.triangle_count() == 1;
}

Knobs knobs_of(const Patch& patch, const Points& points, double before) {
    if (!is_plain_disc(patch)) return {};
    const VectorX defects = angle_defects(patch, points);
    const double ball = defects.cwiseMax(0.0).sum();
    const double saddle = -defects.cwiseMin(0.0).sum();
    Knobs knobs{std::min(ball, saddle) / full_turn, {}};
    if (knobs.extent > std::max(least_knob, calmer * before)) knobs.tops = most_bent(defects, 0.5 * ball);
    return knobs;
}

Sunken sunken_of(const Patch& patch, const Points& points, const Points& normals) {
    if (!is_plain_disc(patch)) return {};
    const std::vector<Middle> lines = middles(patch, points, normals);
    if (lines.size() < fewest) return {};
    Indices vertices;
    for (int v = 0; v < patch.vertex_count(); v += patch.vertex_count() / most_vertices + 1) vertices.push_back(v);
    const Points own = averaged_normals(points, patch.triangles);
    std::vector<Below> found;
    found.reserve(lines.size());
    for (const Middle& line : lines) found.push_back(below(line, points, own, vertices));
    std::stable_sort(found.begin(), found.end(), [](const Below& a, const Below& b) { return a.depth > b.depth; });
    Sunken result{found[found.size() / 2].depth, {}};
    for (std::size_t k = 0; k <= found.size() / 2; ++k) result.deepest.push_back(found[k].vertex);
    std::sort(result.deepest.begin(), result.deepest.end());
    result.deepest.erase(std::unique(result.deepest.begin(), result.deepest.end()), result.deepest.end());
    return result;
}

}  // namespace fairing
