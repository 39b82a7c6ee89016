// Options of a call from a fuzzer's bytes: within what the Python package lets through.
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include "api/fair.h"

namespace fairing::fuzz {

// For a mesh of `vertex_count` vertices; iterations are few, so that a call is short.
FairOptions random_options(FuzzedDataProvider& bytes, int vertex_count);

// The input's vertices, moved; nothing where `reference` is to be left out.
std::optional<Points> random_reference(FuzzedDataProvider& bytes, const Points& vertices);

}  // namespace fairing::fuzz
