#include "api/hole_job.h"

#include <set>

#include "api/remesh.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "fill/proportion.h"
#include "fill/short_edges.h"
#include "fill/small_hole.h"
#include "shape/visible_join.h"

namespace fairing {

namespace {

constexpr int solved_count = 1000;  // free vertices of the mesh that is solved; coarser wishes are cut from its surface
// Holes that take fewer new vertices than that are solved once, over their flat triangulation, with so many at least:
// of 74 random holes in real meshes 300 and 1,000 vertices were as near to what was there (1.12 % of the hole).
constexpr int few_solved = 300;

Indices vertices_of(const Hole& hole) {
    Indices all;
    for (const BoundaryLoop& loop : hole.loops) all.insert(all.end(), loop.vertices.begin(), loop.vertices.end());
    return all;
}

// Vertices of the mesh on curves: they may have no triangle.
Indices drawn(const CurvesThrough* through, const HoledMesh& mesh) {
    if (!through) return {};
    Indices vertices = through->creases;
    std::erase_if(vertices, [&](int v) { return v >= static_cast<int>(mesh.mesh().vertices.cols()); });
    return vertices;
}

// The first surface's equation: harmonic but for the equations that join what no harmonic surface does.
Equation first_equation(const FillOptions& options) {
    const Equation asked = options.fair.solver.equation;
    const bool is_own = asked == Equation::least_variation || asked == Equation::soap_film;
    return is_own ? asked : Equation::harmonic;
}

// Where the solve on a finer mesh of the first surface begins. Automatic chooses that of least variation by itself:
// there it stands in for nothing.
Start start_after(Provenance first, const SolverOptions& options) {
    Start start = is_loft(first) ? Start::loft : Start::given;
    if (first == Provenance::least_variation) start = Start::least_variation;
    const bool is_harmonic = options.equation == Equation::harmonic || options.equation == Equation::automatic;
    const bool is_chosen = options.equation == Equation::automatic && start == Start::least_variation;
    return is_harmonic && options.otherwise != Otherwise::stop && !is_chosen ? start : Start::given;
}

NewSurface first_over(const std::vector<BoundaryLoop>& loops, const SplitBoundary& split, VertexPairs taken,
                      std::optional<Equation> equation, const Progress& progress) {
    ThinnedLoops thin;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        LoopShape shape = loops[l].shape;
        shape.points = split.parted(Eigen::all, split.loops[l]);
        add_thinned(thin, split.loops[l], shape);
    }
    std::optional<SolverOptions> options;
    if (equation) options.emplace().equation = *equation;
    try {
        NewSurface found =
            fill_loops({split.parted, thin.loops, thin.normals, std::move(taken)}, true, options, within(progress));
        found.triangles = thin.with_all(found.triangles);
        return found;
    } catch (const MeshError& error) {
        if (loops.size() < 2 || error.diagnostic().code != Code::nonmanifold_edge) throw;
        throw MeshError(not_joined(loops));
    }
}

bool is_usable(const FairResult& report) { return report.converged && std::ranges::none_of(report.warnings, is_fold); }

}  // namespace

bool is_fold(const Diagnostic& warning) {
    return warning.code == Code::flipped_triangles || warning.code == Code::self_intersection;
}

Points joined(const Points& one, const Points& other) {
    Points both(3, one.cols() + other.cols());
    both << one, other;
    return both;
}

HolePatch meshed(const HolePatch& patch, int old_count, const WantedLengths& wanted, const HeldInside& held,
                 const Progress& progress, NewMesh* made) {
    NewMesh mesh = remesh(patch.input(held), {}, wanted, 1, within(progress));
    const int gone = static_cast<int>(patch.vertices.cols()) - old_count;
    mesh.triangles = mesh.triangles.unaryExpr([&](int v) { return v < old_count + gone ? v : v - gone; });
    HolePatch result{joined(patch.vertices.leftCols(old_count), mesh.vertices), mesh.triangles, patch.fixed,
                     patch.normals, patch.taken};
    if (made) *made = std::move(mesh);
    return result;
}

void measure_join(FairResult& report, const HolePatch& patch, const Triangles& around) {
    if (around.cols() == 0) return;
    const JoinedMesh mesh{report.vertices, patch.triangles, around};
    const VectorX degrees = visible_join(mesh, report.fixed).degrees;
    const std::set<int> outside(around.reshaped().begin(), around.reshaped().end());
    const std::set<int> inside(patch.triangles.reshaped().begin(), patch.triangles.reshaped().end());
    for (Eigen::Index k = 0; k < degrees.size(); ++k) {
        const int v = report.fixed[k];
        if (outside.contains(v) && inside.contains(v)) report.join[k] = degrees[k];
    }
}

ProgressCallback within(const Progress& part) {
    return [part](double fraction, std::string_view stage) {
        part.report(fraction, stage);
        return true;
    };
}

HoleJob::HoleJob(const HoledMesh& mesh, const Hole& hole, const CurvesThrough* through, const FillOptions& options)
    : mesh_(mesh),
      hole_(hole),
      through_(through),
      options_(options),
      local_(mesh.around(vertices_of(hole), drawn(through, mesh))),
      loops_(hole.loops) {
    for (BoundaryLoop& loop : loops_) loop.vertices = local_.local(loop.vertices);
    split_ = split_boundary(loops_, local_.points);
}

double HoleJob::flat_count() const {
    std::vector<LoopShape> shapes;
    shapes.reserve(loops_.size());
    for (const BoundaryLoop& loop : loops_) shapes.push_back(loop.shape);
    return fairing::flat_count(shapes, options_.spacing, options_.bridge);
}

Points HoleJob::normals() const {
    Points all(3, 0);
    for (const BoundaryLoop& loop : loops_) all = joined(all, loop.shape.normals);
    return all;
}

// Edges around, between any copies of vertices of the boundary.
VertexPairs HoleJob::taken() const {
    std::map<int, Indices> copies;
    for (const int v : split_.fixed()) copies[split_.source[v]].push_back(v);
    VertexPairs pairs;
    for (const auto corners : local_.triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            for (const int a : copies[corners[k]])
                for (const int b : copies[corners[(k + 1) % 3]]) pairs.push_back({a, b});
        }
    }
    return pairs;
}

HeldInside HoleJob::held() const {
    HeldInside held = options_.held;
    for (Indices* list : {&held.creases, &held.smooth_curves}) {
        *list = local_.local(*list);
        std::erase(*list, none);
    }
    return held;
}

FilledHole HoleJob::filled(const Progress& progress) const {
    const Stopwatch watch;
    const auto timed = [&](FilledHole made) {
        made.report.seconds["total"] = watch.seconds();
        return made;
    };
    if (auto made = closed_by_face()) return timed(std::move(*made));
    if (through_) {
        if (auto made = along(*through_, progress.range(0.0, 0.5))) return timed(std::move(*made));
    }
    if (auto made = fan(progress)) return timed(finished(std::move(*made), split_));
    const SolverOptions& solver = options_.fair.solver;
    const bool may_differ =
        !options_.bridge && solver.otherwise != Otherwise::stop && solver.equation != Equation::soap_film;
    const double flat = flat_count();
    Limit::of(flat, options_.max_vertices)
        .check(options_.bridge ? flat : fairing::least_count(loops_[0].shape, options_.spacing), vertices_of(hole_));
    const std::optional<SolvedHole> begun = at_once(progress.range(0.0, 0.1));
    const bool is_begun = begun && is_usable(begun->report);
    const bool is_found = is_begun && begun->report.provenance == Provenance::equation;
    if (is_found && !is_stretched(*begun)) return timed(finished(coarser(*begun, progress.range(0.9, 1.0)), split_));
    const NewSurface first =
        is_found ? NewSurface{begun->patch.vertices.rightCols(begun->patch.vertices.cols() - split_.count()),
                              begun->patch.triangles}
                 : first_over(loops_, split_, taken(), first_equation(options_), progress.range(0.1, 0.2));
    // Where none was found on two small meshes and another kind may close the hole, a fine one takes most of the time
    // in vain.
    std::optional<SolvedHole> made;
    if (is_begun && !(first.converged && first.provenance == Provenance::equation)) {
        made = coarser(*begun, progress.range(0.9, 1.0));
    } else if (first.converged || !may_differ) {
        made = surface(first, progress.range(0.2, 0.9));
    }
    if (may_differ && !(made && is_usable(made->report))) {
        if (auto other = film(progress.range(0.9, 0.95))) return timed(std::move(*other));
        if (!made) made = surface(first, progress.range(0.95, 1.0));
    }
    return timed(finished(std::move(*made), split_));
}

std::optional<FilledHole> HoleJob::closed_by_face() const {
    const BoundaryLoop& loop = loops_[0];
    if (options_.bridge || !takes_no_vertex(loop.shape, options_.spacing)) return std::nullopt;
    const std::optional<Triangles> face = face_over(loop, local_.triangles);
    if (!face) return std::nullopt;
    SolvedHole made{{local_.points, *face, loop.vertices, std::nullopt}, {}};
    FairResult& report = made.report;
    const Equation asked = options_.fair.solver.equation;
    report.equation = asked == Equation::automatic ? Equation::harmonic : asked;
    report.joins_curvature = options_.joins_curvature;
    report.vertices = local_.points;
    report.mean_curvature = VectorX::Zero(local_.points.cols());
    report.fixed = loop.vertices;
    report.boundary_angle = angles_of_face(loop, made.patch.triangles);
    report.join = report.boundary_angle;
    measure_join(report, made.patch, local_.triangles);
    return finished(std::move(made), split_);
}

FairResult HoleJob::solved(const HolePatch& patch, Start start, Otherwise otherwise, const Progress& progress) const {
    FairOptions options = options_.fair;
    options.start = start;
    options.solver.otherwise = otherwise;
    MeshInput input = patch.input(held());
    input.outside = local_.triangles;
    if (options_.joins_curvature) {
        VectorX given(static_cast<Eigen::Index>(patch.fixed.size()));
        Eigen::Index first = 0;
        for (const BoundaryLoop& loop : loops_) {
            given.segment(first, loop.curvatures.size()) = loop.curvatures;
            first += loop.curvatures.size();
        }
        input.fixed_curvatures = first > 0 ? given : curvatures_around(patch, local_.triangles);
    }
    FairResult report = fair(std::move(input), {}, options, within(progress));
    measure_join(report, patch, local_.triangles);
    return report;
}

// One surface through nothing, that only has to meet the slopes around.
bool HoleJob::is_plain() const {
    const Equation equation = options_.fair.solver.equation;
    const bool is_usual = equation == Equation::harmonic || equation == Equation::automatic;
    return is_usual && !options_.bridge && !options_.in_rows;
}

std::optional<SolvedHole> HoleJob::fan(const Progress& progress) const {
    if (!is_plain() || options_.joins_curvature || options_.spacing > 0.0 || split_.count() != split_.old_count)
        return std::nullopt;
    const LoopShape& shape = loops_[0].shape;
    const Vector3 hub = shape.points.rowwise().mean();
    if (!takes_hub(shape, hub)) return std::nullopt;
    HolePatch patch{joined(split_.placed, hub), fairing::fan(loops_[0].vertices, split_.count()), split_.fixed(),
                    normals()};
    FairResult report = solved(patch, Start::given, Otherwise::stop, progress);
    if (!report.converged || !takes_hub(shape, report.vertices.rightCols(1))) return std::nullopt;
    patch.vertices = report.vertices;
    return SolvedHole{std::move(patch), std::move(report)};
}

// From a flat mesh, where few vertices are enough and no ball is the better beginning.
std::optional<SolvedHole> HoleJob::at_once(const Progress& progress) const {
    const double own = fairing::flat_count({&loops_[0].shape, 1}, 0.0, false);
    if (!is_plain() || !(std::max(own, flat_count()) < solved_count)) return std::nullopt;
    const NewSurface flat = first_over(loops_, split_, taken(), std::nullopt, progress);
    if (!flat.converged) return std::nullopt;
    SolvedHole made = on_mesh(patch_over(flat), {options_.spacing, few_solved, options_.spread}, Start::given,
                              Otherwise::stop, progress);
    const double count = expected_remesh_count(made.patch.input({}), {options_.spacing, 0, options_.spread});
    if (is_usable(made.report)) Limit::of(flat_count(), options_.max_vertices).check(count, vertices_of(hole_));
    return made;
}

HolePatch HoleJob::patch_over(const NewSurface& surface) const {
    return {joined(split_.parted, surface.vertices), surface.triangles, split_.fixed(), normals(), taken()};
}

// Whether the surface has grown so much that its mesh is too coarse for it: by a half from a flat one. A cap of 60°
// grows by a third, half a ball to twice as much.
bool HoleJob::is_stretched(const SolvedHole& made) const {
    constexpr double most = 1.5;  // see above
    const double count = expected_remesh_count(made.patch.input({}), {options_.spacing, few_solved, options_.spread});
    return count > most * static_cast<double>(made.patch.vertices.cols() - split_.count());
}

SolvedHole HoleJob::on_mesh(const HolePatch& patch, const WantedLengths& wanted, Start start, Otherwise otherwise,
                            const Progress& progress) const {
    HolePatch fine = meshed(patch, split_.count(), wanted, held(), progress.range(0.0, 0.3));
    fine.vertices.leftCols(split_.count()) = split_.placed;
    SolvedHole made{fine, solved(fine, start, otherwise, progress.range(0.3, 1.0))};
    made.patch.vertices = made.report.vertices;
    const Diagnostics slopes = not_tangent(made.report, split_.loops, local_, mesh_);
    made.report.warnings.insert(made.report.warnings.end(), slopes.begin(), slopes.end());
    return made;
}

// On a mesh as coarse as asked for, or on the next finer one that does not fold over the surface's bends.
SolvedHole HoleJob::coarser(const SolvedHole& solved, const Progress& progress) const {
    constexpr int finer = 4;  // times as many vertices: edges half as long
    WantedLengths wanted{options_.spacing, 0, options_.spread};
    for (;;) {
        NewMesh mesh;
        const HolePatch coarse = meshed(solved.patch, split_.count(), wanted, held(), progress, &mesh);
        SolvedHole made = cut_from(solved, coarse, mesh.triangle, mesh.weights);
        wanted.least_count = finer * std::max(1, static_cast<int>(mesh.triangle.size()));
        if (is_usable(made.report) || !is_usable(solved.report)) return made;
        if (wanted.least_count >= solved.patch.vertices.cols() - split_.count()) return solved;
    }
}

// Where the equation has no surface, the one of least area closes the hole: with kinks, which is said.
std::optional<FilledHole> HoleJob::film(const Progress& progress) const {
    FillOptions options = options_;
    options.fair.solver.equation = Equation::soap_film;
    options.fair.solver.load = options.fair.bulge = 0.0;
    options.joins_curvature = false;
    FilledHole made = HoleJob(mesh_, hole_, nullptr, options).filled(progress);
    if (!is_usable(made.report)) return std::nullopt;
    std::erase_if(made.report.warnings, [](const Diagnostic& each) {
        return each.code == Code::not_tangent || each.code == Code::normals_from_patch;
    });
    const double kink = made.report.join.size() > 0 ? made.report.join.maxCoeff() : 0.0;
    made.report.warnings.push_back(
        {Code::no_solution,
         "no fair surface was found over a hole of " + std::to_string(hole_.loops[0].vertices.size()) +
             " edges: the one of least area closes it, with a kink of up to " + std::to_string(std::lround(kink)) + "°",
         made.report.fixed,
         ElementKind::vertex,
         {{"film", 1.0}, {"degrees", kink}}});
    return made;
}

SolvedHole HoleJob::surface(const NewSurface& first, const Progress& progress) const {
    const SolverOptions& solver = options_.fair.solver;
    HolePatch patch = patch_over(first);
    if (solver.equation == Equation::soap_film) patch.normals = std::nullopt;
    WantedLengths wanted{options_.spacing, 0, options_.spread};
    const double count = expected_remesh_count(patch.input({}), wanted);
    Limit::of(flat_count(), options_.max_vertices).check(count, vertices_of(hole_), first.converged);
    const bool is_coarse = count < 0.9 * solved_count;
    wanted.least_count = solved_count;
    const Otherwise otherwise = first.converged ? solver.otherwise : Otherwise::stop;  // it was sought in vain once
    const Progress last = progress.range(0.9, 1.0);
    SolvedHole made = on_mesh(patch, wanted, start_after(first.provenance, solver), otherwise,
                              progress.range(0.0, is_coarse ? 0.9 : 1.0));
    if (options_.in_rows) {
        const auto again = [&](const HolePatch& rows) { return solved(rows, Start::given, Otherwise::stop, last); };
        made = fairing::in_rows(std::move(made), static_cast<int>(loops_.size()), split_.count(), again, last);
    } else if (is_coarse) {
        made = coarser(made, last);
    }
    return made;
}

FilledHole HoleJob::finished(SolvedHole solved, const SplitBoundary& split) const {
    const int mesh_count = static_cast<int>(mesh_.mesh().vertices.cols());
    const int old = std::min<int>(split.count(), static_cast<int>(solved.patch.vertices.cols()));
    const auto number = [&](int v) {
        const int welded = split.welded(v);
        return welded < split.old_count ? local_.to_mesh[welded] : mesh_count + welded - split.old_count;
    };
    FilledHole made;
    for (const BoundaryLoop& loop : hole_.loops) made.loops.push_back(loop.vertices);
    FairResult& report = solved.report;
    if (options_.in_rows && !solved.pairs) solved.pairs = pairs_among(solved, {});
    const Eigen::Index count = solved.patch.vertices.cols() - old;
    made.vertices = solved.patch.vertices.rightCols(count);
    made.triangles = solved.patch.triangles.unaryExpr(number);
    report.mean_curvature = VectorX(report.mean_curvature.tail(count));
    report.vertices.resize(3, 0);
    report.base.resize(3, 0);
    std::transform(report.fixed.begin(), report.fixed.end(), report.fixed.begin(), number);
    for (Diagnostic& warning : report.warnings) {
        if (warning.kind != ElementKind::vertex) continue;
        std::transform(warning.elements.begin(), warning.elements.end(), warning.elements.begin(), number);
        std::sort(warning.elements.begin(), warning.elements.end());
    }
    made.report = std::move(report);
    made.is_cut = solved.is_cut;
    made.pairs = std::move(solved.pairs);
    return made;
}

}  // namespace fairing
