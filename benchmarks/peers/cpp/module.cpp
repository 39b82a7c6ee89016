// Python module peers_driver: CGAL's fair and the reference systems, positions in, positions out.
#include "bilaplacian.h"
#include "cgal_fair.h"
#include "factor.h"

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>

namespace py = pybind11;

PYBIND11_MODULE(peers_driver, module) {
    py::enum_<CgalSolver>(module, "CgalSolver")
        .value("sparse_lu", CgalSolver::sparse_lu)
        .value("umfpack", CgalSolver::umfpack);
    py::enum_<Method>(module, "Method").value("ldlt", Method::ldlt).value("cholmod", Method::cholmod);
    py::class_<System>(module, "System")
        .def_readonly("load", &System::load)
        .def("factorised",
             [](const System& system, Method method) { return std::make_unique<Factor>(system.matrix, method); });
    py::class_<Factor>(module, "Factor").def("solve", &Factor::solve);
    module.def("cgal_fair", &cgal_fair);
    module.def("bilaplacian_system", &bilaplacian_system);
    module.def("membrane_system", &membrane_system);
}
