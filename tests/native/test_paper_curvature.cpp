#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include <vector>

#include "paper/disk_curvature.h"

using namespace fairing;

namespace {

constexpr double pi = std::numbers::pi;

// A closed disk around vertex 0; nothing is known beyond its rim.
struct Wheel {
    Points points;
    Points normals;
    Points arcs;
    Indices neighbours;
    Indices rim;

    explicit Wheel(const std::vector<Vector3>& ring) {
        const auto m = static_cast<Eigen::Index>(ring.size());
        points.setZero(3, m + 1);
        normals = Vector3::UnitZ().replicate(1, m + 1);
        for (Eigen::Index k = 0; k < m; ++k) {
            points.col(k + 1) = ring[static_cast<std::size_t>(k)];
            neighbours.push_back(static_cast<int>(k) + 1);
            rim.push_back(static_cast<int>(k));
        }
        measure_arcs();
    }
    // After a change of normals.
    void measure_arcs() {
        const Eigen::Index m = points.cols() - 1;
        arcs.setZero(3, m);
        for (Eigen::Index k = 0; k < m; ++k) {
            const Eigen::Index a = k + 1;
            const Eigen::Index b = (k + 1) % m + 1;
            const Vector3 cross = (points.col(a) - points.col(0)).cross(points.col(b) - points.col(0));
            const Vector3 top =
                virtual_point({points.col(a), points.col(b), normals.col(a), normals.col(b), cross.normalized()});
            arcs.col(k) = top - 0.5 * (points.col(a) + points.col(b));
        }
    }
    [[nodiscard]] Disk disk(bool completed) const { return {0, {neighbours, {}, rim}, completed}; }
    [[nodiscard]] DiskField field() const { return {points, arcs}; }
    [[nodiscard]] double mean_curvature(bool completed) const {
        return DiskFit()(disk(completed), field(), normals.col(0)).mean();
    }
};

// Neighbours at the given angles, at heights that no quadric through the centre explains.
Wheel uneven(const std::vector<double>& angles) {
    const double heights[] = {0.05, -0.02, 0.03, 0.08, -0.04};
    std::vector<Vector3> ring;
    for (std::size_t k = 0; k < angles.size(); ++k) {
        ring.emplace_back(std::cos(angles[k]), std::sin(angles[k]), heights[k]);
    }
    return Wheel(ring);
}

// Largest change of H from one step of the sweep to the next.
double largest_jump(const std::function<Wheel(double)>& at, bool completed, int steps = 2000) {
    double largest = 0.0;
    double last = at(0.0).mean_curvature(completed);
    for (int k = 1; k <= steps; ++k) {
        const double H = at(static_cast<double>(k) / steps).mean_curvature(completed);
        largest = std::max(largest, std::abs(H - last));
        last = H;
    }
    return largest;
}

}  // namespace

TEST_CASE("H has no jump where four neighbours come to lie on two lines (Lemma 1)") {
    // At s = ½ the second neighbour is opposite to the fourth: a cross.
    const auto cross = [](double s) { return uneven({0.0, 0.4 * pi + 0.2 * pi * s, pi, 1.5 * pi}); };
    CHECK(largest_jump(cross, true) < 2e-4);
    CHECK(largest_jump(cross, false) > 1e-2);  // what the virtual points are for
}
