#include "api/levels.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"

namespace fairing::bindings {

namespace {

py::list hierarchy_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed,
                          int levels) {
    PythonRun run;
    const MeshInput input{view_points(vertices), to_triangles(triangles), to_optional(fixed, to_indices), {}};
    const std::vector<MeshLevel> result =
        run.without_gil([&](const ProgressCallback&) { return mesh_hierarchy(input, levels); });
    py::list list;
    for (const MeshLevel& level : result) {
        list.append(py::make_tuple(from_indices(level.vertices), from_triangles(level.triangles)));
    }
    return list;
}

}  // namespace

void bind_hierarchy(py::module_& module) {
    module.def("hierarchy", &hierarchy_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("levels"));
}

}  // namespace fairing::bindings
