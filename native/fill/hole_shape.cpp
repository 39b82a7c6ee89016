#include "fill/hole_shape.h"

#include <Eigen/Dense>

#include "base/columns.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double tiny = std::numeric_limits<double>::min();  // no division by zero
constexpr double whole = 1e-3;  // 1 + τ of what is a whole ball in all but name, and how unlike a flat sheet's normals
// Vertices of equilateral triangles, per square of their edge.
constexpr double per_square = 2.0 * std::numbers::inv_sqrt3;

// To the left, in the tangent plane.
double turn_at(const LoopShape& loop, int k) {
    const Vector3 after = loop.edge(k);
    const Vector3 before = loop.edge((k + loop.size() - 1) % loop.size());
    const Vector3 normal = loop.normals.col(k);
    const double cosine = before.dot(after) - before.dot(normal) * after.dot(normal);
    return std::atan2(normal.dot(before.cross(after)), cosine);
}

// From the middle; no surface of least area has more than a circle as long as the loop.
double disc_area(const LoopShape& loop) {
    const Vector3 middle = loop.points.rowwise().mean();
    double area = 0.0;
    for (int k = 0; k < loop.size(); ++k) {
        const Vector3 out = loop.points.col(k) - middle;
        area += 0.5 * out.cross(Vector3(loop.points.col((k + 1) % loop.size()) - middle)).norm();
    }
    const double around = loop.perimeter();
    return std::min(area, around * around / (4.0 * std::numbers::pi));
}

Points all_but(std::span<const LoopShape> loops, std::size_t one) {
    Points others(3, 0);
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (l == one) continue;
        const Eigen::Index count = others.cols();
        others.conservativeResize(3, count + loops[l].points.cols());
        others.rightCols(loops[l].points.cols()) = loops[l].points;
    }
    return others;
}

// Half of the band to the other loops, as wide as these are away.
double band_area(const LoopShape& loop, const Points& others) {
    const Points some = others(Eigen::all, spread(static_cast<int>(others.cols())));
    const Indices few = spread(loop.size());
    double away = 0.0;
    for (const int k : few) away += std::sqrt((some.colwise() - loop.points.col(k)).colwise().squaredNorm().minCoeff());
    return 0.5 * loop.perimeter() * away / static_cast<double>(few.size());
}

// The larger principal curvature of a surface with these normals, in least squares.
double most_bent(const LoopShape& loop) {
    const Points away = loop.points.colwise() - loop.points.rowwise().mean();
    const Points tilt = loop.normals.colwise() - loop.normals.rowwise().mean();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(away * away.transpose());
    const Eigen::Matrix<double, 3, 2> plane = axes.eigenvectors().rightCols<2>();
    const Eigen::MatrixXd places = away.transpose() * plane;
    const Eigen::Matrix2d shape = places.completeOrthogonalDecomposition().solve(tilt.transpose() * plane);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> bends(0.5 * (shape + shape.transpose()));
    return bends.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

Indices spread(int count) {
    constexpr int most = 400;  // vertices stand for a loop of any length
    const int few = std::min(count, most);
    Indices places;
    for (int k = 0; k < few; ++k)
        places.push_back(few < 2 ? 0 : static_cast<int>(std::lround(double(k) * double(count - 1) / double(few - 1))));
    return places;
}

double LoopShape::perimeter() const {
    double sum = 0.0;
    for (int k = 0; k < size(); ++k) sum += edge(k).norm();
    return sum;
}

double turning(const LoopShape& loop) {
    constexpr double stands_up = 0.75;  // of a turn; noise of a fifth of an edge makes half a one
    double in_planes = 0.0;
    for (int k = 0; k < loop.size(); ++k) in_planes += turn_at(loop, k) / full_turn;
    const double by_angles = loop.angles.sum() / full_turn;
    return loop.angles.size() > 0 && std::abs(by_angles - in_planes) > stands_up ? by_angles : in_planes;
}

double times_flat(const LoopShape& loop) { return 2.0 / std::max(1.0 + turning(loop), whole); }

bool is_outer(const LoopShape& loop) { return times_flat(loop) > out_of_proportion; }

bool is_endless(const LoopShape& loop) {
    return loop.normals.rowwise().mean().norm() >= 1.0 - whole && 1.0 + turning(loop) <= whole;
}

double flat_count(std::span<const LoopShape> loops, double spacing, bool joined) {
    double count = 0.0;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const LoopShape& loop = loops[l];
        const double area = joined && loops.size() > 1 ? band_area(loop, all_but(loops, l)) : disc_area(loop);
        const double edge = spacing > 0.0 ? spacing : loop.perimeter() / loop.size();
        count += per_square * area / std::max(edge * edge, tiny);
    }
    return count;
}

double expected_count(std::span<const LoopShape> loops, double spacing, bool joined) {
    if (joined && loops.size() > 1) return flat_count(loops, spacing, true);
    double count = 0.0;
    for (const LoopShape& loop : loops) count += times_flat(loop) * flat_count({&loop, 1}, spacing, false);
    return count;
}

double least_count(const LoopShape& loop, double spacing) {
    const double flat = flat_count({&loop, 1}, spacing, false);
    if (!is_outer(loop)) return flat;
    const double bend = most_bent(loop);
    return flat * 4.0 * std::numbers::pi / std::max(disc_area(loop) * bend * bend, tiny);
}

// It does around a sheet: the loop runs clockwise, seen from the normals. So does the hole that leaves little of a ball
// or a limb, but the normals there lean outwards, or inwards, at most places, and by 6° in the mean.
bool leads_outside(const LoopShape& loop) {
    constexpr double clockwise = -0.5;  // mean cosine between the normals and the loop's axis: 120° and more
    constexpr double one_sided = 0.5;   // of the normals lean out more than in, or the other way round
    constexpr double least_lean = 0.1;  // sine of the mean lean, 6°
    constexpr double no_area = 1e-9;    // of the squared distances from the middle
    Points out = loop.points.colwise() - loop.points.rowwise().mean();
    Vector3 area = Vector3::Zero();
    for (int k = 0; k < loop.size(); ++k) area += out.col(k).cross(out.col((k + 1) % loop.size()));
    if (!(area.norm() > no_area * out.squaredNorm())) return false;
    const Vector3 axis = area.normalized();
    if (!((axis.transpose() * loop.normals).mean() < clockwise)) return false;
    out -= axis * (axis.transpose() * out);
    double mean = 0.0;
    double size = 0.0;
    for (int k = 0; k < loop.size(); ++k) {
        const double lean = loop.normals.col(k).dot(direction(out.col(k))) / loop.size();
        mean += lean;
        size += std::abs(lean);
    }
    return std::abs(mean) < std::max(one_sided * size, least_lean);
}

}  // namespace fairing
