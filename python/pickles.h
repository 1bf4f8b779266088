#pragma once
#include <pybind11/pybind11.h>

#include <string>

namespace nurbeam::python {

/// What an object's __reduce__ returns: a function of nurbeam.checked, by its name, that makes the object of
/// a byte string, which holds the parts and their checksum. No object is there before the checksum has been
/// found right.
pybind11::tuple reduce(const char* function, const pybind11::object& parts);

/// The parts again. `what` names the object in the message. Throws pickle.UnpicklingError where the bytes
/// have not the checksum they were written with.
pybind11::object parts_of(const pybind11::bytes& pickled, const std::string& what);

}  // namespace nurbeam::python
