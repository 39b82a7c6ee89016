#include <doctest/doctest.h>

#include "meshes.h"
#include "paper/curvature_equation.h"

using namespace fairing;

namespace {

struct Setting {
    test::Single single = test::single_patch(test::grid(10, 0.3, test::sphere));
    Stiffness stiffness;
    CurvatureEquation equation{single.patch()};

    Setting() {
        FaceGeometry faces;
        faces.update(single.points, single.patch().triangles);
        stiffness.update(faces, single.patch());
        equation.assemble(stiffness);
    }
    // Some data, rough inside.
    [[nodiscard]] VectorX field() const {
        return (17.0 * VectorX::LinSpaced(single.patch().vertex_count(), 0, 1)).array().sin();
    }
    [[nodiscard]] VectorX load() const { return 0.01 * VectorX::LinSpaced(single.patch().free_count, -1, 1); }
};

}  // namespace

TEST_CASE("local and global H-updates have the same limit and leave the boundary data alone") {
    Setting s;
    VectorX swept = s.field();
    VectorX stepped = s.field();
    s.equation.sweep(s.load(), 2000, swept);
    s.equation.conjugate_gradients(s.load(), 200, stepped);
    CHECK((swept - stepped).cwiseAbs().maxCoeff() < 1e-10);
    CHECK(s.equation.defect(s.load(), stepped).cwiseAbs().maxCoeff() < 1e-10);
    const int fixed = s.single.patch().vertex_count() - s.single.patch().free_count;
    CHECK(stepped.tail(fixed) == s.field().tail(fixed));
}

TEST_CASE("constant H solves the homogeneous equation exactly") {
    Setting s;
    VectorX H = VectorX::Constant(s.single.patch().vertex_count(), -1.0);
    const VectorX none_wanted = VectorX::Zero(s.single.patch().free_count);
    CHECK(s.equation.defect(none_wanted, H).cwiseAbs().maxCoeff() < 1e-13);
}
