#include "placement/place.h"

#include "placement/first_placement.h"
#include "placement/folds.h"
#include "placement/relax.h"
#include "placement/untangle.h"

namespace fairing {

namespace {

class Placing {
public:
    Placing(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
            const Progress& progress)
        : problem_(problem), tangential_(tangential), target_(target), progress_(progress) {}

    // True where nothing is folded: no other way is needed.
    bool by_springs(const Placement& start) {
        Placement placement = start;
        settle(problem_, tangential_, target_, placement, progress_.here());
        return keep_untangled(std::move(placement));
    }

    // Springs that hold folds back are good from a start that is nearly free of them, and harmful from a folded one.
    bool by_held_springs(Placement start) {
        untangle(problem_, target_, start);
        relax(problem_, tangential_, target_, start, Folds::held_back);
        return keep_untangled(std::move(start));
    }

    [[nodiscard]] Placed best() && { return std::move(*best_); }

private:
    bool keep_untangled(Placement placement) {
        Indices folded = folded_triangles(problem_, target_, placement);
        if (!folded.empty()) {
            untangle(problem_, target_, placement);
            relax(problem_, tangential_, target_, placement, Folds::held_back);
            folded = folds_of_placement(problem_, target_, placement);
        }
        const bool done = folded.empty();
        const double merit = tangential_.merit(placement.points, normals_at(placement, target_));
        if (!best_ || folded.size() < best_->folded.size() ||
            (folded.size() == best_->folded.size() && merit < merit_)) {
            best_ = Placed{std::move(placement), std::move(folded)};
            merit_ = merit;
        }
        return done;
    }

    const Problem& problem_;
    const TangentialStep& tangential_;
    const TargetSurface& target_;
    const Progress& progress_;
    std::optional<Placed> best_;
    double merit_ = 0.0;
};

}  // namespace

Placed place(const Problem& problem, const TangentialStep& tangential, const SolvedProxy& proxy,
             const TargetSurface& target, const std::optional<Points>& guess, const Progress& progress) {
    std::vector<Placement> starts;
    if (guess) starts.push_back(by_surface(problem, *guess, proxy.mesh.patch, target));
    Placing placing(problem, tangential, target, progress);
    if (!starts.empty() && placing.by_springs(starts.front())) return std::move(placing).best();
    starts.push_back(by_history(problem, proxy.history, proxy.mesh, target));
    if (placing.by_springs(starts.back())) return std::move(placing).best();
    for (Placement& start : starts) {
        if (placing.by_held_springs(std::move(start))) break;
    }
    return std::move(placing).best();
}

}  // namespace fairing
