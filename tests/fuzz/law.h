// What holds for every call, whatever it was given; a breach ends the process with a message, which the fuzzer keeps.
#pragma once

#include "api/fair.h"

namespace fairing::fuzz {

// Ends the process unless `holds`.
void require(bool holds, const char* what);

// The elements of a refusal or a warning exist in the mesh.
void check_elements(const Diagnostic& diagnostic, const MeshInput& mesh);

// Finite, nothing moved that is fixed or unused, honest about convergence.
void check_fair(const FairResult& result, const MeshInput& mesh, const FairOptions& options);

// Bit for bit the same.
void check_same(const FairResult& one, const FairResult& other);

}  // namespace fairing::fuzz
