#include "geometry/surface_fit.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "base/progress.h"
#include "geometry/face_geometry.h"
#include "geometry/limits.h"
#include "mesh/loops.h"

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

using Four = TallSystem::Four;
using Index = TallSystem::Index;
using Place = Eigen::Map<Four, Eigen::Aligned16>;
using ConstPlace = Eigen::Map<const Four, Eigen::Aligned16>;

// Masks of four with ones at a position, or behind it, are cut out of these.
constexpr std::array<double, 7> one = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
constexpr std::array<double, 7> ones = {0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
Four cut_out(const std::array<double, 7>& numbers, Index place) {
    return Eigen::Map<const Four>(numbers.data() + 3 - place);
}

double squared_length(const double* v, Index fours) {
    Four sum = Four::Zero();
    for (Index k = 0; k < 4 * fours; k += 4) sum += ConstPlace(v + k).square();
    return sum.sum();
}

// Always writes whole groups of four: after stores of single entries the next loads would stall.
struct Reflector {
    const double* v;
    Index fours;
    Index place;     // of v's first entry in its first group of four
    double inverse;  // of half of |v|²
};

// Reflects `Count` columns, `stride` apart, concurrently. Their entries where v begins go to `row`.
template <int Count>
void reflect_columns(const Reflector& reflector, double* columns, Index stride, double* row) {
    const auto [v, fours, place, inverse] = reflector;
    std::array<Four, Count> sums;
    sums.fill(Four::Zero());
    for (Index k = 0; k < 4 * fours; k += 4) {
        const Four part = ConstPlace(v + k);
        for (int c = 0; c < Count; ++c) sums[c] += part * ConstPlace(columns + c * stride + k);
    }
    std::array<double, Count> shares;
    for (int c = 0; c < Count; ++c) shares[c] = sums[c].sum() * inverse;
    for (Index k = 0; k < 4 * fours; k += 4) {
        const Four part = ConstPlace(v + k);
        for (int c = 0; c < Count; ++c) Place(columns + c * stride + k) -= shares[c] * part;
    }
    for (Index c = 0; c < Count; ++c) {
        row[c * TallSystem::most_columns] = columns[c * stride + place];
        Place(columns + c * stride) *= cut_out(ones, place);
    }
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
    const PatchStrip strip = strip_around(patch, fixed, Neighbourhood::most_rings - 1);
    const UnitSized unit = to_unit_size(strip.gather(points), strip.triangles);
    const SurfaceFits fits(unit.points, strip.triangles, Centre::met);
    Points normals(3, count);
    // Few pieces, because each has marks for all vertices of the strip.
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

TallSystem::TallSystem(Index rows, Index columns)
    : columns_(columns), fours_((rows + 3) / 4), rows_(4, columns * fours_), factor_() {}

// Row j of R is taken out as soon as it stands: the reflector and all behind it begin with zeros then.
void TallSystem::triangularise() {
    for (Index j = 0; j < columns_; ++j) reflect(j);
}

void TallSystem::reflect(Index column) {
    const Index place = column % 4;
    const Index stride = 4 * fours_;
    double* const v = rows_.data() + column * stride + column - place;
    const Index fours = fours_ - column / 4;
    const double length = std::sqrt(squared_length(v, fours));
    const double pivot = v[place] > 0.0 ? -length : length;
    const double scale = -pivot * (v[place] - pivot);
    Place(v) -= pivot * cut_out(one, place);
    const Reflector reflector{v, fours, place, scale > 0.0 ? 1.0 / scale : 0.0};
    double* row = &factor_(column, column);
    *row = pivot;
    Index k = column + 1;
    for (; k + 1 < columns_; k += 2) {
        reflect_columns<2>(reflector, v + (k - column) * stride, stride, row + (k - column) * most_columns);
    }
    if (k < columns_) {
        reflect_columns<1>(reflector, v + (k - column) * stride, stride, row + (k - column) * most_columns);
    }
}

double TallSystem::least_pivot(Index count) const {
    double least = std::abs(factor_(0, 0));
    double largest = least;
    for (Index k = 1; k < count; ++k) {
        least = std::min(least, std::abs(factor_(k, k)));
        largest = std::max(largest, std::abs(factor_(k, k)));
    }
    return least / largest;
}

TallSystem::Row TallSystem::solve(Index count) const {
    Row x = factor_.col(count).head(count);
    for (Index k = count - 1; k >= 0; --k) {
        x[k] /= factor_(k, k);
        for (Index i = 0; i < k; ++i) x[i] -= x[k] * factor_(i, k);
    }
    return x;
}

TallSystem::Row TallSystem::solve_transposed(Row y) const {
    for (Index k = 0; k < y.size(); ++k) {
        for (Index i = 0; i < k; ++i) y[k] -= y[i] * factor_(i, k);
        y[k] /= factor_(k, k);
    }
    return y;
}

}  // namespace fairing
