
#include "api/hole_job.h"
#include "api/remesh.h"
#include "fill/short_edges.h"

namespace fairing {

std::optional<FilledHole> HoleJob::along(const CurvesThrough& through, const Progress& progress) const {
    const int count = static_cast<int>(mesh_.mesh().vertices.cols());
    const int here = static_cast<int>(local_.points.cols());
    const auto number = [&](int v) { return v < count ? local_.local(v) : here + v - count; };
    const auto numbers = [&](Indices list) {
        std::transform(list.begin(), list.end(), list.begin(), number);
        return list;
    };
    const Points points = joined(local_.points, through.added);
    ThinnedLoops thin;
    for (std::size_t l = 0; l < through.loops.size(); ++l) {
        const Indices loop = numbers(through.loops[l]);
        add_thinned(thin, loop, {points(Eigen::all, loop), through.normals[l]});
    }
    SolverOptions film;
    film.equation = Equation::soap_film;
    const VertexPairs outer = taken();
    const NewSurface first =
        fill_loops({points, thin.loops, thin.normals, outer}, false, film, within(progress.range(0.0, 0.2)));
    HolePatch patch{joined(points, first.vertices), thin.with_all(first.triangles), loops_[0].vertices, std::nullopt,
                    outer};
    const HeldInside held{numbers(through.creases), {}};
    Points slopes = normals();
    for (const int v : held.creases) {
        if (std::find(patch.fixed.begin(), patch.fixed.end(), v) != patch.fixed.end()) continue;
        patch.fixed.push_back(v);
        slopes = joined(slopes, slopes.col(0));
    }
    HolePatch made = meshed(patch, here + static_cast<int>(through.added.cols()),
                            {options_.spacing, 0, options_.spread}, held, progress.range(0.2, 0.4));
    made.normals = slopes;
    FairOptions options = options_.fair;
    options.solver.equation = Equation::least_variation;
    options.solver.load = options.bulge = 0.0;
    MeshInput input = made.input(held);
    SolvedHole result{made, fair(std::move(input), {}, options, within(progress.range(0.4, 1.0)))};
    if (!result.report.converged) return std::nullopt;
    result.patch.vertices = result.report.vertices;
    measure_join(result.report, made, local_.triangles);
    for (std::size_t k = 0; k < result.report.fixed.size(); ++k) {
        if (result.report.fixed[k] >= here) result.report.join[static_cast<Eigen::Index>(k)] = 0.0;
    }
    if (options_.in_rows) {
        VertexPairs kept = through.edges;
        for (auto& [a, b] : kept) {
            a = number(a);
            b = number(b);
        }
        result.pairs = pairs_among(result, kept);
        result.report.warnings.push_back(no_rows(hole_.loops[0].vertices, "curves", "edges that stay run through it"));
    }
    FilledHole filled = finished(std::move(result), split_);
    filled.along_curves = true;
    return filled;
}

}  // namespace fairing
