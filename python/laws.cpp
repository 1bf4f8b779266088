#include "python/laws.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "nurbs/number_text.h"
#include "python/interpreter_lock.h"
#include "python/signal.h"

namespace nurbeam::python {

namespace {

namespace py = pybind11;

// Python's own exception from the start: on the way through a run pybind11's of that type, a
// std::runtime_error, would be taken for that of a file.
[[noreturn]] void raise_error(PyObject* type, const std::string& message) {
  PyErr_SetString(type, message.c_str());
  throw py::error_already_set();
}

class PythonLaw {
 public:
  PythonLaw(const py::function& function, std::size_t points, const ModelFrame& frame, std::size_t number)
      : function_(function), points_(static_cast<Eigen::Index>(points)), frame_(frame), number_(number) {}

  CustomForce::Response operator()(double t, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd& v) const {
    const WithLock lock;
    const py::object arguments[] = {py::float_(t), to_array(r, true), to_array(v, false)};
    PyObject* const pointers[] = {arguments[0].ptr(), arguments[1].ptr(), arguments[2].ptr()};
    const auto answer =
        py::reinterpret_steal<py::object>(PyObject_Vectorcall(function_.ptr(), pointers, 3, nullptr));
    if (!answer) throw py::error_already_set();
    CustomForce::Response response;
    if (has_derivatives(answer)) {
      const py::tuple parts(answer);
      response.force = to_forces(parts[0], t);
      response.by_position = to_derivative(parts[1], "positions", t);
      response.by_velocity = to_derivative(parts[2], "velocities", t);
    } else {
      response.force = to_forces(answer, t);
    }
    return response;
  }

 private:
  std::string name() const { return "laws[" + std::to_string(number_) + "]"; }

  py::array_t<double> to_array(const Eigen::Matrix3Xd& local, bool places) const {
    py::array_t<double> world =
        points_ == 1 ? py::array_t<double>(3) : py::array_t<double>({points_, Eigen::Index{3}});
    Eigen::Map<Eigen::Matrix3Xd> columns(world.mutable_data(), 3, points_);
    columns.noalias() = frame_.rotation.transpose() * local;
    if (places) columns.colwise() += frame_.origin;
    return world;
  }

  // (forces, derivative, derivative), and not the three components of one force.
  static bool has_derivatives(const py::object& answer) {
    return PyTuple_CheckExact(answer.ptr()) && PyTuple_GET_SIZE(answer.ptr()) == 3 &&
           PySequence_Check(PyTuple_GET_ITEM(answer.ptr(), 0));
  }
  static bool is_number(PyObject* object) { return PyFloat_Check(object) || PyLong_Check(object); }

  Eigen::Matrix3Xd to_forces(const py::handle& answer, double t) const {
    Eigen::Matrix3Xd world(3, points_);
    if (!copy_numbers(answer, world)) {
      const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(answer);
      if (!array) PyErr_Clear();
      if (!array || array.size() != world.size())
        raise_error(PyExc_TypeError,
                    name() + ": returned " + std::string(py::str(py::repr(answer))) + "; expected " +
                        (points_ == 1 ? "the force, three numbers in newtons"
                                      : std::to_string(points_) + " forces, three numbers each"));
      world = Eigen::Map<const Eigen::Matrix3Xd>(array.data(), 3, points_);
    }
    if (!world.allFinite())
      raise_error(PyExc_ValueError, name() + ": returned " + std::string(py::str(py::repr(answer))) +
                                        " at t = " + text_of(t) + " s; a force must be finite");
    const Eigen::Matrix3Xd local = frame_.rotation * world;
    if (frame_.dimension == 2 && local.row(2).norm() > 1e-9 * local.norm())
      raise_error(PyExc_ValueError,
                  name() + ": returned " + std::string(py::str(py::repr(answer))) + " at t = " + text_of(t) +
                      " s, a force out of the plane of the model; add the law with spatial=True");
    return local;
  }

  // Of three numbers in a tuple or list, without making an array.
  bool copy_numbers(const py::handle& answer, Eigen::Matrix3Xd& world) const {
    if (points_ != 1 || !(PyTuple_CheckExact(answer.ptr()) || PyList_CheckExact(answer.ptr()))) return false;
    if (PySequence_Fast_GET_SIZE(answer.ptr()) != 3) return false;
    PyObject** const items = PySequence_Fast_ITEMS(answer.ptr());
    for (int i = 0; i < 3; ++i) {
      if (!is_number(items[i])) return false;
      world(i, 0) = PyFloat_AsDouble(items[i]);
      if (PyErr_Occurred()) throw py::error_already_set();
    }
    return true;
  }

  // In the model's own frame; empty for None.
  Eigen::MatrixXd to_derivative(const py::handle& given, const char* by, double t) const {
    if (given.is_none()) return {};
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
    const Eigen::Index n = 3 * points_;
    if (!array) PyErr_Clear();
    if (!array || array.ndim() != 2 || array.shape(0) != n || array.shape(1) != n)
      raise_error(PyExc_TypeError, name() + ": the derivative by " + by + " must have the shape (" +
                                       std::to_string(n) + ", " + std::to_string(n) + "), or be None");
    Eigen::MatrixXd local =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(array.data(),
                                                                                                 n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        if (!std::isfinite(local(i, j)))
          raise_error(PyExc_ValueError,
                      name() + ": the derivative by " + by + " is " + text_of(local(i, j)) + " at [" +
                          std::to_string(i) + ", " + std::to_string(j) + "] at t = " + text_of(t) +
                          " s; it must be finite, or None: then it is taken by differences");
    for (Eigen::Index i = 0; i < points_; ++i)
      for (Eigen::Index j = 0; j < points_; ++j) {
        auto block = local.block<3, 3>(3 * i, 3 * j);
        block = (frame_.rotation * block * frame_.rotation.transpose()).eval();
      }
    return local;
  }

  py::handle function_;  // borrowed
  Eigen::Index points_;
  ModelFrame frame_;
  std::size_t number_;  // in the case
};

// Value, speed and acceleration of a motion, N numbers each, in what its function returns.
template <int N>
class PythonMotion {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  struct Moment {
    Vector value, speed, acceleration;
  };

  PythonMotion(const py::function& function, std::string path)
      : function_(function), path_(std::move(path)) {}

  Moment at(double t) const {
    const WithLock lock;
    const py::object answer = function_(t);
    if (PyTuple_CheckExact(answer.ptr()) && PyTuple_GET_SIZE(answer.ptr()) == 3 &&
        (N == 1 || PySequence_Check(PyTuple_GET_ITEM(answer.ptr(), 0)))) {
      const py::tuple parts(answer);
      return {vector(parts[0], t), vector(parts[1], t), vector(parts[2], t)};
    }
    constexpr double h = 1e-4;  // [s]
    const Vector now = vector(answer, t), before = vector(function_(t - h), t - h),
                 after = vector(function_(t + h), t + h);
    return {now, (after - before) / (2 * h), (after - 2 * now + before) / (h * h)};
  }
  const std::string& path() const { return path_; }

 private:
  Vector vector(const py::handle& answer, double t) const {
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(answer);
    if (!array) PyErr_Clear();
    const std::string returned = path_ + ".motion: returned " + std::string(py::str(py::repr(answer))) +
                                 " at t = " + text_of(t) + " s; ";
    if (!array || array.size() != N)
      raise_error(PyExc_TypeError, returned + "expected " +
                                       (N == 1 ? "the reference arc length, a number in metres"
                                               : "the displacement, three numbers in metres") +
                                       ", or this and its first two derivatives");
    const Vector value = Eigen::Map<const Vector>(array.data());
    if (!value.allFinite()) raise_error(PyExc_ValueError, returned + "a motion must be finite");
    return value;
  }

  py::handle function_;  // borrowed
  std::string path_;     // in the case
};

std::shared_ptr<Signal> signal_in(const py::function& function, int size, const std::string& path) {
  if (!py::isinstance<Signal>(function)) return nullptr;
  auto signal = function.cast<std::shared_ptr<Signal>>();
  if (signal->size() != size)
    raise_error(PyExc_ValueError, path + ": the signal has " + std::to_string(signal->size()) +
                                      " numbers; expected " + std::to_string(size));
  return signal;
}

// A vector of a signal in the model's own frame.
Eigen::Vector3d to_local(const Eigen::Vector3d& world, const ModelFrame& frame, const std::string& path) {
  const Eigen::Vector3d local = frame.rotation * world;
  if (frame.dimension == 2 && std::abs(local[2]) > 1e-9 * local.norm()) {
    const WithLock lock;
    raise_error(PyExc_ValueError, path +
                                      ": the signal leaves the plane of the model; add the law with "
                                      "spatial=True, or give the model a load out of its plane");
  }
  return local;
}

// A force that a signal gives to each of its points.
CustomForce::Law force_law(const std::shared_ptr<Signal>& signal, const ModelFrame& frame,
                           const std::string& path) {
  return [signal, frame, path](double t, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd&) {
    const Eigen::Index n = r.size();
    return CustomForce::Response{to_local(signal->at(t).value, frame, path).replicate(1, r.cols()),
                                 Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  };
}

// The drag of a body, factor * |u| u, where u is the wind's velocity beside that of the body.
CustomForce::Law drag_law(const std::shared_ptr<Signal>& wind, const ModelFrame& frame, double factor) {
  return [wind, frame, factor](double t, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd& v) {
    const Eigen::Vector3d u = to_local(wind->at(t).value, frame, "wind") - v.col(0);
    const double speed = u.norm();
    Eigen::Matrix3d by_velocity = -speed * Eigen::Matrix3d::Identity();
    if (speed > 0) by_velocity -= u * u.transpose() / speed;
    return CustomForce::Response{factor * speed * u, Eigen::MatrixXd::Zero(r.size(), r.size()),
                                 factor * by_velocity};
  };
}

// Takes the drag of all bodies from a signal.
void blow(BeamModel& model, const py::function& function, const ModelFrame& frame) {
  const std::shared_ptr<Signal> wind = signal_in(function, 3, "wind");
  if (!wind) raise_error(PyExc_TypeError, "the wind is no signal; expected nurbeam.Signal([x, y, z])");
  if (!(model.air.density > 0))
    raise_error(PyExc_ValueError, "wind: the model has no air; give its case an \"air\" with a \"density\"");
  for (int i = 0; i < static_cast<int>(model.bodies.size()); ++i) {
    const double area = std::exchange(model.bodies[i].drag_area, 0);
    if (area == 0) continue;
    CustomForce drag{{Grip{}}, drag_law(wind, frame, model.air.density * area / 2)};
    drag.points[0].body = i;
    model.forces.push_back(std::move(drag));
  }
}

PlaceMotion place_motion(const PythonMotion<1>& motion, const Rider& joint, double length) {
  const double start = motion.at(0).value[0];
  if (std::abs(start - joint.s) > 1e-9 * length)
    raise_error(PyExc_ValueError, motion.path() + ".motion: is at s = " + text_of(start) +
                                      " m at time 0, but \"at\" is s = " + text_of(joint.s) +
                                      " m; it must start where \"at\" is");
  return PlaceMotion([motion](double t) {
    const auto now = motion.at(t);
    return PlaceMotion::Moment{now.value[0], now.speed[0], now.acceleration[0]};
  });
}

DisplacementTable support_motion(const PythonMotion<3>& motion, const ModelFrame& frame,
                                 bool starts_as_drawn) {
  const double start = motion.at(0).value.norm();
  if (starts_as_drawn && start > 0)
    raise_error(
        PyExc_ValueError,
        motion.path() + ".motion: is " + text_of(start) +
            " m from the drawn place at time 0, but the run starts as drawn; begin with (0, 0, 0), or "
            "start with initial=\"equilibrium\"");
  return DisplacementTable([motion, frame](double t) {
    const auto now = motion.at(t);
    if (frame.dimension == 2 && std::abs((frame.rotation * now.value)[2]) > 1e-9 * now.value.norm()) {
      const WithLock lock;
      raise_error(
          PyExc_ValueError,
          motion.path() + ".motion: leaves the plane of the model at t = " + text_of(t) +
              " s; give the model a load out of its plane, which may be 0 in time, to make it one in space");
    }
    return DisplacementTable::Motion{frame.direction_to_local(now.value), frame.direction_to_local(now.speed),
                                     frame.direction_to_local(now.acceleration)};
  });
}

}  // namespace

BeamModel with_laws(const BuiltModel& built, const Functions& functions, const CaseAnalysis& analysis) {
  const auto& [forces, motions, wind] = functions;
  if (forces.size() != built.laws.size())
    throw std::invalid_argument("there are " + std::to_string(forces.size()) + " functions for " +
                                std::to_string(built.laws.size()) + " laws");
  BeamModel model = built.model;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const std::string path = "laws[" + std::to_string(i) + "]";
    if (const auto signal = signal_in(forces[i], 3, path))
      model.forces.push_back(CustomForce{built.laws[i], force_law(signal, built.frame, path)});
    else
      model.forces.push_back(
          CustomForce{built.laws[i], PythonLaw(forces[i], built.laws[i].size(), built.frame, i)});
  }
  if (!wind.empty()) blow(model, wind.front(), built.frame);
  const bool as_drawn = analysis.type == CaseAnalysis::Type::dynamic && !analysis.start_from_equilibrium;
  for (const LawOfMotion& law : built.motions) {
    if (law.function >= static_cast<int>(motions.size()))
      throw std::invalid_argument(law.path + ".motion_law: there is no function " +
                                  std::to_string(law.function) + "; give the function itself as the motion");
    const py::function& function = motions[law.function];
    if (law.rider >= 0) {
      Rider& joint = model.riders[law.rider];
      if (const auto speed = signal_in(function, 1, law.path + ".motion")) {
        speed->set_drives();
        joint.motion = PlaceMotion([speed, start = joint.s](double t) {
          const Signal::Moment now = speed->at(t);
          return PlaceMotion::Moment{start + now.integral[0], now.value[0], now.slope[0]};
        });
        continue;
      }
      joint.motion = place_motion({function, law.path}, joint, model.beam_of(joint).curve.length());
    } else {
      auto& support = std::get<Support>(model.constraints[law.constraint]);
      if (const auto speed = signal_in(function, 3, law.path + ".motion")) {
        speed->set_drives();
        support.motion = DisplacementTable([speed, frame = built.frame, path = law.path](double t) {
          const Signal::Moment now = speed->at(t);
          return DisplacementTable::Motion{to_local(now.integral, frame, path),
                                           to_local(now.value, frame, path),
                                           to_local(now.slope, frame, path)};
        });
        continue;
      }
      support.motion = support_motion({function, law.path}, built.frame, as_drawn);
    }
  }
  return model;
}

py::object keeping(const py::object& functions, py::object owner) {
  owner.attr("functions") = functions;
  return owner;
}

}  // namespace nurbeam::python
