#include "method/coarse_proxy.h"

#include "base/limits.h"
#include "method/levels.h"
#include "placement/first_placement.h"
#include "placement/tears.h"
#include "placement/untangle.h"
#include "tangential/slide.h"

namespace fairing {

namespace {

// From this many free vertices on the low-passed loop shows what the surface is.
bool begins_low_passed(const Problem& problem, const Traits& traits) {
    return traits.is_large && traits.is_jagged && problem.patch.free_count >= smallest_telling &&
           problem.patch.loop_count() == 1;
}

class CoarseOwnMesh final : public OnOwnMesh {
public:
    CoarseOwnMesh(const Problem& problem, const CoarseStart& start, const Progress& progress)
        : OnOwnMesh(problem, progress), start_(start), levels_(problem, Boundaries::kept, coarsest_size) {}

    [[nodiscard]] Indices sizes() const { return levels_.sizes(); }

private:
    [[nodiscard]] const Problem& source() const override { return levels_.problem(levels_.coarsest()); }

    [[nodiscard]] Points membrane() const override {
        return start_.proxy ? start_.membrane : proxy_membrane(source(), progress_);
    }

    // The source's vertices of a surface of the problem's patch.
    [[nodiscard]] Points on_source(const Points& points) const override {
        return points(Eigen::all, source().patch.to_input);
    }

    // Where this start leads nowhere, a large patch has no better one.
    [[nodiscard]] std::optional<CoarseProxy> known_proxy() const override { return start_.proxy; }

    // Relaxed by inner fairness where that folds nothing; else untangled from the unrelaxed coarsest vertices, if
    // better.
    Projected projected(const SolvedProxy& proxy, const TargetSurface& target,
                        const std::optional<Points>& own) override {
        const bool is_set_up = levels_.work(0).tangential != nullptr;
        for (std::size_t k = levels_.coarsest() + 1; k-- > 0 && !is_set_up;) levels_.set_up_tangential(k, progress_);
        std::vector<Start> starts;
        if (own) starts.push_back(start_from(by_surface(source(), *own, proxy.mesh.patch, target), target));
        starts.push_back(start_from(by_history(source(), proxy.history, proxy.mesh, target), target));
        Start& start = least_folded(starts, target);
        Projected best = without_folds(spread(std::move(start.relaxed), target), target);
        if (!best.folded.empty()) keep_better(unfolded(std::move(start.raw), target), best);
        return best;
    }

    // Keeps the fold count of the first relaxation.
    static void keep_better(Projected other, Projected& best) {
        if (other.folded.size() >= best.folded.size()) return;
        other.folded_by_springs = best.folded_by_springs;
        best = std::move(other);
    }

    // The coarsest level's vertices.
    struct Start {
        Placement raw;
        Placement relaxed;  // by springs
    };

    Start start_from(Placement raw, const TargetSurface& target) {
        Placement relaxed = raw;
        slide(levels_.coarsest(), target, relaxed);
        return {std::move(raw), std::move(relaxed)};
    }

    // A start on the wrong sheet leaves many folds.
    Start& least_folded(std::vector<Start>& starts, const TargetSurface& target) {
        const auto folds = [&](const Start& start) {
            return folds_of_placement(source(), target, start.relaxed).size();
        };
        if (starts.size() == 1) return starts.front();
        return folds(starts[0]) <= folds(starts[1]) ? starts[0] : starts[1];
    }

    Placement spread(Placement placement, const TargetSurface& target) {
        for (std::size_t k = levels_.coarsest(); k-- > 0;) {
            placement = on_finer_level(k, placement, target);
            slide(k, target, placement);
        }
        return placement;
    }

    Projected without_folds(Placement placement, const TargetSurface& target) {
        return project_relaxed(problem_, *levels_.work(0).tangential, target, std::move(placement));
    }

    Projected unfolded(Placement placement, const TargetSurface& target) {
        for (std::size_t k = levels_.coarsest(); k-- > 0;) {
            untangle(levels_.problem(k + 1), target, placement);
            placement = on_finer_level(k, placement, target);
        }
        return without_folds(std::move(placement), target);
    }

    void slide(std::size_t k, const TargetSurface& target, Placement& placement) {
        const int most = k == levels_.coarsest() ? most_iterations : most_slides;
        slide_on(target, *levels_.work(k).tangential, most, placement.where, placement.points);
    }

    // From level k + 1: removed vertices begin at the mean of their neighbours.
    [[nodiscard]] Placement on_finer_level(std::size_t k, const Placement& coarse, const TargetSurface& target) const {
        const Problem& fine = levels_.problem(k);
        const Transfer& transfer = levels_.transfer(k);
        const Removals& removals = transfer.removals;
        Points points = with_fixed(fine.patch, fine.fixed_points);
        std::vector<SurfacePoint> where(fine.patch.vertex_count());
        const int first_fixed = target.vertex_count() - static_cast<int>(fine.fixed_points.cols());
        for (int v = fine.patch.free_count; v < fine.patch.vertex_count(); ++v)
            where[v] = target.at_vertex(first_fixed + v - fine.patch.free_count);
        for (int c = 0; c < transfer.coarse_free_count; ++c) {
            where[transfer.coarse_in_fine[c]] = coarse.where[c];
            points.col(transfer.coarse_in_fine[c]) = coarse.points.col(c);
        }
        for (int r = removals.size(); r-- > 0;) {
            Vector3 mean = Vector3::Zero();
            int nearest = removals.neighbours[removals.begin[r]];
            for (int j = removals.begin[r]; j < removals.begin[r + 1]; ++j)
                mean += double{removals.weights[j]} * points.col(removals.neighbours[j]);
            for (int j = removals.begin[r]; j < removals.begin[r + 1]; ++j) {
                const int other = removals.neighbours[j];
                if ((points.col(other) - mean).squaredNorm() < (points.col(nearest) - mean).squaredNorm())
                    nearest = other;
            }
            const int v = removals.vertex[r];
            where[v] = target.project(mean, where[nearest].triangle);
            points.col(v) = target.position(where[v]);
        }
        where.resize(fine.patch.free_count);
        return {std::move(where), std::move(points)};
    }

    std::optional<Solution> on_users_mesh(const Solution& projected) override {
        Workspace& work = levels_.work(0);
        work.normal = make_normal_operator(problem_, projected.points.leftCols(problem_.patch.free_count));
        return polished(problem_, work, projected, progress_.range(0.6, 1.0));
    }

    const CoarseStart& start_;
    Levels levels_;
};

}  // namespace

CoarseStart::CoarseStart(const Problem& problem, const Traits& traits, const Progress& progress) {
    if (!begins_low_passed(problem, traits)) return;
    const Levels levels(traits.low_passed(), Boundaries::kept, coarsest_size);
    const Problem& coarsest = levels.problem(levels.coarsest());
    membrane = proxy_membrane(coarsest, progress);
    proxy.emplace(solve_coarse_proxy(coarsest, membrane, problem.patch.free_count, progress));
}

std::optional<Solution> solve_on_coarse_proxy(const Problem& problem, const std::optional<OwnSurface>& guess,
                                              Polish polish, const CoarseStart& start, const Progress& progress) {
    if (start.is_in_vain()) return std::nullopt;
    CoarseOwnMesh mesh(problem, start, progress);
    auto solution = mesh.run(guess, polish);
    if (solution) solution->levels = mesh.sizes();
    return solution;
}

}  // namespace fairing
