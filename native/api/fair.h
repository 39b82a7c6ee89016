// The whole call: checks, patches, one solve for each component, result.
#pragma once

#include "api/input.h"
#include "base/progress.h"
#include "paper/paper_solver.h"
#include "problem/solution.h"
#include "shape/girth.h"

namespace fairing {

enum class Method { global, paper };

// Where a solve begins: the boundary alone; the vertices given, where they lead to a surface, or kept where not; or,
// where the equation was seen to have none, what was taken in its place.
enum class Start { boundary, given, kept, least_variation, loft, smoothed };

// The detail of the reference that is put back on the fair surface (detail/skin.h). With it vertices sit conformally to
// the base of the reference, whatever `inner_fairness` says.
struct DetailOptions {
    double share = 0.0;  // 0 … 1; 0: nothing
    double size = 0.0;   // what is shorter than this, in units of D, counts as detail; 0: detail_wavelength
};

struct FairOptions {
    SolverOptions solver;  // the load in units of length⁻³
    double bulge = 0.0;  // of the constant equation: adds 8 bulge / a³ to the load, a: the component's boundary_radius
    Method method = Method::global;
    Start start = Start::boundary;  // of Method::global
    PaperOptions paper;
    InnerFairness inner_fairness = InnerFairness::uniform;
    // Edges (input vertices) that uniform weights use instead of the triangles' own.
    std::optional<std::vector<std::array<int, 2>>> neighbours;
    InnerWeights custom;  // λ of input vertices, for InnerFairness::custom
    DetailOptions detail;
    double pin_radius = 0.0;  // in units of D; 0: pins act in a point
    int threads = 0;          // 0: one on each core; the result doesn't depend on it
    bool repeated = false;    // answers and factorisations are kept for later solves; FairSolver sets it
};

struct FairResult {
    Equation equation = Equation::harmonic;        // that holds: least_variation where any component took a stand-in
    Provenance provenance = Provenance::equation;  // the components' last in the order of the enumeration
    Points vertices;
    Points base;  // without detail: the fair surface, which all figures below are about; no columns: `vertices`
    Indices fixed;
    VectorX mean_curvature;  // eq. 8: −1/R on a sphere with outward normals; the mean of the sides on cut curves
    VectorX boundary_angle;  // degrees, in the order of `fixed`
    VectorX join;            // likewise: how visible the boundary is from the patch's side
    std::optional<GirthRange> girth;  // the worst of all components between tube ends; nothing where there are none
    bool joins_curvature = true;      // G2, wherever a curvature was known
    bool converged = true;
    bool polished = true;
    Termination termination = Termination::converged;
    int iterations = 0;
    double residual = 0.0;
    double initial_residual = 0.0;
    Indices levels;
    std::map<std::string, double> seconds;
    std::vector<StrategyTried> strategies;  // of all components, in their order
    Diagnostics warnings;
};

// Receives all vertices with the first surface (method/nested) before a better one is sought. Called
// once, by the calling thread.
using Preview = std::function<void(const Points& vertices)>;

// `reference`: M0 of the inner-fairness weights; the input's vertices where it is left out.
// Throws what check_mesh throws, NO_FREE_VERTICES, NO_BOUNDARY, SolverError, MemoryShortage and Cancelled.
FairResult fair(MeshInput input, const std::optional<View<Points>>& reference, const FairOptions& options,
                const ProgressCallback& progress, const Preview& preview = {});

}  // namespace fairing
