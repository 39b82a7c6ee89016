// A libFuzzer target for the native entry points: the first byte chooses one, the others make its arguments.
#include <fuzzer/FuzzedDataProvider.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <memory>
#include <set>

#include "api/fair_solver.h"
#include "api/measure.h"
#include "base/errors.h"
#include "boundary/surrounding_fit.h"
#include "law.h"
#include "mesh/loops.h"
#include "random_mesh.h"
#include "random_options.h"
#include "watchdog.h"

namespace fairing::fuzz {

namespace {

// Says no at the call that was chosen (0: at none) and after a while.
struct Stopper {
    static constexpr std::clock_t patience = CLOCKS_PER_SEC / 4;  // of processor time
    int last;
    int calls = 0;
    double fraction = 0.0;
    std::clock_t begin = std::clock();

    bool operator()(double now, std::string_view stage) {
        Watchdog::restart();
        require(now >= fraction && now <= 1.0 && !stage.empty(), "progress only grows");
        fraction = now;
        return ++calls != last && std::clock() - begin < patience;
    }
};

// A call that may be refused, given up or stopped.
template <typename Call>
void attempt(const MeshInput& mesh, const Call& call) {
    try {
        call();
    } catch (const MeshError& error) {
        check_elements(error.diagnostic(), mesh);
    } catch (const std::invalid_argument&) {
    } catch (const SolverError&) {
    } catch (const Cancelled&) {
    }
}

void fuzz_fair(FuzzedDataProvider& bytes) {
    RandomMesh given = random_mesh(bytes, false);
    MeshInput& mesh = given.input;
    random_boundary(bytes, mesh);
    const FairOptions options = random_options(bytes, static_cast<int>(mesh.vertices.cols()));
    const std::optional<Points> reference = random_reference(bytes, mesh.vertices);
    const bool twice = bytes.ConsumeIntegralInRange(0, 7) == 7;
    const int last = bytes.ConsumeIntegralInRange(0, 60);
    const Points kept = given.points;
    attempt(mesh, [&] {
        const FairResult result = fair(mesh, reference, options, Stopper{last});
        check_fair(result, mesh, options);
        if (twice) check_same(result, fair(mesh, reference, options, {}));
    });
    require(std::memcmp(kept.data(), given.points.data(), sizeof(double) * kept.size()) == 0, "the input stays");
}

// One mesh again and again: moved, with other numbers of vertices, other options and after errors.
void fuzz_solver(FuzzedDataProvider& bytes) {
    RandomMesh given = random_mesh(bytes, false);
    MeshInput& mesh = given.input;
    random_boundary(bytes, mesh);
    const int count = static_cast<int>(mesh.vertices.cols());
    FairOptions options = random_options(bytes, count);
    std::unique_ptr<FairSolver> solver;
    attempt(mesh, [&] { solver = std::make_unique<FairSolver>(mesh.triangles, mesh.fixed, mesh.held, options); });
    if (!solver) return;
    const int solves = bytes.ConsumeIntegralInRange(1, 4);
    for (int k = 0; k < solves; ++k) {
        const std::optional<Points> reference = random_reference(bytes, mesh.vertices);
        attempt(mesh, [&] {
            const FairResult result = solver->solve(given.points, mesh.fixed_normals, {}, reference,
                                                    Stopper{bytes.ConsumeIntegralInRange(0, 60)});
            check_fair(result, mesh, options);
            if (k == 0) check_same(result, fair(mesh, reference, options, {}));
        });
        move(bytes, given);
        if (bytes.ConsumeBool()) continue;
        options = random_options(bytes, count);
        solver->change(options);
    }
}

// Calls `measure` with a mesh that may be refused.
template <typename Measure>
void on_any_mesh(FuzzedDataProvider& bytes, const Measure& measure) {
    RandomMesh mesh = random_mesh(bytes, false);
    random_boundary(bytes, mesh.input);
    attempt(mesh.input, [&] { measure(mesh.input); });
}

void fuzz_mean_curvature(FuzzedDataProvider& bytes) {
    const NormalKind kind = bytes.ConsumeBool() ? NormalKind::averaged : NormalKind::fitted;
    on_any_mesh(bytes, [&](const MeshInput& mesh) {
        const VectorX H = mean_curvature(mesh, kind);
        require(H.size() == mesh.vertices.cols() && H.allFinite(), "H is finite at every vertex");
    });
}

void fuzz_vertex_normals(FuzzedDataProvider& bytes) {
    const NormalKind kind = bytes.ConsumeBool() ? NormalKind::averaged : NormalKind::fitted;
    on_any_mesh(bytes, [&](const MeshInput& mesh) {
        const Points normals = vertex_normals({mesh.vertices, mesh.triangles, {}, {}}, kind);
        require(normals.cols() == mesh.vertices.cols(), "a normal per vertex");
        for (const auto normal : normals.colwise()) {
            require(normal.isZero(0.0) || std::abs(normal.norm() - 1.0) < 1e-12, "normals are unit or zero");
        }
    });
}

void fuzz_cotan_laplacian(FuzzedDataProvider& bytes) {
    const RandomMesh given = random_mesh(bytes, true);
    const MeshInput& mesh = given.input;
    const MatrixEntries entries = cotan_laplacian(mesh.vertices, mesh.triangles);
    require(entries.rows.size() == entries.columns.size() && entries.rows.size() == entries.values.size(),
            "rows, columns and values belong together");
    for (std::size_t k = 0; k < entries.rows.size(); ++k) {
        require(std::max(entries.rows[k], entries.columns[k]) < mesh.vertices.cols(), "entries are in the matrix");
        require(!mesh.vertices.allFinite() || std::isfinite(entries.values[k]), "entries are finite");
    }
}

void fuzz_conformal_distortion(FuzzedDataProvider& bytes) {
    const RandomMesh given = random_mesh(bytes, true);
    const MeshInput& mesh = given.input;
    const Points reference = random_reference(bytes, mesh.vertices).value_or(mesh.vertices);
    const VectorX ratio = conformal_distortion(reference, mesh.vertices, mesh.triangles);
    require(ratio.size() == mesh.triangles.cols() && (ratio.array() >= 1.0).all(), "distortions are 1 or more");
}

void fuzz_boundary_loops(FuzzedDataProvider& bytes) {
    const RandomMesh given = random_mesh(bytes, true);
    const MeshInput& mesh = given.input;
    try {
        std::set<std::pair<int, int>> edges;
        for (const Indices& loop : boundary_loops(mesh.triangles, static_cast<int>(mesh.vertices.cols()))) {
            require(loop.size() >= 2, "a loop has edges");
            for (std::size_t k = 0; k < loop.size(); ++k) {
                require(edges.insert({loop[k], loop[(k + 1) % loop.size()]}).second, "loops use an edge once");
            }
        }
    } catch (const MeshError& error) {
        check_elements(error.diagnostic(), mesh);
    }
}

void fuzz_surrounding_normals(FuzzedDataProvider& bytes) {
    const RandomMesh given = random_mesh(bytes, true);
    const MeshInput& mesh = given.input;
    if (!mesh.vertices.allFinite()) return;
    Indices where(static_cast<int>(mesh.vertices.cols()));
    for (std::size_t v = 0; v < where.size(); ++v) where[v] = static_cast<int>(v);
    const SurroundingNormals result = surrounding_normals(mesh.vertices, mesh.triangles, where);
    require(result.fitted.size() == where.size(), "an answer per vertex");
    for (const auto normal : result.normals.colwise()) {
        require(normal.isZero(0.0) || std::abs(normal.norm() - 1.0) < 1e-12, "normals are unit or zero");
    }
}

}  // namespace

}  // namespace fairing::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fairing::fuzz;
    const Watchdog watchdog;
    FuzzedDataProvider bytes(data, size);
    switch (bytes.ConsumeIntegralInRange(1, 13)) {
        case 1: fuzz_mean_curvature(bytes); break;
        case 2: fuzz_vertex_normals(bytes); break;
        case 4: fuzz_cotan_laplacian(bytes); break;
        case 5: fuzz_conformal_distortion(bytes); break;
        case 6: fuzz_boundary_loops(bytes); break;
        case 7: fuzz_surrounding_normals(bytes); break;
        case 8:
        case 9: fuzz_solver(bytes); break;
        default: fuzz_fair(bytes);
    }
    return 0;
}
