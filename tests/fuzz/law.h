// What holds for every call, whatever it was given; a breach ends the process with a message, which the fuzzer keeps.
#pragma once

#include "api/fair.h"
#include "api/levels.h"

namespace fairing::fuzz {

// Ends the process unless `holds`.
void require(bool holds, const char* what);

// The elements of a refusal or a warning exist in the mesh.
void check_elements(const Diagnostic& diagnostic, const MeshInput& mesh);

// Finite, nothing moved that is fixed or unused, honest about convergence.
void check_fair(const FairResult& result, const MeshInput& mesh, const FairOptions& options);

// Bit for bit the same.
void check_same(const FairResult& one, const FairResult& other);

// Coarse to fine, nested, the finest one whole.
void check_levels(const std::vector<MeshLevel>& levels, const MeshInput& mesh);

}  // namespace fairing::fuzz
