#include "shape/flank.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "geometry/surface_fit.h"
#include "geometry/triangle.h"
#include "shape/knobs.h"
#include "shape/limits.h"

namespace fairing {

namespace {

// Distances from the boundary, in radii of the patch.
struct Band {
    double from;
    double to;
};
constexpr Band inside_band{0.3, 0.7};                                   // neither the join nor the top
constexpr std::array<Band, 2> outside_bands{{{0.5, 1.1}, {0.8, 1.8}}};  // a feature ends within one of them
constexpr double end_step = 0.2;                                        // how finely its end is looked for
// Triangles on either side and edges of the boundary that are enough.
constexpr Eigen::Index most_triangles = 3000;
constexpr std::size_t most_edges = 300;  // see above

// Edges of a boundary.
struct Frames {
    Points middles;
    Points normals;  // of the surface
    Points outward;  // unit
};

Frames frames_of(const Patch& patch, const Points& points) {
    const Points fixed_normals = one_sided_normals(patch, points);
    const Indices loop = patch.loops().front();  // the patch on its left
    const std::size_t stride = loop.size() / most_edges + 1;
    const auto count = static_cast<Eigen::Index>((loop.size() + stride - 1) / stride);
    Frames frames{Points(3, count), Points(3, count), Points(3, count)};
    for (Eigen::Index k = 0; k < count; ++k) {
        const std::size_t place = stride * static_cast<std::size_t>(k);
        const int a = loop[place];
        const int b = loop[(place + 1) % loop.size()];
        const Vector3 normal =
            direction(fixed_normals.col(a - patch.free_count) + fixed_normals.col(b - patch.free_count));
        frames.middles.col(k) = 0.5 * (points.col(a) + points.col(b));
        frames.normals.col(k) = normal;
        frames.outward.col(k) = direction(Vector3(points.col(b) - points.col(a)).cross(normal));
    }
    return frames;
}

// Triangles as the boundary sees them.
struct Leans {
    std::vector<double> away;     // from the nearest edge
    std::vector<double> degrees;  // by how many they lean away from it, as a dome does on both sides
    Indices nearest;
};

// `side`: 1 for triangles outside, −1 inside.
Leans leans(const Frames& frames, const Points& points, const Triangles& triangles, double side) {
    Leans found;
    for (Eigen::Index t = 0; t < triangles.cols(); t += triangles.cols() / most_triangles + 1) {
        const Eigen::Vector3i corners = triangles.col(t);
        const Vector3 centre = (points.col(corners[0]) + points.col(corners[1]) + points.col(corners[2])) / 3.0;
        Eigen::Index nearest = 0;
        const double squared = (frames.middles.colwise() - centre).colwise().squaredNorm().minCoeff(&nearest);
        const Vector3 normal = area_vector(points, corners);
        const double ahead = side * normal.dot(frames.outward.col(nearest));
        found.away.push_back(std::sqrt(squared));
        found.degrees.push_back(std::atan2(ahead, normal.dot(frames.normals.col(nearest))) * 180.0 / std::numbers::pi);
        found.nearest.push_back(static_cast<int>(nearest));
    }
    return found;
}

// The mean degrees at each place of the boundary that has triangles in a band.
std::vector<double> means_within(const Leans& leans, const Band& band, double radius, Eigen::Index place_count) {
    VectorX sums = VectorX::Zero(place_count);
    VectorX counts = VectorX::Zero(place_count);
    for (std::size_t k = 0; k < leans.away.size(); ++k) {
        if (leans.away[k] <= band.from * radius || leans.away[k] >= band.to * radius) continue;
        sums[leans.nearest[k]] += leans.degrees[k];
        counts[leans.nearest[k]] += 1.0;
    }
    std::vector<double> means;
    for (Eigen::Index k = 0; k < place_count; ++k) {
        if (counts[k] > 0.0) means.push_back(sums[k] / counts[k]);
    }
    return means;
}

// Whether places lean by so many degrees in the mean, and so many of them visibly, to the side of the sign.
bool lean_to(const std::vector<double>& places, double sign, double degrees, double share) {
    double sum = 0.0;
    double seen = 0.0;
    for (const double lean : places) {
        sum += sign * lean;
        seen += sign * lean > seen_lean ? 1.0 : 0.0;
    }
    const auto count = static_cast<double>(places.size());
    return count > 0.0 && sum >= degrees * count && seen >= share * count;
}

// How far out, in radii, the surroundings bend back by nearly as much as they do at most.
double end_of_flank(const Leans& outside, double sign, double radius) {
    const auto count = static_cast<Eigen::Index>(std::lround(outside_bands.back().to / end_step));
    VectorX sums = VectorX::Zero(count);
    VectorX counts = VectorX::Zero(count);
    for (std::size_t k = 0; k < outside.away.size(); ++k) {
        const auto step = static_cast<Eigen::Index>(outside.away[k] / radius / end_step);
        if (step >= count) continue;
        sums[step] -= sign * outside.degrees[k];
        counts[step] += 1.0;
    }
    const VectorX means = sums.cwiseQuotient(counts.cwiseMax(1.0));
    Eigen::Index step = 0;
    while (means[step] < flank_end * means.maxCoeff()) ++step;
    return static_cast<double>(step + 1) * end_step;
}

// Whether the surface leaves its boundary so steeply that this is no slope but the stump of a limb.
bool stands_on_end(const Patch& patch, const Points& points, const Frames& frames) {
    Vector3 axis = Vector3::Zero();
    for (const auto corners : patch.triangles.colwise()) axis += area_vector(points, corners);
    const double facing = (direction(axis).transpose() * frames.normals).mean();
    return facing < std::cos(steepest_flank * std::numbers::pi / 180.0);
}

double radius_of(const Points& points, const Triangles& triangles) {
    double doubled = 0.0;
    for (const auto corners : triangles.colwise()) doubled += area_vector(points, corners).norm();
    return std::sqrt(0.5 * doubled / std::numbers::pi);
}

}  // namespace

std::optional<Flank> flank_of(const Patch& patch, const Points& points, const Around& around) {
    const double radius = radius_of(points, patch.triangles);
    if (!is_plain_disc(patch) || !(radius > 0.0)) return std::nullopt;
    const Frames frames = frames_of(patch, points);
    if (stands_on_end(patch, points, frames)) return std::nullopt;
    const Eigen::Index count = frames.middles.cols();
    const auto inside = means_within(leans(frames, points, patch.triangles, -1.0), inside_band, radius, count);
    double sum = 0.0;
    for (const double lean : inside) sum += lean;
    const double sign = sum > 0.0 ? 1.0 : -1.0;
    if (!lean_to(inside, sign, flank_over, most_over)) return std::nullopt;
    const Leans outside = leans(frames, around.points, around.triangles, 1.0);
    for (const Band& band : outside_bands) {
        if (lean_to(means_within(outside, band, radius, count), -sign, flank_back, most_back)) {
            return Flank{patch.loops().front(), sign > 0.0, end_of_flank(outside, sign, radius) * radius};
        }
    }
    return std::nullopt;
}

}  // namespace fairing
