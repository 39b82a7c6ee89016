// Options and results of solves, as Python knows them.
#pragma once

#include "api/fair.h"
#include "bindings/convert.h"

namespace fairing::bindings {

// Python's options in C++; its groups (fairing/options/groups.py) set them by name.
struct Options {
    FairOptions fair;
    HeldInside held;
};

py::dict to_dict(const FairResult& result);

}  // namespace fairing::bindings
