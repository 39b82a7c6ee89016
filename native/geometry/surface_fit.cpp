#include "geometry/surface_fit.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "base/progress.h"
#include "geometry/face_geometry.h"
#include "geometry/limits.h"
#include "mesh/strip.h"

namespace fairing {

namespace {

constexpr int quadratic_rings = 2;       // see `candidates`
constexpr int cubic_rings = 3;           // likewise
constexpr int wide_rings = 4;            // only where the centre has noise as well
constexpr std::size_t wide_points = 40;  // likewise

struct Candidate {
    std::span<const Vector3> points;
    Degree degree;
};

// Two rings follow a coarse mesh whatever its quads' proportions; cubics are for fine ones; many points for noisy ones.
std::vector<Candidate> candidates(const Neighbourhood& around, Centre at_centres) {
    std::vector<Candidate> list{{around.rings(quadratic_rings), Degree::quadratic},
                                {around.nearest(points_of_fit), Degree::quadratic},
                                {around.nearest(points_of_fit), Degree::cubic},
                                {around.rings(cubic_rings), Degree::cubic}};
    if (at_centres == Centre::met) return list;
    for (const Degree degree : {Degree::quadratic, Degree::cubic}) {
        list.push_back({around.rings(wide_rings), degree});
        list.push_back({around.nearest(wide_points), degree});
    }
    return list;
}

}  // namespace

Reach SurfaceFits::reach_of(Centre at_centres) {
    return at_centres == Centre::free ? Reach{wide_rings, wide_points} : Reach{cubic_rings, points_of_fit};
}

SurfaceFits::SurfaceFits(const Points& points, const Triangles& triangles, Centre at_centres)
    : points_(points),
      adjacency_(triangles, static_cast<int>(points.cols())),
      around_(adjacency_, points_, reach_of(at_centres)),
      summed_(summed_normals(points, triangles)),
      at_centres_(at_centres) {}

// The standard error falls with more terms where the surface has them, and rises where the points don't determine them.
std::optional<SlopeFit> SurfaceFits::at_vertex(int vertex, Neighbourhood& around) const {
    around.gather(vertex);
    std::optional<SlopeFit> best;
    std::optional<SlopeFit> most_certain;  // of its curvature
    for (const auto& [points, degree] : candidates(around, at_centres_)) {
        const auto fit = fit_slopes(points_.col(vertex), points, averaged(vertex), degree, at_centres_);
        if (fit && (!best || fit->error < best->error)) best = fit;
        if (fit && (!most_certain || fit->curvature_error < most_certain->curvature_error)) most_certain = fit;
    }
    if (!best && at_centres_ == Centre::free) return strip_at(vertex, around);
    if (best) {
        best->mean_curvature = most_certain->mean_curvature;
        best->curvature_error = most_certain->curvature_error;
        best->bending = most_certain->bending;
    }
    return best;
}

std::optional<SlopeFit> SurfaceFits::strip_at(int vertex, const Neighbourhood& around) const {
    std::optional<SlopeFit> best;
    for (const auto points : {around.rings(quadratic_rings), around.nearest(points_of_fit)}) {
        const auto fit = fit_slopes(points_.col(vertex), points, averaged(vertex), Degree::strip, at_centres_);
        if (fit && (!best || fit->error < best->error)) best = fit;
    }
    return best;
}

UnitSized to_unit_size(const Points& points, const Triangles& triangles) {
    double largest = 0.0;
    for (int v : triangles.reshaped()) largest = std::max(largest, points.col(v).cwiseAbs().maxCoeff());
    return largest > 0.0 ? UnitSized{points / largest, largest} : UnitSized{points, 1.0};
}

Points one_sided_normals(const Patch& patch, const Points& points) {
    const int count = patch.vertex_count() - patch.free_count;
    Indices fixed(count);
    std::iota(fixed.begin(), fixed.end(), patch.free_count);
    const Strip strip = strip_around(patch, fixed, Neighbourhood::most_rings - 1);
    const UnitSized unit = to_unit_size(strip.gather(points), strip.triangles);
    const SurfaceFits fits(unit.points, strip.triangles, Centre::met);
    Points normals(3, count);
    // Few pieces: each has marks for all vertices of the strip.
    for_ranges(count, std::max(16, count / 16), [&](int begin, int end) {
        Neighbourhood around = fits.walk();
        for (int k = begin; k < end; ++k) {
            checkpoint();
            const int vertex = strip.local[patch.free_count + k];
            const auto fit = fits.at_vertex(vertex, around);
            normals.col(k) = fit ? fit->normal : fits.averaged(vertex);
        }
    });
    return normals;
}

}  // namespace fairing
