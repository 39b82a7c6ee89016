// One function for each topic of the module.
#pragma once

#include <pybind11/pybind11.h>

namespace fairing::bindings {

void bind_fair(pybind11::module_& module);
void bind_fill(pybind11::module_& module);
void bind_fillet(pybind11::module_& module);
void bind_holes(pybind11::module_& module);
void bind_measure(pybind11::module_& module);
void bind_meshing(pybind11::module_& module);
void bind_boundary(pybind11::module_& module);
void bind_shape(pybind11::module_& module);

}  // namespace fairing::bindings
