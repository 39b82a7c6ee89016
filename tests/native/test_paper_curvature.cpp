#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "paper/vertex_update.h"

using namespace fairing;

namespace {

constexpr double pi = std::numbers::pi;

// A closed disk around vertex 0; nothing is known beyond its rim.
struct Wheel {
    Points points;
    Points normals;
    Indices neighbours;
    Indices apexes;

    explicit Wheel(const std::vector<Vector3>& ring) {
        const auto m = static_cast<Eigen::Index>(ring.size());
        points.setZero(3, m + 1);
        normals = Vector3::UnitZ().replicate(1, m + 1);
        for (Eigen::Index k = 0; k < m; ++k) {
            points.col(k + 1) = ring[static_cast<std::size_t>(k)];
            neighbours.push_back(static_cast<int>(k) + 1);
            apexes.push_back(none);
        }
    }
    [[nodiscard]] Disk disk() const { return {0, neighbours, apexes, true}; }
    [[nodiscard]] double mean_curvature(bool completed) const {
        return DiskCurvature(points, normals)(disk(), completed).at.mean();
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

TEST_CASE("H has no jump where two of three neighbours come to lie opposite to each other (Lemma 1)") {
    const auto tee = [](double s) { return uneven({0.0, 0.6 * pi, 0.9 * pi + 0.2 * pi * s}); };
    // The chord between those two passes over the vertex: H is steep there, but a finer sweep makes smaller changes.
    // The numbers of steps are odd because exactly above the vertex a direction does not exist.
    CHECK(largest_jump(tee, true, 8001) < 0.35 * largest_jump(tee, true, 2001));
}

TEST_CASE("a finer sweep through the singular configuration makes proportionally smaller changes") {
    const auto cross = [](double s) { return uneven({0.0, 0.4 * pi + 0.2 * pi * s, pi, 1.5 * pi}); };
    CHECK(largest_jump(cross, true, 8000) < 0.3 * largest_jump(cross, true, 2000));
}

TEST_CASE("H has no jump where a chord's arcs pass through a straight line and through an inflection") {
    const auto tilting = [](double s) {
        Wheel wheel = uneven({0.0, 0.5 * pi, pi, 1.5 * pi});
        for (const int k : {1, 2}) {
            const double angle = (k == 1 ? 0.4 : 0.7) * (2.0 * s - 1.0);
            wheel.normals.col(k) = Vector3(std::sin(angle), -std::sin(angle), 1.0).normalized();
        }
        return wheel;
    };
    CHECK(largest_jump(tilting, true) < 1e-3);
}

TEST_CASE("the curvature line's slope is the derivative of H along the normal") {
    const Wheel wheel = Wheel({{1, 0, 0}, {0.2, 1.1, 0}, {-0.9, 0.4, 0}, {-0.5, -0.8, 0}, {0.6, -0.9, 0}});
    DiskCurvature curvature(wheel.points, wheel.normals);
    const auto H = [&](double t) {
        return curvature(wheel.disk(), t * Vector3::UnitZ(), Vector3::UnitZ(), false).at.mean();
    };
    const double slope = curvature(wheel.disk(), false).slope.mean();
    CHECK(slope < 0.0);
    CHECK(slope == doctest::Approx((H(1e-4) - H(-1e-4)) / 2e-4).epsilon(1e-6));
}

TEST_CASE("an undamped update gives a vertex the curvature wanted, at its inner-fairness position") {
    const Wheel wheel = Wheel({{1, 0, 0}, {0.2, 1.1, 0}, {-0.9, 0.4, 0}, {-0.5, -0.8, 0}, {0.6, -0.9, 0}});
    DiskCurvature curvature(wheel.points, wheel.normals);
    const Vector3 mean(0.05, 0.02, 0.3);
    const double wanted = -0.01;
    const Vector3 moved =
        updated_position(wheel.disk(), wheel.points, Vector3::UnitZ(), {mean, wanted, 1.0, false}, curvature);
    CHECK(moved.x() == doctest::Approx(mean.x()));
    CHECK(moved.y() == doctest::Approx(mean.y()));
    CHECK(curvature(wheel.disk(), moved, Vector3::UnitZ(), false).at.mean() == doctest::Approx(wanted).epsilon(1e-3));
}
