#include "placement/place.h"

#include "base/parallel.h"
#include "placement/first_placement.h"
#include "placement/relax.h"
#include "placement/tears.h"
#include "placement/untangle.h"

namespace fairing {

namespace {

class Placing {
public:
    Placing(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target)
        : problem_(problem), tangential_(tangential), target_(target) {}

    // By the springs; where their folds stay, from where the start itself is. True where nothing is folded: no other
    // start is needed.
    bool from(const Placement& start) {
        Placement placement = start;
        relax(tangential_, target_, placement);
        return from_relaxed(std::move(placement)) || keep_untangled(start);
    }

    bool from_relaxed(Placement placement) {
        const std::size_t folded = folds_of_placement(problem_, target_, placement).size();
        folded_by_springs_ = std::min(folded_by_springs_, folded);
        return keep_untangled(std::move(placement));
    }

    [[nodiscard]] Projected best() && {
        best_->folded_by_springs = folded_by_springs_;
        return std::move(*best_);
    }

private:
    bool keep_untangled(Placement placement) {
        Indices folded = folds_of_placement(problem_, target_, placement);
        while (!folded.empty()) {
            const std::size_t before = folded.size();
            untangle(problem_, target_, placement);
            folded = folds_of_placement(problem_, target_, placement);
            if (folded.size() > few_folds ? 2 * folded.size() > before : folded.size() >= before) break;
        }
        return keep(std::move(placement));
    }

    // The least folded one, of those the evenest; true where nothing is folded.
    bool keep(Placement placement) {
        Indices folded = folds_of_placement(problem_, target_, placement);
        const bool done = folded.empty();
        const double merit = tangential_.merit(placement.points);
        if (!best_ || folded.size() < best_->folded.size() ||
            (folded.size() == best_->folded.size() && merit < merit_)) {
            best_ = Projected{std::move(placement), std::move(folded), 0};
            merit_ = merit;
        }
        return done;
    }

    const Problem& problem_;
    const TangentialStep& tangential_;
    const TargetSurface& target_;
    std::optional<Projected> best_;
    double merit_ = 0.0;
    std::size_t folded_by_springs_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace

Placement at_vertices(const Problem& problem, const TargetSurface& target, const Points& points) {
    Placement placement{{}, points};
    for (int v = 0; v < problem.patch.free_count; ++v) placement.where.push_back(target.at_vertex(v));
    return placement;
}

Placement placed_at(const Problem& problem, const TargetSurface& target, std::vector<SurfacePoint> where) {
    Placement placement{std::move(where), Points(3, problem.patch.vertex_count())};
    placement.points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    for (int v = 0; v < problem.patch.free_count; ++v) put(placement, v, target, placement.where[v]);
    return placement;
}

void put(Placement& placement, int vertex, const TargetSurface& target, const SurfacePoint& where) {
    placement.where[vertex] = where;
    placement.points.col(vertex) = target.position(where);
}

Points normals_at(const Placement& placement, const TargetSurface& target) {
    Points normals(3, static_cast<Eigen::Index>(placement.where.size()));
    for_ranges(static_cast<int>(placement.where.size()), coarse_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) normals.col(v) = target.normal(placement.where[v]);
    });
    return normals;
}

Placement moved(const Placement& placement, const TargetSurface& target, const Points& step) {
    Placement result = placement;
    for_ranges(static_cast<int>(placement.where.size()), fine_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) {
            const Vector3 wanted = placement.points.col(v) + step.col(v);
            put(result, v, target, target.project(wanted, placement.where[v].triangle));
        }
    });
    return result;
}

VectorX carried_over(const Placement& placement, const TargetSurface& target, const VectorX& values,
                     const Problem& problem) {
    VectorX result(problem.patch.vertex_count());
    for (int v = 0; v < problem.patch.free_count; ++v) {
        result[v] = target.interpolate(values, placement.where[v]);
    }
    result.tail(problem.fixed_points.cols()) = values.tail(problem.fixed_points.cols());
    return result;
}

Projected place(const Problem& problem, const TangentialStep& tangential, const OwnMeshSurface& surface,
                const std::optional<Points>& guess) {
    const TargetSurface& target = surface.target;
    Placing placing(problem, tangential, target);
    if (guess && placing.from(by_surface(problem, *guess, surface.mesh.patch, target)))
        return std::move(placing).best();
    placing.from(by_history(problem, surface.history, surface.mesh, target));
    return std::move(placing).best();
}

Projected project_relaxed(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
                          Placement relaxed) {
    Placing placing(problem, tangential, target);
    placing.from_relaxed(std::move(relaxed));
    return std::move(placing).best();
}

void refuse_folds(const Problem& problem, const Projected& projected, Solution& solution) {
    constexpr double tolerated_share = 0.05;  // of the triangles
    const bool senseless = !is_uniform(problem.weights) && static_cast<double>(projected.folded_by_springs) >
                                                               tolerated_share * problem.patch.triangle_count();
    if (!senseless && projected.folded.size() <= problem.tolerated_folds) return;
    solution.termination = Termination::folded;
    solution.bad_triangles = projected.folded;
}

}  // namespace fairing
