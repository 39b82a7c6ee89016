#include <doctest/doctest.h>

#include "meshes.h"
#include "outline/feather.h"

using namespace fairing;

namespace {

// The unit square, cut at u = 0.4 into inside (below) and outside.
struct Halves {
    test::Mesh mesh = test::grid(40, 0.0, test::flat);
    Triangles inside;
    Triangles outside;

    Halves() : inside(3, mesh.triangles.cols()), outside(3, mesh.triangles.cols()) {
        int in = 0;
        int out = 0;
        for (const auto t : mesh.triangles.colwise()) {
            const bool below = mesh.points.row(0)(t).mean() < 0.4;
            below ? inside.col(in++) = t : outside.col(out++) = t;
        }
        inside.conservativeResize(3, in);
        outside.conservativeResize(3, out);
    }
};

}  // namespace

TEST_CASE("a feather's weights follow the straight distance from the outline") {
    const Halves halves;
    const VectorX weights = feather_weights(halves.mesh.points, halves.inside, halves.outside, 0.3);
    for (int v = 0; v < weights.size(); ++v) {
        const double share = std::clamp((halves.mesh.points(0, v) - 0.4) / 0.3, 0.0, 1.0);
        CHECK(weights[v] == doctest::Approx(1.0 - share * share * (3.0 - 2.0 * share)).epsilon(1e-9));
    }
}

TEST_CASE("where nothing is outside only the patch has weights") {
    const Halves halves;
    const VectorX weights = feather_weights(halves.mesh.points, halves.inside, Triangles(3, 0), 0.3);
    for (int v = 0; v < weights.size(); ++v) CHECK(weights[v] == (halves.mesh.points(0, v) < 0.41 ? 1.0 : 0.0));
}
