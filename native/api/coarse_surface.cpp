#include "api/coarse_surface.h"

#include "accept/accept.h"
#include "api/assembly.h"
#include "api/component.h"
#include "fill/first_surface.h"

namespace fairing {

namespace {

// The vertices of some loops, numbered anew in the loops' order.
struct OutlineData {
    Indices to_input;
    std::vector<Indices> loops;
    Points points;
    Points normals;
};

OutlineData gathered(const OpenLoops& input, std::span<const int> chosen) {
    OutlineData data;
    std::vector<Vector3> normals;
    for (const int l : chosen) {
        Indices& loop = data.loops.emplace_back();
        const Indices& given = input.loops[l];
        for (std::size_t k = 0; k < given.size(); ++k) {
            loop.push_back(static_cast<int>(data.to_input.size()));
            data.to_input.push_back(given[k]);
            normals.emplace_back(input.normals[l].col(static_cast<Eigen::Index>(k)));
        }
    }
    data.points = gather(input.vertices, data.to_input);
    data.normals = as_columns(normals);
    return data;
}

}  // namespace

NewSurface fill_loops(const OpenLoops& input, bool bridge, const SolverOptions& options,
                      const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    const int count = static_cast<int>(input.loops.size());
    const int surfaces = bridge ? 1 : count;
    Assembly assembly(static_cast<int>(input.vertices.cols()));
    NewSurface result;
    for (int s = 0; s < surfaces; ++s) {
        const Progress part = progress.range(double(s) / surfaces, double(s + 1) / surfaces);
        part.report(0.0, "triangulation");
        Indices chosen{s};
        for (int l = 1; bridge && l < count; ++l) chosen.push_back(l);
        const OutlineData data = gathered(input, chosen);
        const Normalisation unit = normalise(data.points);
        const Points points = unit.to_unit(data.points);
        const FirstSurface first = first_surface({points, data.normals, data.loops}, options, part.range(0.1, 1.0));
        const int free_count = first.patch.free_count;
        assembly.add(first.patch.triangles, unit.from_unit(first.solution.points.leftCols(free_count)), data.to_input);
        result.converged = result.converged && end_of(first.solution) == Termination::converged;
        const Provenance kind = first.solution.provenance;
        result.provenance = s == 0 || result.provenance == kind ? kind : Provenance::equation;
    }
    result.vertices = assembly.points();
    result.triangles = assembly.triangles();
    return result;
}

}  // namespace fairing
