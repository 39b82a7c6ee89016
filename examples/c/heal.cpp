// The C library from C++: a bumpy dome over a grid is selected and becomes the fair continuation of the slope around
// it. Build it against the installed package: tests/c/CMakeLists.txt.
#include <fairing.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Mesh {
    std::vector<double> points;  // x y z of each
    std::vector<int> triangles;  // three vertices each, counter-clockwise from above
};

// A piece of a paraboloid over (size + 1)² points.
Mesh paraboloid(int size) {
    Mesh mesh;
    for (int row = 0; row <= size; ++row) {
        for (int column = 0; column <= size; ++column) {
            const double x = 2.0 * column / size - 1.0, y = 2.0 * row / size - 1.0;
            mesh.points.insert(mesh.points.end(), {x, y, 0.2 * (x * x + y * y)});
        }
    }
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const int a = row * (size + 1) + column, c = a + size + 2;
            mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, c, a, c, c - 1});
        }
    }
    return mesh;
}

// What a plug-in does: a mesh and a selection in, the healed mesh out; an exception where that can't be.
Mesh healed(const Mesh& mesh, const std::vector<unsigned char>& selected) {
    fairing_result* raw = nullptr;
    fairing_error error;
    const fairing_status status =
        fairing_fair_faces(mesh.points.data(), mesh.points.size() / 3, mesh.triangles.data(), mesh.triangles.size() / 3,
                           selected.data(), nullptr, nullptr, nullptr, &raw, &error);
    if (status != FAIRING_OK) throw std::runtime_error(std::string(error.code) + " " + error.message);
    const std::unique_ptr<fairing_result, decltype(&fairing_free)> result(raw, fairing_free);
    for (int k = 0; k < fairing_warning_count(raw); ++k) std::puts(fairing_warning_message(raw, k));
    if (!fairing_converged(raw)) throw std::runtime_error(fairing_termination(raw));
    const double* points = fairing_points(raw);
    return {{points, points + mesh.points.size()}, mesh.triangles};
}

double worst_distance(const Mesh& one, const Mesh& other) {
    double worst = 0.0;
    for (std::size_t k = 2; k < one.points.size(); k += 3)
        worst = std::fmax(worst, std::fabs(one.points[k] - other.points[k]));
    return worst;
}

}  // namespace

int main() {
    const int size = 24;
    const Mesh smooth = paraboloid(size);
    Mesh bumpy = smooth;
    std::vector<unsigned char> selected(smooth.triangles.size() / 3);
    for (int row = 8; row < 16; ++row) {
        for (int column = 8; column < 16; ++column) {
            const int quad = row * size + column;
            selected[2 * quad] = selected[2 * quad + 1] = 1;
            if (row > 8 && column > 8) bumpy.points[3 * (row * (size + 1) + column) + 2] += 0.02 * std::sin(7.0 * quad);
        }
    }
    const double before = worst_distance(bumpy, smooth), after = worst_distance(healed(bumpy, selected), smooth);
    std::printf("off the paraboloid: %.4f before, %.4f after\n", before, after);
    return after < 0.2 * before ? EXIT_SUCCESS : EXIT_FAILURE;
}
