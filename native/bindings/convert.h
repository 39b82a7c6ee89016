// numpy ↔ Eigen. An (n, 3) C-ordered array and a 3 × n column-major matrix share their memory layout.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "base/errors.h"

namespace fairing::bindings {

namespace py = pybind11;

// fairing.Diagnostic of the Python package.
py::object from_diagnostic(const Diagnostic& diagnostic);

// MeshError, SolverError and Cancelled become the exceptions of the package that this module is in, whatever its name:
// Blender's add-on has a copy under a name of its own. To be called before anything else.
void register_errors(const py::module_& module);

// A new reference.
py::handle read_only(py::array array);

// The numbers of an array that lie one after the other, converted as NumPy converts them; empty: no array.
template <typename Scalar>
using Numbers = py::array_t<Scalar, py::array::c_style | py::array::forcecast>;

template <typename Scalar>
Numbers<Scalar> numbers(py::handle source) {
    auto array = Numbers<Scalar>::ensure(source);
    if (!array) PyErr_Clear();
    return array;
}

}  // namespace fairing::bindings

// Arrays handed out are read-only copies.
namespace pybind11::detail {

// A column for each row.
template <typename Scalar, int Rows>
struct type_caster<Eigen::Matrix<Scalar, Rows, Eigen::Dynamic>> {
    using Columns = Eigen::Matrix<Scalar, Rows, Eigen::Dynamic>;
    PYBIND11_TYPE_CASTER(Columns, const_name("numpy.ndarray"));
    bool load(handle source, bool /*convert*/) {
        const auto array = fairing::bindings::numbers<Scalar>(source);
        if (!array) return false;
        value = Eigen::Map<const Columns>(array.data(), Rows, array.shape(0));
        return true;
    }
    static handle cast(const Columns& columns, return_value_policy /*policy*/, handle /*parent*/) {
        return fairing::bindings::read_only(array_t<Scalar>({columns.cols(), columns.rows()}, columns.data()));
    }
};

template <>
struct type_caster<Eigen::VectorXd> {
    PYBIND11_TYPE_CASTER(Eigen::VectorXd, const_name("numpy.ndarray"));
    bool load(handle source, bool /*convert*/) {
        const auto array = fairing::bindings::numbers<double>(source);
        if (!array) return false;
        value = Eigen::Map<const Eigen::VectorXd>(array.data(), array.size());
        return true;
    }
    static handle cast(const Eigen::VectorXd& values, return_value_policy /*policy*/, handle /*parent*/) {
        return fairing::bindings::read_only(array_t<double>(values.size(), values.data()));
    }
};

template <>
struct type_caster<Eigen::MatrixXd> {
    PYBIND11_TYPE_CASTER(Eigen::MatrixXd, const_name("numpy.ndarray"));
    bool load(handle source, bool /*convert*/) {
        const auto array = fairing::bindings::numbers<double>(source);
        if (!array) return false;
        value = Eigen::Map<const Eigen::MatrixXd>(array.data(), array.shape(1), array.shape(0)).transpose();
        return true;
    }
    static handle cast(const Eigen::MatrixXd& rows, return_value_policy /*policy*/, handle /*parent*/) {
        const Eigen::MatrixXd columns = rows.transpose();
        return fairing::bindings::read_only(array_t<double>({rows.rows(), rows.cols()}, columns.data()));
    }
};

// Flags are an array of bool in Python.
template <typename Scalar, typename InPython>
struct ListOfNumbers {
    PYBIND11_TYPE_CASTER(std::vector<Scalar>, const_name("numpy.ndarray"));
    bool load(handle source, bool /*convert*/) {
        const auto array = fairing::bindings::numbers<InPython>(source);
        if (!array) return false;
        value.assign(array.data(), array.data() + array.size());
        return true;
    }
    static handle cast(const std::vector<Scalar>& values, return_value_policy /*policy*/, handle /*parent*/) {
        array_t<InPython> array(static_cast<ssize_t>(values.size()));
        std::copy(values.begin(), values.end(), array.mutable_data());
        return fairing::bindings::read_only(std::move(array));
    }
};
template <>
struct type_caster<std::vector<int>> : ListOfNumbers<int, int> {};
template <>
struct type_caster<std::vector<char>> : ListOfNumbers<char, bool> {};

// A row for each.
template <std::size_t Size>
struct type_caster<std::vector<std::array<int, Size>>> {
    using Rows = std::vector<std::array<int, Size>>;
    PYBIND11_TYPE_CASTER(Rows, const_name("numpy.ndarray"));
    bool load(handle source, bool /*convert*/) {
        const auto array = fairing::bindings::numbers<int>(source);
        if (!array) return false;
        value.resize(static_cast<std::size_t>(array.size()) / Size);
        for (std::size_t k = 0; k < value.size(); ++k) std::copy_n(array.data() + Size * k, Size, value[k].begin());
        return true;
    }
    static handle cast(const Rows& rows, return_value_policy /*policy*/, handle /*parent*/) {
        array_t<int> array({static_cast<ssize_t>(rows.size()), static_cast<ssize_t>(Size)});
        for (std::size_t k = 0; k < rows.size(); ++k)
            std::copy(rows[k].begin(), rows[k].end(), array.mutable_data() + Size * k);
        return fairing::bindings::read_only(std::move(array));
    }
};

template <>
struct type_caster<fairing::Diagnostic> {
    static constexpr auto name = const_name("Diagnostic");  // in signatures
    static handle cast(const fairing::Diagnostic& diagnostic, return_value_policy /*policy*/, handle /*parent*/) {
        return fairing::bindings::from_diagnostic(diagnostic).release();
    }
};

}  // namespace pybind11::detail
