// What the functions of the C library share.
#pragma once

#include <span>

#include "api/fair.h"
#include "c/fairing.h"

namespace fairing::c {

// Runs the work; what it throws becomes a status.
fairing_status guarded(fairing_error* error, const std::function<void()>& work);

// Throws std::invalid_argument with the message where it does not hold.
void require(bool holds, const char* message);

// Throw INDEX_RANGE for vertices that do not exist.
void check_indices(std::span<const int> triangles, std::size_t point_count);

FairOptions to_options(const fairing_options& given);

ProgressCallback calling(fairing_progress progress, void* user);

double largest(const VectorX& values);

}  // namespace fairing::c
