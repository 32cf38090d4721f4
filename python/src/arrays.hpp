#pragma once
// NumPy in and out without copies.

#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace zlg::python {

namespace py = pybind11;

// An array of this type and contiguous is taken as it is; any other is converted.
template <class T> using In = py::array_t<T, py::array::c_style | py::array::forcecast>;

// The numbers of a one-dimensional array; they stay the array's. errors  ValueError: another number of dimensions.
template <class T> [[nodiscard]] std::span<const T> span_of(const In<T>& array, const char* name) {
    if (array.ndim() != 1)
        throw std::invalid_argument{std::string{name} + ": has " + std::to_string(array.ndim()) +
                                    " dimensions; allowed is 1"};
    return {array.data(), static_cast<std::size_t>(array.size())};
}

// Whole numbers: those of another type are converted where that changes none of them.
//
// errors  ValueError: 150.7 as a count, 257 in a byte; a masked array, whose mask would be lost.
template <std::integral T> [[nodiscard]] In<T> whole_numbers(const py::object& given, const char* name) {
    const auto numpy = py::module_::import("numpy");
    if (py::isinstance(given, numpy.attr("ma").attr("MaskedArray")))
        throw std::invalid_argument{std::string{name} + ": is a masked array; allowed is an array without a mask"};
    const py::array original{given};
    In<T> array{original};
    (void)span_of(array, name);
    if (py::isinstance<py::array_t<T>>(original)) return array;
    const py::object changed = numpy.attr("not_equal")(original, array);
    const py::object rows = changed.attr("nonzero")()[py::int_{0}];
    if (py::len(rows) == 0) return array;
    const py::object row = rows[py::int_{0}];
    throw std::invalid_argument{std::string{name} + ": row " + std::string{py::str(row)} + " holds " +
                                std::string{py::str(original[row])} + "; allowed are whole numbers of " +
                                std::to_string(8 * sizeof(T)) + " bits"};
}

// errors  ValueError: the first number that is not `good`.
template <class T, class Good>
void refuse(std::span<const T> values, const char* name, const char* allowed, Good good) {
    for (std::size_t row = 0; row < values.size(); ++row)
        if (!good(row))
            throw std::invalid_argument{std::string{name} + ": row " + std::to_string(row) + " holds " +
                                        std::to_string(values[row]) + "; allowed is " + allowed};
}

// The function of each element; of a single number an array without dimensions.
template <class Function, class... Arrays>
[[nodiscard]] py::array_t<double> of_each(Function function, const Arrays&... arrays) {
    return py::array_t<double>::ensure(py::vectorize(function)(arrays...));
}

template <class T> [[nodiscard]] std::span<const T> span_of(const std::optional<In<T>>& array, const char* name) {
    return array ? span_of(*array, name) : std::span<const T>{};
}

// The vector becomes the array's own memory.
template <class T> [[nodiscard]] py::array_t<T> as_array(std::vector<T> values, std::vector<py::ssize_t> shape = {}) {
    auto owned = std::make_unique<std::vector<T>>(std::move(values));
    const T* data = owned->data();
    if (shape.empty()) shape = {static_cast<py::ssize_t>(owned->size())};
    py::capsule owner{owned.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); }};
    (void)owned.release();
    return py::array_t<T>{shape, data, owner};
}

// Bytes 0 and 1 as bool.
[[nodiscard]] inline py::object as_bools(std::vector<std::uint8_t> values) {
    return as_array(std::move(values)).attr("view")("bool");
}

// One member of many structs as an array.
template <class Struct, class Get> [[nodiscard]] auto column(const std::vector<Struct>& rows, Get get) {
    using T = std::decay_t<decltype(std::invoke(get, rows.front()))>;
    std::vector<T> values;
    values.reserve(rows.size());
    for (const Struct& row : rows) values.push_back(std::invoke(get, row));
    return as_array(std::move(values));
}

// What the work gives, done while other threads of Python run.
template <class Work> [[nodiscard]] auto without_interpreter(Work work) {
    const py::gil_scoped_release released;
    return work();
}

// To be called where the interpreter is released: lets Ctrl-C through.
inline void look_for_signals() {
    const py::gil_scoped_acquire interpreter;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set{};
}

// To be called where the interpreter is released: tells Python's function, if there is one, and lets Ctrl-C through.
class Progress {
public:
    explicit Progress(const py::object& callback) : callback_{callback} {}

    void operator()(double fraction) const {
        const py::gil_scoped_acquire interpreter;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set{};
        if (!callback_.is_none()) callback_(fraction);
    }

private:
    const py::object& callback_;  // the caller's: it outlives the call
};

}  // namespace zlg::python
