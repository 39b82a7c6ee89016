// The equation on a mesh of the engine's own: for connectivity that can't carry it.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"
#include "proxy/proxy_mesh.h"

namespace fairing {

// The surface of a proxy, a target for the user's vertices.
struct SolvedProxy {
    ProxyMesh history;         // its vertices and how they came to be, by number
    ProxyMesh::Snapshot mesh;  // patch and positions, units of D
    Solution solution;         // of the patch of `mesh`
    Points normals;            // at its vertices
};

// Least number of `shown` for which a coarse proxy predicts finer ones.
inline constexpr int smallest_telling = 5000;

// How a coarse proxy ended. `near`: a fine one may find a surface all the same.
enum class CoarseEnd { converged, near, far };

struct CoarseProxy {
    ProxyMesh mesh;  // on the harmonic surface where that was found, or on the least bent one
    CoarseEnd end;
};

// Willmore descent from the membrane with flips and smoothing in between, then the accurate iteration. `shown`: free
// vertices of the user's mesh, of which the problem may be a coarse level; a proxy of many more would resolve what that
// mesh can't represent.
CoarseProxy solve_coarse_proxy(const Problem& problem, const Points& membrane, int shown, const Progress& progress);

// On a proxy refined from `coarse` or from one made from `membrane`; where that fails on the next finer one. `coarse`
// may have converged over another boundary next to this one. Nothing where no proxy converges.
std::optional<SolvedProxy> solve_proxy(const Problem& problem, std::optional<CoarseProxy> coarse,
                                       const Points& membrane, int shown, const Progress& progress);

// From positions of all vertices of the problem's patch near the surface. Nothing where it does not converge.
std::optional<SolvedProxy> solve_proxy_near(const Problem& problem, const Points& near, int shown,
                                            const Progress& progress);

// Free vertices of a mesh of the engine's own beside `shown` ones of the user's; many more would resolve what these
// can't show.
int free_limit(int shown);

// Edge lengths of fine proxies from a surface that is near.
Sizing fine_sizing(int shown);

// Mean length of the boundary loops' edges; 0 without any.
double mean_boundary_edge(const Problem& problem);

// The membrane of the boundary by uniform weights, 3 × vertices of the problem's patch.
Points proxy_membrane(const Problem& problem, const Progress& progress);

}  // namespace fairing
