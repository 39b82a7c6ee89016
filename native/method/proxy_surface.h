// The robust strategy: the surface on a mesh of the engine's own, the user's vertices projected onto it, the equation
// then solved on the user's mesh where that carries it.
#pragma once

#include "accept/accept.h"
#include "base/progress.h"
#include "method/plan.h"
#include "operators/normal_operator.h"
#include "placement/place.h"
#include "problem/solution.h"
#include "problem/surface_state.h"
#include "proxy/proxy_solver.h"

namespace fairing {

struct CoarseStart;  // method/coarse_proxy

// Results of the strategies tried so far.
struct Attempts {
    std::vector<Solution> found;  // none of them accepted
    std::vector<StrategyTried> log;
    std::shared_ptr<const CoarseStart> start = {};  // of a large patch on the proxy mesh, once it is known

    // The latest surface on the user's own connectivity, or none.
    [[nodiscard]] const Solution* own_connectivity() const {
        for (std::size_t k = found.size(); k-- > 0;) {
            if (found[k].polished) return &found[k];
        }
        return nullptr;
    }
};

// Where the discrete equation holds on the user's own mesh near the projected vertices, that is the solution. Elsewhere
// it is the projected vertices with the H of the engine's mesh. It ends as `folded` where no placement without folds is
// found, or where the projected mesh crosses itself and the surface does not. What `attempts` have left helps to place
// the vertices. Nothing where no mesh of the engine's own carries the equation.
std::optional<Solution> solve_on_proxy_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                            const Progress& progress);

// The surface between the low-passed loops, where none meets the loops as given. The loops stay as given; the rows of
// vertices next to them follow. Nothing where no surface is found.
std::optional<Solution> solve_low_passed(const Problem& problem, const Traits& traits, Attempts& attempts,
                                         const Progress& progress);

// A surface of the problem's own connectivity that another step has left, positions of all vertices.
struct OwnSurface {
    Points points;
    bool solved;  // the equation holds there

    // Whether a mesh of the engine's own may begin from it.
    [[nodiscard]] bool is_start(const Problem& problem) const;
};

// Solves the discrete equation on the problem's mesh from `projected`, whose vertices lie on a solved surface. Nothing
// where it does not converge or is not accepted. `work` belongs to the problem.
std::optional<Solution> polished(const Problem& problem, Workspace& work, const Solution& projected,
                                 const Progress& progress);

// Whether the equation is solved on the user's mesh, too, where that carries it.
enum class Polish { wanted, unwanted };

// Solves on a proxy mesh, projects the user's vertices onto it, and polishes; the subclasses say what the proxy is made
// from.
class OnOwnMesh {
public:
    OnOwnMesh(const Problem& problem, const Progress& progress) : problem_(problem), progress_(progress) {}
    virtual ~OnOwnMesh() = default;
    OnOwnMesh(const OnOwnMesh&) = delete;
    OnOwnMesh& operator=(const OnOwnMesh&) = delete;

    // `guess`: of the problem's patch.
    std::optional<Solution> run(const std::optional<OwnSurface>& guess, Polish polish);

protected:
    // The problem that the proxy mesh is made from: this one or a coarse level of it; its membrane; the source's part
    // of a surface of this patch.
    [[nodiscard]] virtual const Problem& source() const = 0;
    [[nodiscard]] virtual Points membrane() const = 0;
    [[nodiscard]] virtual Points on_source(const Points& points) const = 0;
    // A coarse proxy that is known, over a boundary next to this one.
    [[nodiscard]] virtual std::optional<CoarseProxy> known_proxy() const { return std::nullopt; }
    // The user's vertices; `own`: the guess, of the source.
    virtual Projected projected(const SolvedProxy& proxy, const TargetSurface& target,
                                const std::optional<Points>& own) = 0;
    // The equation's solution on the user's mesh.
    virtual std::optional<Solution> on_users_mesh(const Solution& projected) = 0;

    const Problem& problem_;
    const Progress& progress_;

private:
    Solution on_surface(const SolvedProxy& proxy, const std::optional<Points>& own, Polish polish);
};

}  // namespace fairing
