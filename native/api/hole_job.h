// How one hole is filled: by curves, one face, a fan, or a surface with several vertices inside.
#pragma once

#include "api/fill.h"
#include "api/remesh.h"
#include "boundary/surrounding_fit.h"
#include "fill/split_boundary.h"

namespace fairing {

// Triangles over a hole's boundary, with the boundary data. Vertices: those of the split boundary, then new ones.
struct HolePatch {
    Points vertices;
    Triangles triangles;
    Indices fixed;
    std::optional<Points> normals;  // at `fixed`; none for minimal surfaces
    VertexPairs taken = {};         // pairs of boundary vertices joined by an edge outside

    [[nodiscard]] MeshInput input(const HeldInside& held) const {
        return {vertices, triangles, fixed, normals, std::nullopt, Triangles(3, 0), held, taken};
    }
};

struct SolvedHole {
    HolePatch patch;
    FairResult report;
    bool is_cut = false;
    std::optional<VertexPairs> pairs = {};
};

class HoleJob {
public:
    // Keeps references.
    HoleJob(const HoledMesh& mesh, const Hole& hole, const CurvesThrough* through, const FillOptions& options);

    // Throws MeshError, SolverError, MemoryShortage, Cancelled.
    [[nodiscard]] FilledHole filled(const Progress& progress) const;

    // Expected number of new vertices if the surface were flat.
    [[nodiscard]] double flat_count() const;

private:
    [[nodiscard]] std::optional<FilledHole> closed_by_face() const;
    [[nodiscard]] std::optional<SolvedHole> fan(const Progress& progress) const;
    [[nodiscard]] std::optional<FilledHole> along(const CurvesThrough& through, const Progress& progress) const;
    [[nodiscard]] SolvedHole surface(const NewSurface& first, const Progress& progress) const;
    [[nodiscard]] std::optional<SolvedHole> at_once(const Progress& progress) const;
    [[nodiscard]] bool is_stretched(const SolvedHole& made) const;
    [[nodiscard]] HolePatch patch_over(const NewSurface& surface) const;
    [[nodiscard]] SolvedHole on_mesh(const HolePatch& patch, const WantedLengths& wanted, Start start,
                                     Otherwise otherwise, const Progress& progress) const;
    [[nodiscard]] SolvedHole coarser(const SolvedHole& solved, const Progress& progress) const;
    [[nodiscard]] std::optional<FilledHole> film(const Progress& progress) const;
    [[nodiscard]] bool is_plain() const;
    [[nodiscard]] FilledHole finished(SolvedHole solved, const SplitBoundary& split) const;
    [[nodiscard]] FairResult solved(const HolePatch& patch, Start start, Otherwise otherwise,
                                    const Progress& progress) const;
    [[nodiscard]] HeldInside held() const;
    [[nodiscard]] Points normals() const;
    [[nodiscard]] VertexPairs taken() const;

    const HoledMesh& mesh_;
    const Hole& hole_;
    const CurvesThrough* through_;  // null where nothing runs through
    const FillOptions& options_;
    LocalMesh local_;
    std::vector<BoundaryLoop> loops_;  // in local numbers
    SplitBoundary split_;
};

// Whether it says that triangles of the patch fold over or cross.
bool is_fold(const Diagnostic& warning);

// The callback that reports a part of a run.
ProgressCallback within(const Progress& part);

Points joined(const Points& one, const Points& other);

// A new mesh for a patch on the first `old_count` of its vertices and new ones.
HolePatch meshed(const HolePatch& patch, int old_count, const WantedLengths& wanted, const HeldInside& held,
                 const Progress& progress, NewMesh* made = nullptr);

// The join measured on the triangles outside, at the vertices that have some.
void measure_join(FairResult& report, const HolePatch& patch, const Triangles& around);

// NaN where a fit is far less certain than the others.
VectorX trusted_curvatures(const SurroundingNormals& fits);
// G2: mean curvatures at `fixed` of what lies around a patch, NaN where they are not known; signed by the normals.
VectorX curvatures_around(const HolePatch& patch, const Triangles& around);

// A pattern of quads on a surface, each as two triangles.
struct Rows {
    HolePatch patch;
    Indices triangle;  // under each new vertex, and its place there
    Points weights;
    VertexPairs pairs;
};

// On the first `old_count` vertices of a solved patch and new ones; nothing where no pattern fits.
std::optional<Rows> rows_over(const HolePatch& solved, int old_count, const Progress& progress);

// A pattern of quads in rows over a solved patch, and the equation on it where it is fine enough; the same patch, with
// a warning, where no pattern fits. `solve`: solves on such a patch, from its positions; `loops`: how many it joins.
using SolveAgain = std::function<FairResult(const HolePatch&)>;
SolvedHole in_rows(SolvedHole solved, int loops, int old_count, const SolveAgain& solve, const Progress& progress);

// Another mesh on the surface: its new vertices come last, each on a triangle of the solved patch.
SolvedHole cut_from(const SolvedHole& solved, const HolePatch& patch, const Indices& triangle, const Points& weights);

// Pairs of triangles that make the best quads where no pattern fits; never across edges `kept`.
VertexPairs pairs_among(const SolvedHole& solved, const VertexPairs& kept);

// NO_QUAD_ROWS: why quads are pairs of triangles. `why` is also the figure.
Diagnostic no_rows(Indices loop, const char* why, const char* text);

// NOT_TANGENT with the boundary's vertices where the surface turns back, or where a thin wall asks for finer edges.
Diagnostics not_tangent(const FairResult& report, const std::vector<Indices>& loops, const LocalMesh& around,
                        const HoledMesh& mesh);

}  // namespace fairing
