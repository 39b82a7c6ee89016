#include "shape/sunken.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/direction.h"
#include "geometry/averages.h"
#include "shape/knobs.h"
#include "shape/limits.h"

namespace fairing {

namespace {

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
