// What the engine throws.
#pragma once

#include <stdexcept>
#include <utility>

#include "base/diagnostic.h"

namespace fairing {

// Input that can't be faired; the caller's data is untouched.
class MeshError : public std::invalid_argument {
public:
    explicit MeshError(Diagnostic diagnostic)
        : std::invalid_argument(diagnostic.message), diagnostic_(std::move(diagnostic)) {}
    [[nodiscard]] const Diagnostic& diagnostic() const noexcept { return diagnostic_; }

private:
    Diagnostic diagnostic_;
};

// A numerical breakdown (a factorisation that fails); the caller's data is untouched.
class SolverError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The progress callback asked to stop; the caller's data is untouched.
class Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("cancelled by the progress callback") {}
};

}  // namespace fairing
