// The engine's own mesh of a patch with the surface solved on it.
#pragma once

#include <optional>

#include "base/progress.h"
#include "proxy/proxy_mesh.h"
#include "variation/newton.h"

namespace fairing {

// A state of the mesh, the surface at its vertices, and how the solve there ended.
struct SolvedSheet {
    ProxyMesh::Snapshot mesh;
    Sheet sheet;
    NewtonResult result;
};

// The same boundary on another connectivity, with uniform weights. `patch` must outlive the problem.
Problem on_patch(const Problem& problem, const Patch& patch);

// A solved surface at the vertices of a later state of its mesh.
Sheet resampled(const SolvedSheet& solved, const ProxyMesh::Snapshot& later);

// Minimises on the present state of the mesh, from the last surface or else from the mesh's points, and moves the
// mesh there.
SolvedSheet solve_on(ProxyMesh& mesh, const Problem& problem, const std::optional<SolvedSheet>& last, Measure measure,
                     const NewtonLimits& limits, const Progress& progress);

}  // namespace fairing
