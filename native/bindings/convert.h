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

// An (n, 3) array is a column for each row.
template <typename Scalar, int Rows>
void take(const Numbers<Scalar>& array, Eigen::Matrix<Scalar, Rows, Eigen::Dynamic>& columns) {
    columns = Eigen::Map<const Eigen::Matrix<Scalar, Rows, Eigen::Dynamic>>(array.data(), Rows, array.shape(0));
}
template <typename Scalar, int Rows>
py::array array_of(const Eigen::Matrix<Scalar, Rows, Eigen::Dynamic>& columns) {
    return py::array_t<Scalar>({columns.cols(), columns.rows()}, columns.data());
}

inline void take(const Numbers<double>& array, VectorX& values) {
    values = Eigen::Map<const VectorX>(array.data(), array.size());
}
inline py::array array_of(const VectorX& values) { return py::array_t<double>(values.size(), values.data()); }

// (n, c) stays a row for each row.
inline void take(const Numbers<double>& array, Eigen::MatrixXd& rows) {
    rows = Eigen::Map<const Eigen::MatrixXd>(array.data(), array.shape(1), array.shape(0)).transpose();
}
inline py::array array_of(const Eigen::MatrixXd& rows) {
    const Eigen::MatrixXd columns = rows.transpose();
    return py::array_t<double>({rows.rows(), rows.cols()}, columns.data());
}

template <typename Scalar, typename InPython>
void take(const Numbers<InPython>& array, std::vector<Scalar>& values) {
    values.assign(array.data(), array.data() + array.size());
}
inline py::array array_of(const std::vector<int>& values) {
    return py::array_t<int>(py::ssize_t(values.size()), values.data());
}
inline py::array array_of(const std::vector<char>& flags) {
    py::array_t<bool> array(static_cast<py::ssize_t>(flags.size()));
    std::copy(flags.begin(), flags.end(), array.mutable_data());
    return array;
}

// A row for each.
template <std::size_t Size>
void take(const Numbers<int>& array, std::vector<std::array<int, Size>>& rows) {
    rows.resize(static_cast<std::size_t>(array.size()) / Size);
    for (std::size_t k = 0; k < rows.size(); ++k) std::copy_n(array.data() + Size * k, Size, rows[k].begin());
}
template <std::size_t Size>
py::array array_of(const std::vector<std::array<int, Size>>& rows) {
    return py::array_t<int>({rows.size(), Size}, rows.empty() ? nullptr : rows[0].data());
}

}  // namespace fairing::bindings

namespace pybind11::detail {

// Arrays handed out are read-only copies.
template <typename Type, typename Scalar>
struct OfArray {
    PYBIND11_TYPE_CASTER(Type, const_name("numpy.ndarray"));
    bool load(handle source, bool /*convert*/) {
        const auto array = fairing::bindings::numbers<Scalar>(source);
        if (array) fairing::bindings::take(array, value);
        return static_cast<bool>(array);
    }
    static handle cast(const Type& values, return_value_policy /*policy*/, handle /*parent*/) {
        return fairing::bindings::read_only(fairing::bindings::array_of(values));
    }
};

template <typename Scalar, int Rows>
struct type_caster<Eigen::Matrix<Scalar, Rows, Eigen::Dynamic>>
    : OfArray<Eigen::Matrix<Scalar, Rows, Eigen::Dynamic>, Scalar> {};
template <>
struct type_caster<Eigen::VectorXd> : OfArray<Eigen::VectorXd, double> {};
template <>
struct type_caster<Eigen::MatrixXd> : OfArray<Eigen::MatrixXd, double> {};
template <>
struct type_caster<std::vector<int>> : OfArray<std::vector<int>, int> {};
template <>
struct type_caster<std::vector<char>> : OfArray<std::vector<char>, bool> {};
template <std::size_t Size>
struct type_caster<std::vector<std::array<int, Size>>> : OfArray<std::vector<std::array<int, Size>>, int> {};

template <>
struct type_caster<fairing::Diagnostic> {
    static constexpr auto name = const_name("Diagnostic");  // in signatures
    static handle cast(const fairing::Diagnostic& diagnostic, return_value_policy /*policy*/, handle /*parent*/) {
        return fairing::bindings::from_diagnostic(diagnostic).release();
    }
};

}  // namespace pybind11::detail
