// The user's own connectivity, ever coarser, with what is solved on each level.
#pragma once

#include "base/background_task.h"
#include "base/progress.h"
#include "method/plan.h"
#include "multigrid/coarsening.h"
#include "multigrid/tangential_multigrid.h"
#include "operators/normal_operator.h"
#include "problem/problem.h"

namespace fairing {

// Most tangential steps on a level, which starts from the coarser level's surface.
inline constexpr int most_slides = 8;

// Whether coarse levels keep all of the boundary's vertices, or halve it where it is straight.
enum class Boundaries { thinned, kept };

// Level 0 is the problem's patch, `coarsest()` the coarsest one. Refers to the problem.
class Levels {
public:
    // Down to about `coarsest` free vertices. `below`: a problem on the same patch whose boundary the coarse
    // levels take.
    Levels(const Problem& problem, Boundaries boundaries, int coarsest)
        : Levels(problem, problem, boundaries, coarsest) {}
    Levels(const Problem& problem, const Problem& below, Boundaries boundaries, int coarsest);
    Levels(const Levels&) = delete;
    Levels& operator=(const Levels&) = delete;
    ~Levels() = default;

    [[nodiscard]] std::size_t coarsest() const { return coarse_.size(); }
    [[nodiscard]] Problem& problem(std::size_t k) { return levels_[k].problem; }
    [[nodiscard]] const Problem& problem(std::size_t k) const { return levels_[k].problem; }
    [[nodiscard]] Workspace& work(std::size_t k) { return levels_[k].work; }
    // From level k + 1 to level k.
    [[nodiscard]] const Transfer& transfer(std::size_t k) const { return coarse_[k].transfer; }
    [[nodiscard]] RingMatrix laplacian(std::size_t k) const;
    // Vertices of each level, coarse to fine.
    [[nodiscard]] std::vector<int> sizes() const;

    // Makes factors and restrictions of the tangential steps in the background: they need no surface.
    void prepare_beside();

    // Makes the tangential step of a level; that of the next coarser one comes first.
    void set_up_tangential(std::size_t k, RingMatrix laplacian, const Progress& progress);
    void set_up_tangential(std::size_t k, const Progress& progress) { set_up_tangential(k, laplacian(k), progress); }

    // Approximate free vertices of level k, from a surface of level `from`. Safe while other threads `leave` levels.
    [[nodiscard]] Points layout(std::size_t k, std::size_t from, const Points& surface) const;

    // A surface of level k + 1 (3 × local vertices) on level k, with its normals and shape operators. `laplacian`: of
    // level k.
    [[nodiscard]] BentPoints interpolated(std::size_t k, const Points& coarse, const RingMatrix& laplacian) const;

    // Lets go of the edges, rings and weights of a coarse level that is left, or brings edges and rings back.
    void leave(std::size_t k);
    void come_back(std::size_t k);

private:
    struct Level {
        Problem problem;
        int free_count;  // also while the patch is left
        Workspace work = {};
        const LaplaceCycle* tangential_cycle = nullptr;  // in `work`
        std::unique_ptr<FactorisedLaplacian> factor = {};
        std::optional<Restriction> restriction = {};
        BackgroundTask preparing = {};  // makes `factor` or `restriction`; ends before them
    };

    [[nodiscard]] bool is_factorised(std::size_t k) const;
    [[nodiscard]] std::unique_ptr<FactorisedLaplacian> factorised(std::size_t k, const Progress& progress) const;

    std::vector<CoarseLevel> coarse_;  // coarse_[k] lies below levels_[k]
    std::vector<PatchMembers> left_;   // parts of coarse_[k].patch while that is released; empty otherwise
    std::vector<Level> levels_;
};

// The levels of a solve from coarse to fine. No coarse mesh resolves short waves of a boundary: sampled at every second
// vertex they would be noise as large and twice as long. So coarse levels have the low-passed boundary there; only the
// finest one meets the boundary as it is.
Levels levels_of(const Problem& problem, const Traits& traits, int coarsest);

// A value for all vertices of which only the fixed ones are known; 0 at free ones.
Points with_fixed(const Patch& patch, const Points& fixed);

}  // namespace fairing
