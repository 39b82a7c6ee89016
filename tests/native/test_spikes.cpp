#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "geometry/spikes.h"
#include "meshes.h"

using namespace fairing;

namespace {

bool has_spike_of(const std::function<Vector3(double, double)>& surface, double radius) {
    const test::Single single = test::single_patch(test::grid(40, 0.2, surface));
    return has_spike(single.patch(), single.points, radius);
}

// Its tip at the middle of the square; `lean`: degrees between its sides and its axis.
std::function<Vector3(double, double)> cone(double lean) {
    return [steepness = 1.0 / std::tan(lean * std::numbers::pi / 180.0)](double u, double v) {
        return Vector3(u, v, -steepness * std::hypot(u - 0.5, v - 0.5));
    };
}

}  // namespace

TEST_CASE("cones that lean by less than 45 degrees are spikes") {
    for (const double radius : {0.1, 0.2}) {
        CHECK(has_spike_of(cone(40.0), radius));
        CHECK_FALSE(has_spike_of(cone(50.0), radius));
    }
}

TEST_CASE("edges, spheres and planes are no spikes, a hair longer than the radius is") {
    const auto roof = [](double u, double v) { return Vector3(u, v, -4.0 * std::abs(u - 0.5)); };
    CHECK_FALSE(has_spike_of(roof, 0.2));
    CHECK_FALSE(has_spike_of(test::flat, 0.2));
    CHECK_FALSE(has_spike_of(test::sphere, 0.5));
    const auto hair = [](double u, double v) { return Vector3(u, v, std::hypot(u - 0.5, v - 0.5) < 0.02 ? 0.4 : 0.0); };
    CHECK(has_spike_of(hair, 0.3));
    CHECK_FALSE(has_spike_of(hair, 0.6));  // the turn at its foot is opposite
}
